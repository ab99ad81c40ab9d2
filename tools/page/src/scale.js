// Where a deviation is along the axis that chart, colour bar and slider share.
import { shareWithin } from './share.js';

const log10 = Math.log10;
const FAR = 5;  // with a higher top, relative to the colour bar's end, everything else would be squeezed

/// Little of each surface is within this distance; the first bar is for that.
function leastOf(data, hi) {
  const { value, log } = data.steps;
  const isEmpty = (v) => data.sides.every((side) => (shareWithin(side, v, false) ?? [0, 1])[1] < 0.02);
  return value.reduce((least, v, i) => (log[i] && v <= hi / 10 && isEmpty(v) ? Math.max(least, v) : least), hi / 1e4);
}

/// {at: value -> 0..1, value: 0..1 -> value, ticks, stops: the steps that the slider stops at}.
export function makeScale(data, isLog) {
  const { value, linear, log } = data.steps;
  const asked = data.asked >= 0 ? value[data.asked] : 0;
  const top = !isLog && data.top > FAR * data.bar ? data.bar : data.top;
  const reached = value.find((v) => v >= top && v > 0) || top || asked || 1;
  const hi = asked > reached && asked <= 4 * reached ? asked * 1.03 : reached;
  const chosen = isLog ? log : linear;
  const stops = value.map((_, i) => i).filter((i) => chosen[i] || log[i] && value[i] > data.bar || i === data.asked || value[i] === 0);
  if (!isLog) {
    return { isLog, hi, stops, at: (v) => v / hi, value: (t) => t * hi, ticks: linearTicks(hi) };
  }
  const lo = leastOf(data, hi);
  const span = log10(hi / lo);
  return { isLog, hi, lo, stops, at: (v) => (v > lo ? log10(v / lo) / span : 0), value: (t) => (t <= 0 ? 0 : lo * 10 ** (t * span)),
    ticks: logTicks(lo, hi) };
}

function linearTicks(hi) {
  const unit = 10 ** Math.floor(log10(hi / 5));
  const width = [10, 5, 2, 1].map((f) => f * unit).find((w) => hi / w >= 4) || unit;
  const ticks = [];
  for (let i = 0; i * width <= hi * 1.0001; ++i) ticks.push(i * width);
  return ticks;
}

function logTicks(lo, hi) {
  const factors = log10(hi / lo) > 2.5 ? [1] : [1, 2, 5];
  const ticks = [];
  for (let e = Math.floor(log10(lo)); e <= log10(hi); ++e) {
    for (const f of factors) {
      const tick = Number(`${f}e${e}`);
      if (tick > lo && tick <= hi) ticks.push(tick);
    }
  }
  return ticks;
}

export function short(value) {
  const v = Number(value.toPrecision(6));
  return v !== 0 && (v < 1e-4 || v >= 1e6) ? v.toExponential() : String(v);
}
