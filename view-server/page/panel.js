// SPDX-License-Identifier: MIT
// The panel: scene and rig, the sound's numbers, the rig's outputs and channels, the scene's live
// rows. Names, ranges, units and meanings are those that the programs tell with scene and rig; they
// tell changes by /value, whoever makes them.
import { Channels } from './channels.js';
import { Choice } from './choice.js';
import { Slider, Switch } from './slider.js';

const OVER = 0.5; // [s] within which a preset is gone over to
const OPENED = ['impact', 'bubble', 'cavity']; // of the groups, from the start

const behind = (name, mark) => name.slice(name.lastIndexOf(mark) + 1);

export class Panel {
  /// `at`: the element of an id; `going(what, name)`: a person chose another scene or rig.
  constructor(at, link, going) {
    Object.assign(this, { at, link, rows: new Map(), sceneRows: new Map() });
    this.channels = new Channels(at('channels'), at('channel'), link);
    this.scenes = new Choice(at('scenes'), (name) => {
      link.send('/scene', ',s', name);
      going('scene', name);
    });
    this.rigs = new Choice(at('rigs'), (name) => {
      link.send('/rig', ',s', name);
      going('rig', name);
    });
    this.presets = new Choice(at('preset'), (name) => link.send('/preset', ',sf', name, OVER));
    at('turn').addEventListener('click', () => {
      at('turn').setAttribute('aria-pressed', this.channels.turn());
    });
  }

  build(rig) {
    this.rigs.build(rig.rigs, rig.rig);
    this.presets.build(rig.sounds, 'choose');
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
    this.channels.build(rig, (row) => this.add(row, behind(row.name, '/')));
  }

  buildScene(scene) {
    this.scenes.build(scene.scenes, scene.name);
    this.sceneRows.clear();
    this.at('detection').replaceChildren();
    for (const row of scene.rows ?? []) {
      const slider = this.make(row, behind(row.name, '/'), '/param');
      this.sceneRows.set(row.name, slider);
      this.at('detection').append(slider.label);
    }
  }

  add(row, title) {
    const slider = this.make(row, title, '/set');
    this.rows.set(row.name, slider);
    return slider;
  }

  make(row, title, command) {
    const Kind = row.switch || /\/(mute|solo)$/.test(row.name) ? Switch : Slider;
    return new Kind(row, title, (value) => this.link.send(command, ',sf', row.name, value));
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
    (this.rows.get(name) ?? this.sceneRows.get(name))?.show(value);
    this.channels.value(name, value);
  }

  levels(peaks) {
    if (!this.at('panel').hidden) this.channels.levels(peaks);
  }
}
