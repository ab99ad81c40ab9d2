// Distribution of the area, colour bar and axis, over one scale of deviations.
import { colourOf } from './palette.js';
import { short } from './scale.js';
import { shareWithin } from './share.js';

const HEIGHT = 110, TOP = 18, BARS = 60;

function element(parent, name, attributes, text) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

const percent = (share) => `${Number((100 * share).toPrecision(3))} %`;
const middle = (enclosed) => (enclosed[0] + enclosed[1]) / 2;

/// Bars [from, to, share of the area in between]: the middle of what the survey encloses.
export function bars(side, scale) {
  const out = [];
  let from = scale.value(0), before = 0;
  for (let i = 1; i <= BARS; ++i) {
    const to = scale.value(i / BARS);
    const now = middle(shareWithin(side, to, false));
    out.push([from, to, now - before]);
    [from, before] = [to, now];
  }
  return out;
}

function drawBars(svg, list, x) {
  const most = Math.max(...list.map((bar) => bar[2]), 0);
  if (most === 0) return;
  const group = element(svg, 'g', { class: 'bars' });
  for (const [from, to, share] of list) {
    if (share <= 0) continue;
    const height = Math.max((share / most) * (HEIGHT - TOP), 1);  // a bar of hardly any area is seen, too
    element(group, 'rect', { x: x(from) + 0.5, width: Math.max(x(to) - x(from) - 1, 1), y: HEIGHT - height, height });
  }
  element(svg, 'line', { class: 'rule', x1: 0, x2: x.width, y1: TOP, y2: TOP });
  element(svg, 'text', { x: 0, y: TOP - 5 }, percent(most));
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
  element(svg, 'text', { x: x.width, y: TOP - 5, 'text-anchor': 'end' }, '100 %');
}

export class Chart {
  constructor() {
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
      svg.setAttribute('viewBox', `0 0 ${width} ${svg === this.axis ? 20 : HEIGHT}`);
    }
    if (side.curve.length) {
      drawBars(this.histogram, bars(side, scale), x);
      drawBand(this.histogram, side.curve, x);
    }
    this.line = element(this.histogram, 'line', { class: 'tolerance', y1: TOP, y2: HEIGHT });
    this.drawAxis(scale, x);
    this.drawGradient(side, scale);
  }

  drawAxis(scale, x) {
    let end = -Infinity;
    for (const tick of scale.ticks) {
      const at = x(tick);
      const anchor = at < 8 ? 'start' : at > x.width - 20 ? 'end' : 'middle';
      element(this.axis, 'line', { class: 'tick', x1: at, x2: at, y1: 0, y2: 4 });
      if (at - end < 42) continue;
      end = at;
      element(this.axis, 'text', { x: at, y: 16, 'text-anchor': anchor }, short(tick));
    }
  }

  // Signed colours: the ones over the other mesh are above, the ones under it below.
  drawGradient(side, scale) {
    const context = this.gradient.getContext('2d');
    this.gradient.width = 512;
    for (let i = 0; i < 512; ++i) {
      const value = scale.value(i / 511);
      [value, side.scale.signed ? -value : value].forEach((distance, row) => {
        context.fillStyle = `rgb(${colourOf(side.colours, distance).join()})`;
        context.fillRect(i, row, 1, 1);
      });
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
