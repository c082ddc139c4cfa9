'use strict';
// What all parts of the page share: the record, elements, packed numbers, colours, numbers for people.

const problems = [];
window.addEventListener('error', (event) => problems.push(event.message));

const record = JSON.parse(document.getElementById('record').textContent);

// An element with attributes; functions among them listen to events. Text is never read as HTML.
function el(tag, attributes = {}, ...children) {
  const isDrawn = ['svg', 'g', 'path', 'line', 'rect', 'circle', 'text', 'image', 'title'].includes(tag);
  const made = isDrawn ? document.createElementNS('http://www.w3.org/2000/svg', tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name, value);
    else made.setAttribute(name, value);
  }
  appendAll(made, children.flat(Infinity));
  return made;
}

// One after the other: as arguments of one call, so many as a large lot has are too many.
function appendAll(parent, children) {
  for (const child of children) parent.append(child);
}

// The least and the largest of numbers, likewise; of none Infinity and -Infinity.
const leastOf = (values) => values.reduce((least, value) => Math.min(least, value), Infinity);
const mostOf = (values) => values.reduce((most, value) => Math.max(most, value), -Infinity);

function bytesOf(text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}
const floatsOf = (text) => new Float32Array(bytesOf(text).buffer);
const countsOf = (text) => new Uint32Array(bytesOf(text).buffer);
const unitsOf = (text) => Float32Array.from(new Int8Array(bytesOf(text).buffer), (part) => part / 127);

// Numbers of a field from which to which colours go: with a sign, as far below zero as above.
function rangeOf(values, isSigned) {
  const sorted = Float32Array.from(values).filter(Number.isFinite).map((x) => (isSigned ? Math.abs(x) : x)).sort();
  if (!sorted.length) return [-1, 1];
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  if (isSigned) {
    const high = roundUp(at(0.99)) || 1;
    return [-high, high];
  }
  const [low, high] = [at(0.005), at(0.995)];
  return high > low ? [low, high] : [low - 0.5 * Math.abs(low) - 1e-30, low + 0.5 * Math.abs(low) + 1e-30];
}

function roundUp(value) {
  if (!(value > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= value * (1 - 1e-9));
}

// The colour of a number within a range; grey where it is not known.
function colourOf(value, [low, high], steps) {
  if (!Number.isFinite(value)) return [150, 150, 150];
  const share = Math.min(1, Math.max(0, (value - low) / (high - low)));
  return steps[Math.round(share * (steps.length - 1))];
}

function ticks(low, high, most) {
  const step = roundUp((high - low) / most);
  const marks = [];
  if (!(step > 0)) return marks;
  for (let i = Math.ceil(low / step - 1e-6); i * step <= high + 1e-6 * step; i += 1) marks.push(i * step);
  return marks;
}

// A number in four digits at most, or so many.
function told(value, digits = 4) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e-4 && size < 1e6 ? String(Number(value.toPrecision(digits)))
    : value.toExponential(digits - 2).replace(/\.?0+e/, 'e');
}

// A cell of a table: other numbers than whole ones in four digits, all else as it is.
function toldCell(cell) {
  const value = Number(cell);
  return Number.isFinite(value) && !Number.isSafeInteger(value) ? told(value) : cell;
}

// Marks of an axis, each in so many digits that it is told where it is.
function toldApart(marks) {
  const step = leastOf(marks.slice(1).map((mark, at) => mark - marks[at]));
  return marks.map((mark) => {
    for (let digits = 4; digits < 15; digits += 1) {
      const text = told(mark, digits);
      if (!(Math.abs(Number(text) - mark) > 0.01 * step)) return text;
    }
    return told(mark, 15);
  });
}

const isDark = () => matchMedia('(prefers-color-scheme: dark)').matches;
