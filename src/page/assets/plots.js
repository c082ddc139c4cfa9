'use strict';
// Plots as SVG: bars of colours, maps over angles, points, counts.

const MARKS = ['#4477aa', '#ee6677', '#228833', '#ccbb44', '#66ccee', '#aa3377', '#888888', '#ee8866'];

// A bar of the colours of a range with its numbers.
function colourBar(range, steps, title, width = 230) {
  const height = 220;
  const rows = [...steps].reverse().map(([r, g, b], at) => el('rect', {
    x: 0, y: 24 + (at * height) / steps.length, width: 18, height: height / steps.length + 0.5, fill: `rgb(${r},${g},${b})`,
  }));
  const places = ticks(range[0], range[1], 8);
  const texts = toldApart(places);
  const marks = places.map((mark, at) => {
    const y = 24 + height * (1 - (mark - range[0]) / (range[1] - range[0]));
    return [el('line', { class: 'axis', x1: 18, x2: 23, y1: y, y2: y }), el('text', { x: 27, y: y + 4 }, texts[at])];
  });
  return el('svg', { width, height: height + 36 }, el('text', { x: 0, y: 14 }, title), rows, marks);
}

// A map over polar angle (down) and azimuth (across).
function angleMap(title, rows, columns, values, range, steps) {
  const canvas = el('canvas', { width: columns, height: rows });
  const context = canvas.getContext('2d');
  const image = context.createImageData(columns, rows);
  values.forEach((value, at) => image.data.set([...colourOf(value, range, steps), 255], 4 * at));
  context.putImageData(image, 0, 0);
  const [left, top, width, height] = [44, 26, 340, 170];
  const marks = [0, 90, 180, 270, 360].map((phi) => {
    const x = left + (width * phi) / 360;
    return [el('line', { class: 'axis', x1: x, x2: x, y1: top + height, y2: top + height + 4 }),
      el('text', { x, y: top + height + 17, 'text-anchor': 'middle' }, `${phi}°`)];
  });
  const levels = [0, 45, 90, 135, 180].map((theta) => {
    const y = top + (height * theta) / 180;
    return [el('line', { class: 'axis', x1: left - 4, x2: left, y1: y, y2: y }),
      el('text', { x: left - 8, y: y + 4, 'text-anchor': 'end' }, `${theta}°`)];
  });
  const drawn = el('svg', { class: 'map', width: 400, height: 236 },
    el('text', { x: left, y: 14 }, title),
    el('image', { x: left, y: top, width, height, preserveAspectRatio: 'none', href: canvas.toDataURL() }),
    el('rect', { class: 'axis', x: left, y: top, width, height }), marks, levels,
    el('text', { x: left + width / 2, y: top + height + 36, 'text-anchor': 'middle' }, 'azimuth φ across, polar angle θ down'));
  return el('figure', { class: 'row' }, drawn, colourBar(range, steps, '', 90));
}

// An axis: from a number to its place, and the marks.
function axisOf(values, isLog, from, to) {
  const known = values.filter((value) => Number.isFinite(value) && (!isLog || value > 0));
  let [low, high] = [leastOf(known), mostOf(known)];
  if (!known.length) [low, high] = isLog ? [1, 10] : [0, 1];
  if (isLog) {
    [low, high] = [Math.log10(low), Math.log10(high)];
    if (high - low < 0.3) [low, high] = [low - 0.15, high + 0.15];
  } else if (high <= low) [low, high] = [low - 0.5 * Math.abs(low) - 1e-12, high + 0.5 * Math.abs(high) + 1e-12];
  const margin = 0.05 * (high - low);
  [low, high] = [low - margin, high + margin];
  const place = (value) => from + ((to - from) * ((isLog ? Math.log10(value) : value) - low)) / (high - low);
  const decades = Array.from({ length: 40 }, (_, i) => i - 20).flatMap((p) => (high - low > 2 ? [1] : [1, 2, 5]).map((f) => f * 10 ** p));
  const marks = isLog ? decades.filter((mark) => Math.log10(mark) >= low && Math.log10(mark) <= high) : ticks(low, high, 6);
  return { place, marks, isKnown: (value) => Number.isFinite(value) && (!isLog || value > 0) };
}

function frame(title, x, y, xTitle, yTitle, [left, top, width, height]) {
  const [acrossTexts, upTexts] = [x.marks, y.marks].map(toldApart);
  const across = x.marks.map((mark, at) => [
    el('line', { class: 'grid', x1: x.place(mark), x2: x.place(mark), y1: top, y2: top + height }),
    el('text', { x: x.place(mark), y: top + height + 16, 'text-anchor': 'middle' }, acrossTexts[at])]);
  const up = y.marks.map((mark, at) => [
    el('line', { class: 'grid', x1: left, x2: left + width, y1: y.place(mark), y2: y.place(mark) }),
    el('text', { x: left - 6, y: y.place(mark) + 4, 'text-anchor': 'end' }, upTexts[at])]);
  return [el('text', { x: left, y: 14 }, title), across, up, el('rect', { class: 'axis', x: left, y: top, width, height }),
    el('text', { x: left + width / 2, y: top + height + 34, 'text-anchor': 'middle' }, xTitle),
    el('text', { x: 12, y: top + height / 2, 'text-anchor': 'middle', transform: `rotate(-90 12 ${top + height / 2})` }, yTitle)];
}

// Points: [{x, y, series, label, lead}]; series are drawn as lines where `joined`. Both axes hold the numbers of `within`;
// guides are lines from x, y to x, y.
function scatter({ title, points, xTitle, yTitle, isLogX, isLogY, joined, within = [], series = [], guides = [] }) {
  const [left, top, width, height] = [64, 26, 380, 260];
  const x = axisOf([...points.map((point) => point.x), ...within], isLogX, left, left + width);
  const y = axisOf([...points.map((point) => point.y), ...within], isLogY, top + height, top);
  const known = points.filter((point) => x.isKnown(point.x) && y.isKnown(point.y));
  const colour = (at) => MARKS[(at || 0) % MARKS.length];
  const lines = joined ? [...new Set(known.map((point) => point.series))].map((one) => {
    const own = known.filter((point) => point.series === one).sort((a, b) => a.x - b.x);
    const path = own.map((point, at) => `${at ? 'L' : 'M'}${x.place(point.x).toFixed(1)} ${y.place(point.y).toFixed(1)}`);
    return el('path', { d: path.join(''), fill: 'none', stroke: colour(one), 'stroke-width': 1.5 });
  }) : [];
  const dots = known.map((point) => el('circle', {
    class: 'dot', cx: x.place(point.x).toFixed(1), cy: y.place(point.y).toFixed(1), r: 3.5, fill: colour(point.series),
    click: () => point.lead && point.lead(),
  }, el('title', {}, `${point.label || ''} ${told(point.x)}, ${told(point.y)}`.trim())));
  const names = series.map((name, at) => [
    el('circle', { cx: left + width + 16, cy: top + 8 + 18 * at, r: 4, fill: colour(at) }),
    el('text', { x: left + width + 26, y: top + 12 + 18 * at }, name)]);
  const ruled = guides.map(([fromX, fromY, toX, toY]) => el('line', {
    class: 'axis', 'stroke-dasharray': '4 3', x1: x.place(fromX), y1: y.place(fromY), x2: x.place(toX), y2: y.place(toY),
  }));
  return el('svg', { class: 'plot', width: left + width + (series.length ? 190 : 16), height: top + height + 44 },
    frame(title, x, y, xTitle, yTitle, [left, top, width, height]), ruled, lines, dots, names);
}

// How many numbers lie in each of some steps.
function histogram(title, values, xTitle) {
  const known = values.filter(Number.isFinite);
  const [left, top, width, height] = [64, 26, 380, 200];
  const x = axisOf(known, false, left, left + width);
  const bins = Math.max(5, Math.min(40, Math.ceil(Math.sqrt(known.length) * 1.5)));
  const [low, high] = [leastOf(known), mostOf(known)];
  const counts = new Array(bins).fill(0);
  known.forEach((value) => { counts[Math.min(bins - 1, Math.floor((bins * (value - low)) / (high - low || 1)))] += 1; });
  const most = Math.max(1, mostOf(counts));
  const y = { place: (count) => top + height * (1 - (0.95 * count) / most), marks: ticks(0, most, 5).filter(Number.isInteger) };
  const bars = known.length ? counts.map((count, at) => {
    const [from, to] = [at, at + 1].map((end) => x.place(low + ((high - low) * end) / bins));
    return el('rect', { x: from, y: y.place(count), width: Math.max(1, to - from - 1), height: top + height - y.place(count), fill: MARKS[0] },
      el('title', {}, `${count}`));
  }) : [];
  return el('svg', { class: 'plot', width: left + width + 16, height: top + height + 44 },
    frame(title, x, y, xTitle, 'grains', [left, top, width, height]), bars);
}
