'use strict';
// The part of a page about one grain.

const FIELDS = {
  deviation: { title: 'scan − surface', power: 1, isSigned: true },
  mean_curvature: { title: 'mean curvature', power: -1 },
  gaussian_curvature: { title: 'Gaussian curvature', power: -2 },
  radius: { title: 'distance from the model’s centre', power: 1 },
  segment: { title: 'segment', power: 0 },
};

function unitOf(unit, power) {
  const [one, name] = unit ? [unit, unit] : ['unit of the scan', '(unit of the scan)'];
  return { 0: '', 1: one, '-1': `1/${name}`, '-2': `1/${name}²` }[power];
}

function titleOf(name, unit) {
  const inUnit = unitOf(unit, FIELDS[name].power);
  return inUnit ? `${FIELDS[name].title}, ${inUnit}` : FIELDS[name].title;
}

function coloursOf(name, values) {
  if (name === 'segment') {
    const colours = MARKS.map((mark) => [1, 3, 5].map((at) => parseInt(mark.slice(at, at + 2), 16)));
    return { colour: (value) => colours[Math.round(value * 3) % colours.length] };
  }
  const steps = FIELDS[name].isSigned ? record.diverging : record.sequential;
  const range = rangeOf(values, FIELDS[name].isSigned);
  return { range, steps, colour: (value) => colourOf(value, range, steps) };
}

function grainView(grain) {
  const canvas = el('canvas', { width: 800, height: 600 });
  const vertices = floatsOf(grain.vertices);
  const viewer = new Viewer(canvas, radiusOf(vertices));
  const fields = grain.fields.map(({ name, values }) => ({ name, values: floatsOf(values) }));
  const surface = viewer.add({ kind: 'triangles', places: vertices, normals: unitsOf(grain.normals), corners: countsOf(grain.triangles) });
  const axes = floatsOf(grain.axes);
  viewer.lookAlong([0, 6].map((end) => [0, 1, 2].map((i) => axes[end + 3 + i] - axes[end + i])));
  const ink = () => (isDark() ? [0.9, 0.9, 0.9] : [0.1, 0.1, 0.1]);
  const lines = (places, colour, shown) => viewer.add({ kind: 'lines', places: Float32Array.from(places), colour, shown });
  const pairs = (line) => {
    const ends = [];
    for (let i = 0; i + 5 < line.length; i += 3) ends.push(...line.slice(i, i + 6));
    return ends;
  };
  const corners = floatsOf(grain.corners);
  const edges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((from) => [1, 2, 4].filter((bit) => !(from & bit)).map((bit) => [from, from | bit])).flat();
  const layers = {
    surface,
    'segment outlines': lines(grain.borders.flatMap((border) => pairs(floatsOf(border))), () => [0.15, 0.15, 0.15], true),
    'scan points': viewer.add({ kind: 'points', places: floatsOf(grain.points), colour: () => [0.16, 0.25, 0.5], size: 2, shown: false }),
    'principal axes': lines(axes, () => (isDark() ? [1, 0.75, 0.3] : [0.75, 0.35, 0]), false),
    'minimum box': lines(edges.flatMap((at) => [...corners.slice(3 * at, 3 * at + 3)]), ink, false),
  };
  const toggles = Object.entries(layers).filter(([, layer]) => layer.places.length).map(([name, layer]) => {
    const box = el('input', { type: 'checkbox', change: () => { layer.shown = box.checked; viewer.draw(); } });
    box.checked = layer.shown;
    return el('label', {}, box, ` ${name}`);
  });
  const bar = el('div');
  const paint = (name) => {
    const { values } = fields.find((field) => field.name === name);
    const colours = coloursOf(name, values);
    const bytes = new Uint8Array(3 * values.length);
    values.forEach((value, at) => bytes.set(colours.colour(value), 3 * at));
    viewer.paint(surface, bytes);
    bar.replaceChildren(...(colours.range ? [colourBar(colours.range, colours.steps, titleOf(name, grain.unit))] : []));
    viewer.draw();
  };
  const names = fields.map((field) => field.name).sort((a, b) => (b === 'deviation') - (a === 'deviation'));
  const choice = el('select', { change: () => paint(choice.value) },
    names.map((name) => el('option', { value: name }, FIELDS[name].title)));
  const note = fields.some((field) => field.name === 'deviation')
    ? 'Signed distance of the scan from the surface, positive outside; grey where the scan has no points near by.' : '';
  const shown = el('div', { class: 'row' },
    el('figure', { class: 'view' }, canvas, el('figcaption', {}, `Drag to turn, wheel to zoom. ${note}`)),
    el('div', { class: 'controls' }, el('label', {}, 'colours ', choice), bar, el('div', { class: 'toggles' }, toggles)));
  new ResizeObserver(() => viewer.draw()).observe(canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => viewer.draw());
  paint(names[0]);
  return { shown, viewer, toggles, choice };
}

function mapsOf(grain) {
  return grain.maps.map(({ name, values }) => {
    const numbers = floatsOf(values);
    const { range, steps } = coloursOf(name, numbers);
    return angleMap(titleOf(name, grain.unit), grain.rows, grain.columns, numbers, range, steps);
  });
}

// Errors of all candidates against the number of segments and of coefficients, a line for each degree.
function searchPlots(search) {
  const degrees = [...new Set(search.degrees)].sort((a, b) => a - b);
  const plot = (title, values, across, xTitle, factor) => scatter({
    title, xTitle, yTitle: title, isLogX: true, isLogY: true, joined: true, series: degrees.map((degree) => `degree ${degree}`),
    points: values.map((value, at) => ({
      x: across[at], y: value === null ? NaN : factor * Math.abs(value), series: degrees.indexOf(search.degrees[at]),
      label: `degree ${search.degrees[at]}, ${search.segments[at]} segments:`,
    })),
  });
  return [['area error, %', search.area_errors, 100], ['volume error, %', search.volume_errors, 100], ['held-out RMS', search.heldout_rms, 1]]
    .flatMap(([title, values, factor]) => [
      plot(title, values, search.segments, 'segments', factor),
      plot(title, values, search.coefficients, 'coefficients', factor)]);
}

// Held-out errors of all families against run time and coefficients.
function benchPlots(bench) {
  const families = [...new Set(bench.families)];
  return [['seconds of the fit, one thread', bench.seconds], ['coefficients', bench.coefficients]].map(([title, values]) => scatter({
    title: 'held-out RMS, % of the mean radius', xTitle: title, yTitle: 'held-out RMS, %', isLogX: true, isLogY: true, series: families,
    points: values.map((value, at) => ({
      x: value, y: bench.heldout_shares[at] === null ? NaN : 100 * bench.heldout_shares[at], series: families.indexOf(bench.families[at]),
      label: `${bench.families[at]}, ${bench.segments[at]} segments, ${bench.coefficients[at]} coefficients:`,
    })),
  }));
}

function grainPart(grain) {
  const view = grainView(grain);
  const rows = grain.measures.map(({ name, value, error, unit, definition }) => el('tr', {},
    el('td', {}, name), el('td', {}, value), el('td', {}, error || ''), el('td', {}, unit), el('td', { class: 'note' }, definition)));
  const heads = ['measure', 'value', 'standard error', 'unit', 'definition'].map((name) => el('th', {}, name));
  const part = el('section', {},
    el('h2', {}, grain.name),
    el('dl', { class: 'facts' }, grain.facts.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)])),
    grain.warnings.map((warning) => el('p', { class: 'warning' }, warning)),
    view.shown,
    el('h3', {}, 'Maps over the angles of the grain’s own axes'), el('div', { class: 'row' }, mapsOf(grain)),
    grain.search ? [el('h3', {}, 'Independent segments: error against size'), el('div', { class: 'row' }, searchPlots(grain.search))] : [],
    grain.bench ? [el('h3', {}, 'Families of models: error against cost'), el('div', { class: 'row' }, benchPlots(grain.bench))] : [],
    rows.length ? [el('h3', {}, 'Measures'), el('div', {}, el('table', {}, el('thead', {}, el('tr', {}, heads)), el('tbody', {}, rows)))] : []);
  return { part, view };
}
