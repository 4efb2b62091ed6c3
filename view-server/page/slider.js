// SPDX-License-Identifier: MIT
// A number with its range: a slider, and the value in words beside it; or a switch, where it is on or
// off.

const STEPS = 1000;
const EVERY = 40; // [ms] between two values that are sent while it is moved

const called = (title) => title.replaceAll('/', ' ').replaceAll('_', ' ').replace(' db', '');

export class Switch {
  constructor(row, title, set) {
    this.label = document.createElement('label');
    this.label.className = 'row';
    this.label.title = row.meaning;
    this.input = document.createElement('input');
    this.input.type = 'checkbox';
    this.label.append(called(title), this.input);
    this.input.addEventListener('change', () => set(this.input.checked ? 1 : 0));
    this.show(row.value);
  }

  show(value) {
    this.input.checked = value > 0.5;
  }
}

export class Slider {
  /// `row`: {name, min, max, value, logarithmic, power, unit, meaning}; `set` takes what a person
  /// chose. With a power the slider is fine near the smallest value.
  constructor(row, title, set) {
    Object.assign(this, { row, set, waiting: null });
    this.label = document.createElement('label');
    this.label.className = 'row';
    this.label.title = row.meaning;
    this.input = document.createElement('input');
    Object.assign(this.input, { type: 'range', min: 0, max: STEPS, step: 1 });
    this.output = document.createElement('output');
    this.label.append(called(title),
      this.input, this.output);
    this.input.addEventListener('input', () => this.chosen());
    this.show(row.value);
  }

  get value() {
    const { min, max, logarithmic } = this.row;
    const share = +this.input.value / STEPS;
    return logarithmic ? min * (max / min) ** share : min + share ** this.power * (max - min);
  }

  get power() {
    return this.row.power ?? 1;
  }

  chosen() {
    this.tell(this.value);
    if (this.waiting !== null) return;
    this.waiting = setTimeout(() => {
      this.waiting = null;
      this.set(this.value);
    }, EVERY);
  }

  tell(value) {
    const unit = this.row.unit === '1' ? '' : this.row.unit;
    this.output.value = `${+value.toPrecision(3)} ${unit}`;
    this.input.setAttribute('aria-valuetext', this.output.value);
  }

  /// What holds now; not while a person moves it.
  show(value) {
    if (this.waiting !== null) return;
    const { min, max, logarithmic } = this.row;
    const share = logarithmic ? Math.log(value / min) / Math.log(max / min)
      : ((value - min) / (max - min)) ** (1 / this.power);
    this.input.value = Math.round(STEPS * share);
    this.tell(value);
  }
}
