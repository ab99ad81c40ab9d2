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

/// "0.0412 to 0.0424 mm at (29.86, 12.005, 9.648)".
export function readingText(data, frame, mesh, hit) {
  const { value, label } = data.steps;
  const within = mesh.steps[9 * hit.face], beyond = mesh.steps[9 * hit.face + 1];
  const unit = data.unit ? ` ${data.unit}` : '';
  const point = hit.point.map((x, i) => coordinate(frame.lo[i] + frame.size * x, frame.size)).join(', ');
  const low = beyond > 0 ? label[beyond - 1] : null;
  let text = within >= value.length ? (low ? `more than ${low}${unit}` : 'not known') : low ? `${low} to ${label[within]}${unit}` : `at most ${label[within]}${unit}`;
  if (within === 0) text = `0${unit}`;
  return `largest deviation of this face: ${text}, at (${point})`;
}
