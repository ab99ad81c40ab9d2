// The page's movable parts. All that it says stands in the page already; this shows and counts.
import { Chart, stepColours } from './chart.js';
import { readMesh } from './mesh.js';
import { makeScale } from './scale.js';
import { hasWebGL, View } from './scene.js';
import { Slider } from './slider.js';

const find = (id) => document.getElementById(id);
const data = JSON.parse(find('data').textContent);
const count = (n) => n.toLocaleString('en-US');

const PRINTED_CHART_PX = 435;  // 115 mm: the view's column of an A4 page (style.css)
const PRINTED_VIEW = [1200, 1000];  // about its shape there

// Never 0 % or 100 % of what is not none or all.
function percent(share, faces, all) {
  if (faces === 0) return '0 %';
  if (faces === all) return '100 %';
  if (share < 0.00005) return '< 0.01 %';
  if (share > 0.99995) return '> 99.99 %';
  return `${(100 * share).toFixed(2)} %`;
}

class Page {
  constructor() {
    this.side = 0;
    this.meshes = [];
    this.chart = new Chart(data);
    this.slider = new Slider(data, (step) => this.showStep(step));
    find('tally').hidden = false;
    find('chart').hidden = !(data.top > 0) && data.asked < 0;  // there is nothing to scale it by
    if (data.sides.every((side) => side.mesh) && hasWebGL() && 'DecompressionStream' in window) this.openView();
    else this.sayNoView();
    this.listen();
    find('scale').hidden = !(data.top > 0);
    this.setScale(false);
    this.showSide(0);
    this.slider.setStep(data.start);
    document.body.dataset.ready = this.view ? 'view' : 'picture';
  }

  openView() {
    try {
      this.view = new View(find('canvas'), () => this.placeMark());
    } catch {  // a browser that promised more than it has
      this.sayNoView();
      return;
    }
    find('stage').hidden = find('hint').hidden = false;
    document.querySelectorAll('.stage figure').forEach((figure) => figure.classList.add('behind'));
    this.view.resize();
  }

  sayNoView() {
    document.querySelectorAll('.no-view').forEach((p) => (p.hidden = false));
    document.querySelectorAll('.places button').forEach((button) => (button.disabled = true));
  }

  listen() {
    document.querySelectorAll('[data-direction]').forEach((button) =>
      button.addEventListener('click', () => this.showSide(Number(button.dataset.direction))));
    document.querySelectorAll('[data-point]').forEach((button) => button.addEventListener('click', () => this.showPlace(button)));
    find('scale').addEventListener('click', () => this.setScale(!this.scale.isLog));
    find('reset').addEventListener('click', () => this.showWhole());
    find('asked').addEventListener('click', () => this.slider.setStep(data.asked));
    find('colours').addEventListener('click', () => this.setDistanceOnly());
    new ResizeObserver(() => this.drawChart()).observe(find('chart'));
    window.addEventListener('beforeprint', () => this.beforePrint());
    window.addEventListener('afterprint', () => this.afterPrint());
  }

  setScale(isLog) {
    this.scale = makeScale(data, isLog);
    find('scale').setAttribute('aria-pressed', isLog);
    this.slider.setScale(this.scale);
    this.view?.setColours(stepColours(data, this.scale));
    this.drawChart();
  }

  setDistanceOnly() {
    const isOn = find('colours').getAttribute('aria-pressed') !== 'true';
    find('colours').setAttribute('aria-pressed', isOn);
    document.querySelector('.keys').hidden = isOn;
    this.view.set('distanceOnly', isOn);
  }

  drawChart(width) {
    this.chart.draw(data.sides[this.side], this.scale, width);
    if (this.slider.step !== undefined) this.chart.setTolerance(data.steps.value[this.slider.step]);
  }

  async showSide(index) {
    this.side = index;
    const side = data.sides[index];
    document.querySelectorAll('[data-direction]').forEach((button) =>
      button.setAttribute('aria-pressed', Number(button.dataset.direction) === index));
    document.querySelectorAll('[data-side]').forEach((part) => (part.hidden = Number(part.dataset.side) !== index));
    document.querySelectorAll('.stage figure').forEach((figure, i) => figure.classList.toggle('other', i !== index));
    find('tally-mesh').textContent = side.from;
    find('caption').textContent = this.view ? side.caption : '';
    find('chart-legend').replaceChildren(...this.legend(side));
    this.setMark(null);
    this.drawChart();
    if (this.slider.step !== undefined) this.showStep(this.slider.step);
    if (!this.view) return;
    const isFirst = this.meshes.length === 0;
    this.meshes[index] ??= readMesh(side.mesh, data.sides[0].mesh);
    const mesh = await this.meshes[index];
    if (this.side !== index) return;
    this.view.setMesh(mesh);
    if (isFirst) this.view.reset(true);
    document.body.dataset.shown = index;
  }

  legend(side) {
    const part = (className, text) => {
      const swatch = document.createElement('i');
      swatch.className = className;
      return [swatch, text];
    };
    const unit = data.unit ? `, ${data.unit}` : '';
    const bars = part('', `area of the faces of ${side.from} by certified upper bound${unit}`);
    return side.curve ? [...bars, ...part('band', 'share of the area within, certified')] : bars;
  }

  showStep(step) {
    const side = data.sides[this.side];
    const within = side.within[step], beyond = side.beyond[step];
    const [near, far] = [side.withinArea[step], side.beyondArea[step]];
    const rows = { within: [within, near], beyond: [beyond, far], undecided: [side.faces - within - beyond, Math.max(0, 1 - near - far)] };
    for (const [id, [faces, share]] of Object.entries(rows)) {
      const cells = find(id).querySelectorAll('td');
      cells[0].textContent = count(faces);
      cells[1].textContent = side.hasArea ? percent(share, faces, side.faces) : 'no area';
    }
    find('tolerance').textContent = this.slider.text(step);
    find('asked').hidden = data.asked < 0 || step === data.asked;
    this.chart.setTolerance(data.steps.value[step]);
    this.view?.set('tolerance', step);
  }

  showWhole() {
    this.setMark(null);
    this.view.reset();
  }

  showPlace(button) {
    const point = JSON.parse(button.dataset.point);
    const { lo, size } = data.sides[0].mesh;
    this.setMark({ button, point: point.map((x, i) => (size > 0 ? (x - lo[i]) / size : 0)) });
    this.view.show(this.mark.point, JSON.parse(button.dataset.normal));
    if (window.innerWidth < 980) find('stage').scrollIntoView({ block: 'nearest' });
  }

  setMark(mark) {
    this.mark = mark;
    document.querySelectorAll('[data-point]').forEach((button) => button.setAttribute('aria-pressed', button === mark?.button));
    find('mark').querySelector('span').textContent = mark ? mark.button.dataset.label : '';
    this.placeMark();
  }

  placeMark() {
    const at = this.mark && this.view.pixel(this.mark.point);
    find('mark').hidden = !at;
    if (at) find('mark').style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px)`;
  }

  // Where no picture came with the report, the view as it stands is printed.
  beforePrint() {
    this.drawChart(PRINTED_CHART_PX);
    const figure = document.querySelectorAll('.stage figure')[this.side];
    if (!this.view || figure.querySelector('img')) return;
    const copy = this.view.copy(...PRINTED_VIEW);
    copy.className = 'snapshot';
    figure.append(copy);
  }

  afterPrint() {
    document.querySelectorAll('.snapshot').forEach((canvas) => canvas.remove());
    this.drawChart();
  }
}

new Page();
