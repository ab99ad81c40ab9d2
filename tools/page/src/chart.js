// Histogram, certified curve, colour bar and axis, over one scale of distances.
import { short } from './scale.js';
import { viridis } from './viridis.js';

const HEIGHT = 124, TOP = 20, BARS = 70;

function element(parent, name, attributes, text) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

const percent = (share) => `${Number((100 * share).toPrecision(3))} %`;

/// Bars between steps: each [from, to, share of the area of the faces whose upper is in there].
export function bars(data, side, scale) {
  const { value, linear, log } = data.steps;
  const flags = scale.isLog ? log : linear;
  const edges = value.map((_, i) => i).filter((i) => flags[i] && value[i] > (scale.lo ?? 0) && value[i] <= scale.hi * 1.0001);
  const each = Math.max(1, Math.round(edges.length / BARS));
  const out = [];
  let before = 0, from = scale.lo ?? 0;
  for (let i = each - 1; ; i += each) {
    const edge = edges[Math.min(i, edges.length - 1)];
    if (edge === undefined) return out;
    out.push([from, value[edge], side.withinArea[edge] - before]);
    before = side.withinArea[edge];
    from = value[edge];
    if (i >= edges.length - 1) return out;
  }
}

function drawBars(svg, list, x) {
  const most = Math.max(...list.map((bar) => bar[2]), 0);
  if (most === 0) return;
  const y = (share) => HEIGHT - (share / most) * (HEIGHT - TOP);
  const group = element(svg, 'g', { class: 'bars' });
  for (const [from, to, share] of list) {
    if (share <= 0) continue;
    const height = Math.max(HEIGHT - y(share), 1);  // a bar of hardly any area is seen, too
    element(group, 'rect', { x: x(from) + 0.5, width: Math.max(x(to) - x(from) - 1, 1), y: HEIGHT - height, height });
  }
  element(svg, 'line', { class: 'rule', x1: 0, x2: x.width, y1: TOP, y2: TOP });
  element(svg, 'text', { x: 0, y: TOP - 6 }, percent(most));
}

// Between two distances the share is at least that of the smaller, at most that of the larger.
function drawBand(svg, curve, x) {
  const y = (share) => HEIGHT - share * (HEIGHT - TOP);
  const low = [], high = [];
  curve.forEach(([distance, lower], i) => {
    const next = curve[i + 1];
    low.push([x(distance), y(lower)]);
    if (!next) return;
    low.push([x(next[0]), y(lower)]);
    high.push([x(distance), y(next[2])], [x(next[0]), y(next[2])]);
  });
  const last = curve[curve.length - 1];
  high.push([x(last[0]), y(last[2])]);
  const points = [...low, ...high.reverse()].map((p) => p.map((v) => v.toFixed(1)).join()).join(' ');
  element(svg, 'polygon', { class: 'band', points });
  element(svg, 'text', { x: x.width, y: TOP - 6, 'text-anchor': 'end' }, '100 %');
}

export class Chart {
  constructor(data) {
    this.data = data;
    this.histogram = document.getElementById('histogram');
    this.axis = document.getElementById('axis');
    this.gradient = document.getElementById('gradient');
  }

  /// `width`: of a page that is printed, which nothing can be asked of before.
  draw(side, scale, width = this.histogram.clientWidth) {
    if (!width) return;
    const x = (value) => Math.min(Math.max(scale.at(value), 0), 1) * width;
    x.width = width;
    this.x = x;
    for (const svg of [this.histogram, this.axis]) {
      svg.replaceChildren();
      svg.setAttribute('viewBox', `0 0 ${width} ${svg === this.axis ? 38 : HEIGHT}`);
    }
    drawBars(this.histogram, bars(this.data, side, scale), x);
    if (side.curve) drawBand(this.histogram, side.curve, x);
    this.line = element(this.histogram, 'line', { class: 'tolerance', y1: TOP, y2: HEIGHT });
    this.drawAxis(scale, x);
    this.drawGradient(scale);
  }

  drawAxis(scale, x) {
    for (const tick of scale.ticks) {
      const at = x(tick);
      const anchor = at < 8 ? 'start' : at > x.width - 20 ? 'end' : 'middle';
      element(this.axis, 'line', { class: 'tick', x1: at, x2: at, y1: 0, y2: 4 });
      element(this.axis, 'text', { x: at, y: 16, 'text-anchor': anchor }, short(tick));
    }
    const { lower, upper } = this.data.interval;
    if (upper === null) return;
    const from = x(lower), to = x(upper);
    element(this.axis, 'path', { class: 'ends', d: `M${from - 5} 29L${from} 21H${to}L${to + 5} 29Z` });
    const isLeft = (from + to) / 2 < x.width / 2;
    const label = { class: 'label', x: isLeft ? to + 10 : from - 10, y: 31, 'text-anchor': isLeft ? 'start' : 'end' };
    element(this.axis, 'text', label, this.data.interval.name);
  }

  drawGradient(scale) {
    const canvas = this.gradient, share = Math.min(scale.at(this.data.top), 1);
    canvas.width = 512;
    canvas.style.width = `${100 * share}%`;
    const context = canvas.getContext('2d');
    for (let i = 0; i < 512; ++i) {
      context.fillStyle = `rgb(${viridis(i / 511).join()})`;
      context.fillRect(i, 0, 1, 1);
    }
  }

  setTolerance(value) {
    if (!this.x) return;
    const at = this.x(value);
    this.line.setAttribute('x1', at);
    this.line.setAttribute('x2', at);
    document.getElementById('knob').style.left = `${(100 * at) / this.x.width}%`;
  }
}

/// The colour of each step: of faces whose upper is at most the step's distance.
export function stepColours(data, scale) {
  const end = Math.min(scale.at(data.top), 1) || 1;
  const colours = data.steps.value.map((value) => viridis(scale.at(value) / end));
  return [...colours, [128, 128, 128]];
}
