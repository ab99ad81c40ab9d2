// The page's movable parts. All that it says stands in the page already; this shows and measures.
import { Chart } from './chart.js';
import { readMesh } from './mesh.js';
import { drawAxes, drawRuler, readingText } from './overlay.js';
import { readScale, shareOf } from './palette.js';
import { makeScale } from './scale.js';
import { hasWebGL, View } from './scene.js';
import { rest, shareText, shareWithin } from './share.js';
import { Slider } from './slider.js';

const find = (id) => document.getElementById(id);
const findAll = (selector) => document.querySelectorAll(selector);
const data = JSON.parse(find('data').textContent);
for (const side of data.sides) side.colours = readScale(side.scale);

const PRINTED_VIEW = [1600, 1000];  // a picture's shape
const POINT = find('readout').textContent;

class Page {
  constructor() {
    this.side = 0;
    this.meshes = [];
    this.chart = new Chart();
    this.slider = new Slider(data, (step) => this.showStep(step));
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
      this.view = new View(find('canvas'), data.up, () => this.placeMarks());
    } catch {  // a browser that promised more than it has
      this.sayNoView();
      return;
    }
    find('stage').hidden = find('hint').hidden = false;
    document.body.classList.remove('no-view');
    this.view.resize();
  }

  sayNoView() {
    find('canvas').closest('.view').querySelectorAll('.no-webgl').forEach((p) => (p.hidden = !data.sides.every((side) => side.mesh)));
    findAll('.places button').forEach((button) => (button.disabled = true));
  }

  listen() {
    findAll('[data-direction]').forEach((button) => button.addEventListener('click', () => this.showSide(Number(button.dataset.direction))));
    findAll('[data-point]').forEach((button) => button.addEventListener('click', () => this.showPlace(button)));
    findAll('[data-view]').forEach((button) => button.addEventListener('click', () => this.look(button.dataset.view)));
    find('scale').addEventListener('click', () => this.setScale(!this.scale.isLog));
    find('asked').addEventListener('click', () => this.slider.setStep(data.asked));
    find('colours').addEventListener('click', () => this.setColoursAlone());
    new ResizeObserver(() => this.drawChart()).observe(find('chart'));
    window.addEventListener('beforeprint', () => this.beforePrint());
    window.addEventListener('afterprint', () => this.afterPrint());
    if (this.view) this.listenToCanvas();
  }

  listenToCanvas() {
    const canvas = find('canvas');
    const at = (event) => [event.offsetX, event.offsetY];
    let pressed = null;
    canvas.addEventListener('pointermove', (event) => this.read(at(event), event.buttons));
    canvas.addEventListener('pointerleave', () => (find('readout').textContent = this.kept ?? POINT));
    canvas.addEventListener('pointerdown', (event) => (pressed = at(event)));
    canvas.addEventListener('click', (event) => {
      const moved = pressed ? Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) : 0;
      if (moved < 4) this.keep(at(event));
    });
  }

  // Once a frame at most: a mesh of many faces takes milliseconds.
  read(pixel, buttons) {
    this.pointer = buttons ? null : pixel;
    if (this.isReading) return;
    this.isReading = true;
    requestAnimationFrame(() => {
      this.isReading = false;
      if (this.pointer) find('readout').textContent = this.reading(this.view.hit(...this.pointer)) ?? this.kept ?? POINT;
    });
  }

  reading(hit) {
    return hit && this.shown ? readingText(data, data.sides[this.side], this.shown, hit) : null;
  }

  keep(pixel) {
    const hit = this.view.hit(...pixel);
    this.setMark(hit ? { point: hit.point, label: '' } : null);
    this.kept = this.reading(hit) ?? undefined;
    find('readout').textContent = this.kept ?? POINT;
  }

  setScale(isLog) {
    this.scale = makeScale(data, isLog);
    find('scale').setAttribute('aria-pressed', isLog);
    this.slider.setScale(this.scale);
    this.drawChart();
  }

  setColoursAlone() {
    const isOn = find('colours').getAttribute('aria-pressed') !== 'true';
    find('colours').setAttribute('aria-pressed', isOn);
    this.isColoursAlone = isOn;
    this.showTolerance();
  }

  drawChart(width) {
    this.chart.draw(data.sides[this.side], this.scale, width);
    if (this.slider.step !== undefined) this.chart.setTolerance(data.steps.value[this.slider.step]);
  }

  async showSide(index) {
    this.side = index;
    const side = data.sides[index];
    findAll('[data-direction]').forEach((button) => button.setAttribute('aria-pressed', Number(button.dataset.direction) === index));
    findAll('.way').forEach((way) => way.classList.toggle('other', this.view !== undefined && Number(way.dataset.side) !== index));
    findAll('.legend').forEach((legend) => (legend.hidden = Number(legend.dataset.side) !== index));
    findAll('.tally-of').forEach((name) => (name.textContent = side.of));
    find('caption').textContent = this.view ? side.caption : '';
    find('chart-legend').replaceChildren(...this.legend(side));
    this.setMark(null);
    this.drawChart();
    if (this.slider.step !== undefined) this.showStep(this.slider.step);
    if (this.view) await this.showMesh(index);
  }

  async meshOf(index) {
    this.meshes[index] ??= readMesh(data.sides[index].mesh, data.sides[0].mesh);
    return (this.meshes[index] = await this.meshes[index]);
  }

  async showMesh(index) {
    const isFirst = this.shown === undefined;
    const mesh = await this.meshOf(index);
    if (this.side !== index) return;
    this.shown = mesh;
    this.view.setMesh(mesh, data.sides[index].colours);
    this.showTolerance();
    if (isFirst) this.view.look('corner', true);
    document.body.dataset.shown = index;
    for (let i = 0; i < data.sides.length; ++i) await this.meshOf(i);  // a print needs them all at once
  }

  legend(side) {
    if (!side.curve.length) return ['No shares were measured.'];
    const part = (className, text) => {
      const swatch = document.createElement('i');
      swatch.className = className;
      return [swatch, text];
    };
    const unit = data.unit ? `, ${data.unit}` : '';
    return [...part('', `${side.of} by deviation${unit}`), ...part('band', 'share within, from and to')];
  }

  showStep(step) {
    const side = data.sides[this.side];
    const share = shareWithin(side, data.steps.value[step], step === data.asked);
    find('within').querySelector('td').textContent = share ? shareText(share) : 'not measured';
    find('beyond').querySelector('td').textContent = share ? shareText(rest(share)) : 'not measured';
    find('tolerance').textContent = this.slider.text(step);
    find('asked').hidden = data.asked < 0 || step === data.asked;
    this.chart.setTolerance(data.steps.value[step]);
    this.showTolerance();
  }

  // The limits are those of the picture, which may differ by side; any other tolerance is the same on both.
  showTolerance() {
    const scale = data.sides[this.side].colours, { step } = this.slider;
    if (!this.view || step === undefined) return;
    const value = step === data.steps.value.length - 1 ? Infinity : data.steps.value[step];
    const within = step === data.asked ? [scale.from, scale.to] : [scale.signed ? shareOf(scale, -value) : 0, shareOf(scale, value)];
    this.view.setTolerance(...(this.isColoursAlone ? [0, 1] : within.map((share) => Math.min(Math.max(share, 0), 1))));
  }

  look(name) {
    this.setMark(null);
    this.view?.look(name);
  }

  showPlace(button) {
    const point = JSON.parse(button.dataset.point);
    const { lo, size } = data.sides[0].mesh;
    this.setMark({ button, label: button.dataset.label, point: point.map((x, i) => (size > 0 ? (x - lo[i]) / size : 0)) });
    this.view.show(this.mark.point, JSON.parse(button.dataset.normal));
    if (window.innerWidth < 980) find('stage').scrollIntoView({ block: 'nearest' });
  }

  setMark(mark) {
    this.mark = mark;
    this.kept = undefined;
    findAll('[data-point]').forEach((button) => button.setAttribute('aria-pressed', button === mark?.button));
    find('mark').querySelector('span').textContent = mark?.label ?? '';
    this.placeMark();
  }

  placeMarks() {
    this.placeMark();
    drawAxes(find('axes'), this.view.axes());
    drawRuler(find('ruler'), this.view.unitsPerPixel() * data.sides[0].mesh.size, data.unit);
  }

  placeMark() {
    const at = this.mark && this.view.pixel(this.mark.point);
    find('mark').hidden = !at;
    if (at) find('mark').style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px)`;
  }

  // Where no picture came with the report, the view is printed.
  beforePrint() {
    if (!this.view) return;
    findAll('.way').forEach((way, i) => {
      const figure = way.querySelector('figure');
      const mesh = this.meshes[i];
      if (figure.querySelector('img') || !mesh?.positions) return;
      this.view.setMesh(mesh, data.sides[i].colours);
      const copy = this.view.copy(...PRINTED_VIEW);
      copy.className = 'snapshot';
      figure.append(copy);
    });
    if (!this.shown) return;
    this.view.setMesh(this.shown, data.sides[this.side].colours);
    this.view.look('corner', true);
  }

  afterPrint() {
    findAll('.snapshot').forEach((canvas) => canvas.remove());
    this.view?.resize();
    this.drawChart();
  }
}

new Page();
