// SPDX-License-Identifier: MIT
// The sound's numbers: asked for with /get, moved with /set, told by /value. Names and ranges are
// those of configs/sounds/README.md.

const VOICES = { impact: ['gain_db', 'frequency', 'q', 'release'],
  bubble: ['gain_db', 'pitch', 'damping', 'rise', 'physical'],
  cavity: ['gain_db', 'pitch', 'damping', 'rise', 'physical'] };
const RANGES = { gain_db: [-60, 24, 'dB'], frequency: [20, 2000, 'Hz'], q: [0.6, 50, ''],
  release: [0.01, 5, 's'], pitch: [0.05, 20, ''], damping: [0.1, 20, ''], rise: [0, 1, ''],
  physical: [0, 1, ''] };
const PRESETS = ['cirio2013', 'calibrated', 'loudspeaker', 'deep', 'drops'];
const OVER = 0.5; // [s] within which a preset is gone over to

export class Panel {
  constructor(root, chooser, link) {
    Object.assign(this, { root, link, rows: new Map(), outputs: [] });
    for (const name of PRESETS) chooser.add(new Option(name, name));
    chooser.addEventListener('change', () => {
      if (chooser.value) link.send('/preset', ',sf', chooser.value, OVER);
      setTimeout(() => this.askAll(), 1000 * OVER + 200);
    });
  }

  build(rig) {
    this.root.replaceChildren();
    this.rows.clear();
    for (const { name } of rig.outputs) this.add(`rig/${name}/gain_db`, [-60, 24, 'dB']);
    for (const [voice, keys] of Object.entries(VOICES)) {
      for (const key of keys) this.add(`${voice}/${key}`, RANGES[key]);
    }
    this.askAll();
  }

  add(name, [low, high, unit]) {
    const even = low <= 0; // else by ratios
    const label = document.createElement('label');
    const slider = document.createElement('input');
    const shown = document.createElement('output');
    label.className = 'row';
    label.append(name.replaceAll('/', ' ').replaceAll('_db', ''), slider, shown);
    Object.assign(slider, { type: 'range', min: 0, max: 1, step: 0.002, disabled: true });
    const toValue = (t) => (even ? low + t * (high - low) : low * (high / low) ** t);
    const toShare = (v) => (even ? (v - low) / (high - low) : Math.log(v / low) / Math.log(high / low));
    const show = (value) => {
      shown.value = `${value.toPrecision(3)} ${unit}`;
      slider.setAttribute('aria-valuetext', shown.value);
    };
    slider.addEventListener('input', () => {
      show(toValue(+slider.value));
      this.link.send('/set', ',sf', name, toValue(+slider.value));
    });
    this.rows.set(name, (value) => {
      slider.disabled = false;
      show(value);
      if (document.activeElement !== slider) slider.value = toShare(value);
    });
    this.root.append(label);
  }

  /// A few at a time: the synth answers a host only so often.
  askAll() {
    [...this.rows.keys()].forEach((name, i) =>
      setTimeout(() => this.link.send('/get', ',s', name), 130 * i));
  }

  value([name, value]) {
    this.rows.get(name)?.(value);
  }
}
