'use strict';
// The part of a page about a folder of results.

const MAIN = ['volume', 'area', 'dimensions.length', 'dimensions.width', 'dimensions.thickness', 'form.elongation',
  'form.flatness', 'sphericity.wadell', 'roundness', 'heldout_rms'];

// Of these, the ones that mean nothing across units.
const isSize = (name) => /^(volume|area|dimensions|heldout_rms)/.test(name);

// Small pictures, all drawn by one viewer.
function thumbnails(lot, corners) {
  const canvas = el('canvas', { width: 176, height: 132 });
  const viewer = new Viewer(canvas, 1);
  return (at) => {
    const small = el('canvas', { width: 176, height: 132 });
    if (!lot.surfaces[at]) return small;
    showSurface(viewer, floatsOf(lot.surfaces[at]), corners);
    small.getContext('2d').drawImage(canvas, 0, 0);
    return small;
  };
}

function showSurface(viewer, places, corners) {
  if (!viewer.gl) return;
  viewer.clear();
  viewer.radius = radiusOf(places);
  viewer.add({ kind: 'triangles', places, normals: normalsOf(places, corners), corners, colour: () => [0.91, 0.8, 0.59] });
  viewer.draw();
}

// The number below which so large a share of a normal distribution lies (Winitzki 2008), to 0.002.
function normalQuantile(share) {
  const p = 2 * share - 1;
  const logarithm = Math.log(1 - p * p);
  const a = 2 / (Math.PI * 0.147) + logarithm / 2;
  return Math.SQRT2 * Math.sign(p) * Math.sqrt(Math.sqrt(a * a - logarithm / 0.147) - a);
}

// Bias and spread of what has a truth, as shares of its size, and whether standard errors are as large as errors.
function truthPart(lot, all, number, nameOf) {
  const { columns, rows } = lot.truth;
  const measures = columns.slice(1).filter((name) => lot.columns.includes(name) && name !== 'path');
  const others = columns.slice(1).filter((name) => !measures.includes(name));
  const missing = rows.filter((row) => !row).length;
  const notes = [
    others.length ? `No measure is called as these columns: ${others.join(', ')}.` : '',
    missing ? `Of ${missing} of ${rows.length} scans no truth is known.` : '',
  ].filter(Boolean);
  const found = measures.map((name) => {
    const known = all.map((row) => {
      const cell = rows[row] ? rows[row][columns.indexOf(name)] : '';
      const truth = cell ? Number(cell) : NaN;
      const error = number(row, name) - truth;
      return { row, share: error / Math.abs(truth), z: error / number(row, `${name}_se`), error };
    }).filter(({ error }) => Number.isFinite(error));
    // Nothing is a share of a truth of 0.
    const shares = known.map(({ share }) => share).filter(Number.isFinite);
    const mean = shares.reduce((sum, share) => sum + share, 0) / shares.length;
    const spread = Math.sqrt(shares.reduce((sum, share) => sum + (share - mean) ** 2, 0) / (shares.length - 1));
    const scaled = known.filter(({ z }) => Number.isFinite(z)).sort((a, b) => a.z - b.z);
    const within = scaled.filter(({ z }) => Math.abs(z) <= 1.96).length;
    return { name, mean, spread, scaled, count: shares.length, held: scaled.length ? `${within} of ${scaled.length}` : 'no errors told' };
  }).filter(({ count, scaled }) => count || scaled.length);
  const percent = (share) => (Number.isFinite(share) ? `${(100 * share).toFixed(3)} %` : 'the truth is 0');
  const cells = ({ name, count, mean, spread, held }) => [name, String(count), percent(mean), count < 2 ? '-' : percent(spread), held].map((cell) => el('td', {}, cell));
  const heads = ['measure', 'grains', 'bias', 'spread', 'within 1.96 standard errors'].map((name) => el('th', {}, name));
  const points = found.flatMap(({ scaled }, series) => scaled.map(({ row, z }, at) => ({
    x: normalQuantile((at + 0.5) / scaled.length), y: z, series, label: nameOf(row),
  })));
  return el('div', {}, el('table', {}, el('thead', {}, el('tr', {}, heads)), el('tbody', {}, found.map((one) => el('tr', {}, cells(one))))),
    notes.length ? el('p', { class: 'note' }, notes.join(' ')) : [],
    points.length ? scatter({
      title: 'Calibration of standard errors', xTitle: 'quantile of the normal distribution', yTitle: 'error / standard error',
      points, within: [-2, 2], guides: [[-2, -2, 2, 2]], series: found.map(({ name }) => name),
    }) : []);
}

function lotPart(lot, grid) {
  const corners = Uint32Array.from(grid.flat());
  const number = (row, name) => {
    const cell = lot.rows[row][lot.columns.indexOf(name)];
    return cell === undefined || cell === '' ? NaN : Number(cell);
  };
  const all = lot.rows.map((_, row) => row);
  const texts = ['path', 'status', 'reason', 'hash', 'version', 'settings', 'unit', 'no_standard_errors', 'not_measured', 'warnings'];
  const numeric = lot.columns.filter((name) => !texts.includes(name) && all.some((row) => Number.isFinite(number(row, name))));
  const main = MAIN.filter((name) => numeric.includes(name));
  // Across units no sizes are beside each other, and each row tells its own.
  const comparable = lot.lengths ? numeric : main.filter((name) => !isSize(name));
  const units = lot.lengths ? [] : ['unit'];
  const nameOf = (row) => lot.rows[row][lot.columns.indexOf('path')] || `row ${row + 1}`;

  // A grain in full, where a click leads to.
  const detail = el('div');
  const canvas = el('canvas', { width: 480, height: 360 });
  const viewer = lot.surfaces.some(Boolean) ? new Viewer(canvas, 1) : null;
  let shownRows = new Map();
  const lead = (row) => {
    shownRows.forEach((shown, at) => shown.classList.toggle('chosen', at === row));
    const cells = lot.columns.map((name, at) => [name, lot.rows[row][at]]).filter(([, cell]) => cell);
    detail.replaceChildren(el('h3', {}, nameOf(row)), el('div', { class: 'row' },
      el('figure', { class: 'view small' }, lot.surfaces[row] ? canvas : el('p', { class: 'note' }, lot.no_surface[row])),
      el('div', { class: 'wide' }, el('table', { class: 'details' }, el('tbody', {}, cells.map(([name, cell]) =>
        el('tr', {}, el('td', {}, name), el('td', {}, texts.includes(name) ? cell : toldCell(cell)))))))));
    if (lot.surfaces[row]) showSurface(viewer, floatsOf(lot.surfaces[row]), corners);
    detail.scrollIntoView({ behavior: 'smooth', block: 'nearest' });
  };

  const draw = viewer ? thumbnails(lot, corners) : null;
  const body = el('tbody');
  let order = { name: null, isUp: true };
  shownRows = new Map(all.map((row) => [row, el('tr', { class: 'leads', click: () => lead(row) },
    draw ? el('td', {}, draw(row)) : [], el('td', { class: 'path' }, nameOf(row)),
    el('td', {}, lot.rows[row][lot.columns.indexOf('reason')] || lot.rows[row][lot.columns.indexOf('status')] || ''),
    units.map((name) => el('td', {}, lot.rows[row][lot.columns.indexOf(name)] || '')),
    main.map((name) => el('td', { class: 'number' }, Number.isFinite(number(row, name)) ? told(number(row, name)) : '')))]));
  const sort = (name) => {
    order = { name, isUp: order.name === name ? !order.isUp : true };
    const key = (row) => (name === 'path' ? nameOf(row) : number(row, name));
    const compare = (a, b) => {
      const [x, y] = [key(a), key(b)];
      if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
      return (x < y ? -1 : x > y) * (order.isUp ? 1 : -1) || a - b;
    };
    body.replaceChildren();
    appendAll(body, [...all].sort(compare).map((row) => shownRows.get(row)));
  };
  const head = (name, kind) => el('th', { class: `sorts ${kind}`, click: () => sort(name) }, name);
  appendAll(body, shownRows.values());
  const table = el('table', {}, el('thead', {}, el('tr', {}, draw ? el('th') : [], head('path', ''), el('th', {}, 'status'),
    units.map((name) => el('th', {}, name)), main.map((name) => head(name, 'number')))), body);

  const plot = el('div', { class: 'row' });
  const pick = (chosen) => {
    const made = el('select', { change: () => redraw() }, comparable.map((name) => el('option', { value: name }, name)));
    made.value = comparable.includes(chosen) ? chosen : comparable[0];
    return made;
  };
  const [x, y] = [pick('volume'), pick('sphericity.wadell')];
  const redraw = () => plot.replaceChildren(
    scatter({
      title: '', xTitle: x.value, yTitle: y.value,
      points: all.map((row) => ({ x: number(row, x.value), y: number(row, y.value), label: nameOf(row), lead: () => lead(row) })),
    }),
    histogram('', all.map((row) => number(row, x.value)), x.value));
  if (comparable.length) redraw();

  const sides = ['length', 'width', 'thickness'].map((side) => `dimensions.${side}`);
  const zingg = sides.every((side) => numeric.includes(side)) ? scatter({
    title: 'Zingg diagram', xTitle: 'thickness / width', yTitle: 'width / length', within: [0, 1],
    guides: [[2 / 3, 0, 2 / 3, 1], [0, 2 / 3, 1, 2 / 3]],
    points: all.map((row) => {
      const [length, width, thickness] = sides.map((side) => number(row, side));
      return { x: thickness / width, y: width / length, label: nameOf(row), lead: () => lead(row) };
    }),
  }) : [];
  const spread = main.filter((name) => comparable.includes(name));
  const failed = all.filter((row) => lot.rows[row][lot.columns.indexOf('status')] === 'failed').length;
  return el('section', {}, el('h2', {}, lot.name),
    el('p', { class: 'note' }, `${all.length} scans, ${failed} of them without a result. A click on a heading sorts, one on a grain shows it. ${lot.lengths || ''}`),
    lot.warnings.map((warning) => el('p', { class: 'warning' }, warning)),
    el('div', { class: 'wide' }, table), detail,
    comparable.length ? [el('h3', {}, 'Any two measures'), el('p', {}, 'across ', x, ' up ', y), plot] : [],
    lot.truth ? [el('h3', {}, 'Beside the truth'), truthPart(lot, all, number, nameOf)] : [],
    el('h3', {}, 'Distributions'),
    el('div', { class: 'row' }, spread.slice(0, 8).map((name) => histogram(name, all.map((row) => number(row, name)), name)), zingg));
}
