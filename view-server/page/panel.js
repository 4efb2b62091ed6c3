// SPDX-License-Identifier: MIT
// The panel: the sound's numbers, the rig's outputs and channels. Names, ranges, units and meanings
// are those that the synth tells with its rig; it tells changes by /value, whoever makes them.
import { Channels } from './channels.js';
import { Slider, Switch } from './slider.js';

const PRESETS = ['cirio2013', 'calibrated', 'loudspeaker', 'deep', 'drops'];
const OVER = 0.5; // [s] within which a preset is gone over to
const OPENED = ['impact', 'bubble', 'cavity']; // of the groups, from the start

export class Panel {
  /// `at`: the element of an id.
  constructor(at, link) {
    Object.assign(this, { at, link, rows: new Map() });
    this.channels = new Channels(at('channels'), at('channel'), link);
    for (const name of PRESETS) at('preset').add(new Option(name, name));
    at('preset').addEventListener('change', () => {
      if (at('preset').value) link.send('/preset', ',sf', at('preset').value, OVER);
    });
    at('turn').addEventListener('click', () => {
      at('turn').setAttribute('aria-pressed', this.channels.turn());
    });
  }

  build(rig) {
    this.rows.clear();
    this.at('rows').replaceChildren();
    this.at('outputs').replaceChildren();
    const ofChannels = new Set(rig.channels.map((name) => `rig/${name}`));
    for (const row of rig.rows ?? []) {
      const group = row.name.slice(0, row.name.lastIndexOf('/'));
      if (ofChannels.has(group) && /\/(trim_db|mute|solo)$/.test(row.name)) continue;
      const own = group.startsWith('rig/');
      const slider = this.add(row, own ? row.name.slice(4) : row.name.slice(group.length + 1));
      if (own) this.at('outputs').append(slider.label);
      else this.group(group).append(slider.label);
    }
    this.channels.build(rig, (row) => this.add(row, row.name.slice(row.name.lastIndexOf('/') + 1)));
  }

  add(row, title) {
    const Kind = /\/(mute|solo)$/.test(row.name) ? Switch : Slider;
    const slider = new Kind(row, title, (value) => this.link.send('/set', ',sf', row.name, value));
    this.rows.set(row.name, slider);
    return slider;
  }

  group(name) {
    const known = [...this.at('rows').children].find((child) => child.dataset.group === name);
    if (known) return known;
    const made = document.createElement('details');
    made.dataset.group = name;
    made.open = OPENED.includes(name);
    const title = document.createElement('summary');
    title.textContent = name;
    made.append(title);
    this.at('rows').append(made);
    return made;
  }

  value([name, value]) {
    this.rows.get(name)?.show(value);
    this.channels.value(name, value);
  }

  levels(peaks) {
    if (!this.at('panel').hidden) this.channels.levels(peaks);
  }
}
