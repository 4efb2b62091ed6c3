// SPDX-License-Identifier: MIT
// The rig's channels as buttons, tiles as they lie: a tap sounds a channel and opens its mute and
// trim, so that a floor can be set up from a tablet.

const EVERY = 1100; // [ms] from one channel's tone to the next one's

export class Channels {
  constructor(grid, chosen, link) {
    Object.assign(this, { grid, chosen, link, cells: [], sliders: [], muted: [], timer: null });
  }

  /// `slider` makes one of a row.
  build(rig, slider) {
    this.stop();
    this.grid.replaceChildren();
    this.chosen.replaceChildren();
    const rows = new Map((rig.rows ?? []).map((row) => [row.name, row]));
    this.names = rig.channels;
    this.cells = rig.channels.map((name, channel) => this.cell(name, channel));
    this.sliders = rig.channels.map((name) => {
      const row = rows.get(`rig/${name}/trim_db`);
      return row ? slider(row) : null;
    });
    for (const output of rig.outputs) this.lay(output);
    rig.channels.forEach((name, channel) =>
      this.mark(channel, rows.get(`rig/${name}/mute`)?.value > 0));
  }

  cell(name, channel) {
    const button = document.createElement('button');
    button.textContent = channel + 1;
    button.title = name;
    button.setAttribute('aria-label', `Channel ${channel + 1}, ${name}: a tone`);
    button.addEventListener('click', () => this.play(channel));
    return button;
  }

  /// Seen from above: y grows upwards.
  lay({ kind, first, channels, tiles }) {
    const part = document.createElement('div');
    part.className = 'channels';
    const columns = kind === 'tiles' ? tiles[0] : channels;
    part.style.gridTemplateColumns = `repeat(${columns}, minmax(34px, 1fr))`;
    for (let row = Math.ceil(channels / columns) - 1; row >= 0; --row) {
      for (let i = 0; i < columns && row * columns + i < channels; ++i) {
        part.append(this.cells[first + row * columns + i]);
      }
    }
    this.grid.append(part);
  }

  play(channel) {
    this.link.send('/tone', ',i', channel + 1);
    this.choose(channel);
  }

  choose(channel) {
    const name = document.createElement('span');
    name.textContent = `${channel + 1}: ${this.names[channel]}`;
    const mute = document.createElement('button');
    mute.textContent = 'Mute';
    mute.setAttribute('aria-pressed', this.muted[channel]);
    mute.addEventListener('click', () => {
      this.link.send('/set', ',sf', `rig/${this.names[channel]}/mute`, this.muted[channel] ? 0 : 1);
    });
    this.chosen.replaceChildren(name, mute);
    if (this.sliders[channel]) this.chosen.append(this.sliders[channel].label);
    this.button = { channel, mute };
  }

  mark(channel, muted) {
    this.muted[channel] = muted;
    this.cells[channel].classList.toggle('muted', muted);
    if (this.button?.channel === channel) this.button.mute.setAttribute('aria-pressed', muted);
  }

  value(name, value) {
    const channel = this.names?.findIndex((one) => name === `rig/${one}/mute`) ?? -1;
    if (channel >= 0) this.mark(channel, value > 0);
  }

  levels(peaks) {
    this.cells.forEach((cell, channel) => {
      const db = 20 * Math.log10(Math.max(peaks[channel] ?? 0, 1e-6));
      cell.style.setProperty('--level', Math.min(Math.max(1 + db / 60, 0), 1).toFixed(3));
    });
  }

  /// One after the other, or no more; whether they do.
  turn() {
    if (this.timer !== null) {
      this.stop();
      return false;
    }
    let next = 0;
    const step = () => {
      if (next >= this.cells.length) next = 0;
      this.play(next++);
    };
    this.timer = setInterval(step, EVERY);
    step();
    return true;
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
  }
}
