// The overlay of the view: the axes, the ruler, and the reading under the cursor.

const COLOURS = ['#b3161f', '#146c37', '#1f56b5'];

function element(parent, name, attributes, text) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
}

/// Draws x, y and z as they lie on the screen, the farthest first.
export function drawAxes(svg, axes) {
  svg.replaceChildren();
  const order = [0, 1, 2].sort((i, j) => axes[i][2] - axes[j][2]);
  for (const i of order) {
    const [x, y] = axes[i];
    element(svg, 'line', { x1: 0, y1: 0, x2: 28 * x, y2: -28 * y, stroke: COLOURS[i], 'stroke-width': 2.5 });
    element(svg, 'text', { x: 37 * x, y: -37 * y + 4, 'text-anchor': 'middle', fill: COLOURS[i] }, 'xyz'[i]);
  }
}

/// Draws a round length, about a hundred pixels wide. `unitsPerPixel`: in the files' unit.
export function drawRuler(ruler, unitsPerPixel, unit) {
  const most = 110 * unitsPerPixel;
  ruler.hidden = !(most > 0);
  if (ruler.hidden) return;
  const power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map((f) => f * power).find((l) => l <= most) ?? power;
  ruler.querySelector('i').style.width = `${length / unitsPerPixel}px`;
  ruler.querySelector('span').textContent = `${Number(length.toPrecision(1))}${unit ? ` ${unit}` : ''}`;
}

/// A coordinate, to a hundred-thousandth of the mesh's size: what the page keeps of it.
function coordinate(x, size) {
  const decimals = Math.min(Math.max(Math.ceil(-Math.log10(size * 1e-5)), 0), 15);
  return Number(x.toFixed(decimals)).toString();
}

// Four digits, rounded to nearest, down (-1) or up (1).
function digits(x, way) {
  if (x === 0 || !isFinite(x)) return String(x);
  const unit = 10 ** (Math.floor(Math.log10(Math.abs(x))) - 3);
  const rounded = way < 0 ? Math.floor(x / unit) * unit : way > 0 ? Math.ceil(x / unit) * unit : x;
  return String(Number(rounded.toPrecision(4))).replace('-', '\u2212');
}

// The barycentrics of a point of a face, as it is shown.
function weightsOf(positions, face, point) {
  const [a, b, c] = [0, 1, 2].map((i) => positions.subarray(9 * face + 3 * i, 9 * face + 3 * i + 3));
  const from = (p, q) => [0, 1, 2].map((i) => q[i] - p[i]);
  const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const [u, v, w] = [from(a, b), from(a, c), from(a, point)];
  const [uu, uv, vv, wu, wv] = [dot(u, u), dot(u, v), dot(v, v), dot(w, u), dot(w, v)];
  const area = uu * vv - uv * uv;
  if (!(area > 0)) return [1, 0, 0];
  const t = [(vv * wu - uv * wv) / area, (uu * wv - uv * wu) / area].map((x) => Math.min(Math.max(x, 0), 1));
  const sum = Math.max(t[0] + t[1], 1);
  return [1 - (t[0] + t[1]) / sum, t[0] / sum, t[1] / sum];
}

/// The shown distance at a point, and the width of its proven interval.
function distanceAt(mesh, hit) {
  const weights = weightsOf(mesh.positions, hit.face, hit.point);
  const value = weights.reduce((sum, w, i) => sum + w * mesh.distances[3 * hit.face + i], 0);
  return { value, width: mesh.widths[hit.face], flags: mesh.flags[hit.face] };
}

/// "0.0418 mm, between 0.0412 and 0.0424 mm, at (29.86, 12.005, 9.648)".
export function readingText(data, side, mesh, hit) {
  const { value, width, flags } = distanceAt(mesh, hit);
  const isSigned = side.scale.signed && !(flags & 2);
  const unit = data.unit ? ` ${data.unit}` : '';
  const low = isSigned ? value - width : Math.max(value - width, 0), high = value + width;
  const frame = data.sides[0].mesh;
  const point = hit.point.map((x, i) => coordinate(frame.lo[i] + frame.size * x, frame.size)).join(', ');
  const plus = isSigned && low > 0 ? '+' : '';
  const where = isSigned && low > 0 ? ` over ${side.to}` : isSigned && high < 0 ? ` under ${side.to}` : '';
  const ends = isFinite(width) ? `between ${digits(low, -1)} and ${digits(high, 1)}${unit}` : `at least ${digits(value, -1)}${unit}`;
  const what = side.decimated ? 'farthest about here: ' : '';
  const more = (flags & 2 && side.scale.signed ? ', side not known' : '') + (flags & 1 ? ', not resolved' : '') + (flags & 4 ? ', left out' : '');
  return `${what}${plus}${digits(value, 0)}${unit}${where}${more}, ${ends}, at (${point})`;
}
