// SPDX-License-Identifier: MIT
// A game controller: holding its first button (or right trigger) takes the first body that is not
// held; the left stick moves it along the floor as seen, the right one up and down and around z.
import { about, add, clamp, product, scale } from './vector.js';

const SPEED = 1.6; // [m/s] at a stick's end
const TURN = 2.5; // [rad/s]
const DEAD = 0.12;

const axis = (x) => (Math.abs(x) < DEAD ? 0 : (x - Math.sign(x) * DEAD) / (1 - DEAD));

export class Gamepads {
  constructor(camera, solids, grabs) {
    Object.assign(this, { camera, solids, grabs, held: new Map(), before: performance.now() });
  }

  /// Once a picture.
  poll() {
    const now = performance.now();
    const step = clamp((now - this.before) / 1000, 0, 0.1);
    this.before = now;
    for (const pad of navigator.getGamepads?.() ?? []) if (pad) this.follow(pad, step);
  }

  follow(pad, step) {
    const holder = `gamepad ${pad.index}`;
    const pressed = pad.buttons[0]?.pressed || pad.buttons[7]?.pressed;
    let hold = this.held.get(holder);
    if (!pressed || !pad.connected) {
      if (hold) this.grabs.letGo(holder);
      this.held.delete(holder);
      return;
    }
    if (!hold) {
      const index = this.solids.bodies.findIndex((body, i) => !body.free && !this.grabs.isHeld(i));
      if (index < 0) return;
      const { place, turn } = this.solids.bodies[index];
      if (!this.grabs.take(holder, index, place, turn)) return;
      this.held.set(holder, (hold = { place, turn }));
    }
    const [lx, ly, rx, ry] = [0, 1, 2, 3].map((i) => axis(pad.axes[i] ?? 0));
    const a = this.camera.azimuth;
    const right = [-Math.sin(a), Math.cos(a), 0];
    const back = [Math.cos(a), Math.sin(a), 0];
    const way = add(add(scale(right, lx), scale(back, ly)), [0, 0, -ry]);
    hold.place = add(hold.place, scale(way, SPEED * step))
      .map((x, i) => clamp(x, this.grabs.box.lower[i], this.grabs.box.upper[i]));
    hold.turn = product(about([0, 0, 1], -rx * TURN * step), hold.turn);
    this.grabs.move(holder, hold.place, hold.turn);
  }
}
