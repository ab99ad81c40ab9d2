// The tolerance, dragged along the colour bar or moved by keys from step to step.

export class Slider {
  constructor(data, onStep) {
    this.data = data;
    this.onStep = onStep;
    this.element = document.getElementById('slider');
    this.element.addEventListener('pointerdown', (event) => this.drag(event));
    this.element.addEventListener('keydown', (event) => this.key(event));
  }

  setScale(scale) {
    this.scale = scale;
    const reached = scale.stops.filter((i) => this.data.steps.value[i] <= scale.hi * 1.0001 || i === this.data.asked);
    this.stops = reached;
    this.element.setAttribute('aria-valuemax', this.data.steps.value[reached[reached.length - 1]]);
  }

  setStep(step) {
    this.step = step;
    this.element.setAttribute('aria-valuenow', this.data.steps.value[step]);
    this.element.setAttribute('aria-valuetext', this.text(step));
    this.onStep(step);
  }

  text(step) {
    return this.data.steps.label[step] + (this.data.unit ? ` ${this.data.unit}` : '');
  }

  drag(event) {
    if (event.button > 0) return;
    event.preventDefault();
    this.element.focus();
    this.element.setPointerCapture(event.pointerId);
    const move = (at) => this.setStep(this.nearest(at.clientX));
    const end = () => {
      this.element.removeEventListener('pointermove', move);
      this.element.removeEventListener('pointerup', end);
      this.element.removeEventListener('pointercancel', end);
    };
    this.element.addEventListener('pointermove', move);
    this.element.addEventListener('pointerup', end);
    this.element.addEventListener('pointercancel', end);
    move(event);
  }

  nearest(x) {
    const box = this.element.getBoundingClientRect();
    const aim = Math.min(Math.max((x - box.left) / box.width, 0), 1);
    const away = (i) => Math.abs(Math.min(this.scale.at(this.data.steps.value[i]), 1) - aim);
    return this.stops.reduce((best, i) => (away(i) < away(best) ? i : best));
  }

  key(event) {
    const value = this.data.steps.value;
    const here = this.stops.findLastIndex((i) => value[i] <= value[this.step]);
    const moves = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10, Home: -Infinity, End: Infinity };
    const move = moves[event.key];
    if (move === undefined) return;
    event.preventDefault();
    const isBetween = move < 0 && value[this.stops[here]] < value[this.step];  // a stop of the other scale
    const next = Math.min(Math.max(here + move + (isBetween ? 1 : 0), 0), this.stops.length - 1);
    this.setStep(this.stops[next]);
  }
}
