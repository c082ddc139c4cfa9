'use strict';
// Puts the parts together.

const { page, grids } = record;
const views = [];
const main = document.getElementById('page');
main.append(el('h1', {}, 'grainform report'));
for (const grain of page.grains) {
  const { part, view } = grainPart(grain);
  main.append(part);
  views.push(view);
}
page.lots.forEach((lot, at) => main.append(lotPart(lot, grids[at])));
main.append(el('footer', {}, `grainform ${page.version}: ${page.command}`));
views.forEach(({ viewer }) => viewer.draw());

// What a test asks for: whether all is drawn, and whether toggles change it.
if (location.hash === '#selfcheck') {
  const found = views.filter(({ viewer }) => viewer.gl).map(({ viewer, toggles, choice }) => {
    const [before, covered] = viewer.digest();
    const differs = (change, back) => {
      change();
      const after = viewer.digest()[0];
      back();
      return after !== before;
    };
    return {
      covered: covered / (viewer.canvas.width * viewer.canvas.height),
      toggles: toggles.map((label) => {
        const flip = () => label.querySelector('input').click();
        return [label.textContent.trim(), differs(flip, flip)];
      }),
      colours: [...choice.options].slice(1).map((option) => [option.value, differs(
        () => { choice.selectedIndex = option.index; choice.dispatchEvent(new Event('change')); },
        () => { choice.selectedIndex = 0; choice.dispatchEvent(new Event('change')); })]),
      turned: differs(() => viewer.turnBy(0.5, 0.2), () => viewer.turnBy(0, 0)),
    };
  });
  document.querySelectorAll('th.sorts').forEach((head) => head.click());
  const lead = document.querySelector('tr.leads');
  if (lead) lead.click();
  const count = (what) => document.querySelectorAll(what).length;
  document.documentElement.dataset.selfcheck = JSON.stringify({
    problems, views: found, maps: count('svg.map'), plots: count('svg.plot'), rows: count('tbody tr'), dots: count('circle.dot'),
    sections: count('section'),
    details: [...document.querySelectorAll('table.details tr')].map((row) => [...row.children].map((cell) => cell.textContent)),
  });
}
