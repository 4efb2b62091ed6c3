// SPDX-License-Identifier: MIT
// Mouse, pen and fingers: on a body they hold it in the view plane, on the background they turn the
// camera; the wheel moves what is held in depth, else the camera; two fingers zoom.
import { rayHits } from './triangles.js';
import { about, add, conjugate, dot, product, scale, sub, turn } from './vector.js';

/// The first comes as the hand moves, the other once a picture.
const MOVES = 'onpointerrawupdate' in window ? 'pointerrawupdate' : 'pointermove';

export class Pointers {
  /// `refused(index)`: another visitor holds the body that was to be taken.
  constructor(canvas, camera, solids, grabs, refused) {
    Object.assign(this, { canvas, camera, solids, grabs, refused });
    this.down = new Map(); // pointer id -> {x, y, depth, offset} or {x, y} of the camera
    const on = (name, act) => canvas.addEventListener(name, act, { passive: false });
    on('pointerdown', (e) => this.start(e));
    on('pointermove', (e) => this.go(e));
    on(MOVES, (e) => this.drag(e));
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      on(name, (e) => this.end(e));
    }
    on('wheel', (e) => this.wheel(e));
    on('contextmenu', (e) => e.preventDefault());
  }

  rayOf({ clientX, clientY }) {
    const box = this.canvas.getBoundingClientRect();
    return this.camera.ray((2 * (clientX - box.left)) / box.width - 1,
      1 - (2 * (clientY - box.top)) / box.height);
  }

  /// {index, distance} of the nearest body along a ray; a near miss of a finger counts.
  pick({ from, along }) {
    let best = { index: -1, distance: Infinity };
    this.solids.bodies.forEach((body, index) => {
      if (body.free) return; // the water has it
      const back = conjugate(body.turn);
      const t = rayHits(body.places, turn(back, sub(from, body.place)), turn(back, along));
      if (t < best.distance) best = { index, distance: t };
    });
    return best;
  }

  start(event) {
    event.preventDefault();
    this.canvas.focus({ focusVisible: false });
    this.canvas.setPointerCapture(event.pointerId);
    const ray = this.rayOf(event);
    const { index, distance } = event.button === 2 ? { index: -1 } : this.pick(ray);
    const hold = { x: event.clientX, y: event.clientY };
    if (this.grabs.elsewhere.includes(index)) this.refused(index);
    else if (index >= 0) {
      const body = this.solids.bodies[index];
      const hit = add(ray.from, scale(ray.along, distance));
      if (this.grabs.take(event.pointerId, index, body.place, body.turn)) {
        hold.depth = dot(sub(hit, this.camera.eye), this.camera.forward);
        hold.offset = sub(body.place, hit);
        hold.turn = body.turn;
      }
    }
    this.down.set(event.pointerId, hold);
  }

  place(hold, event) {
    const { from, along } = this.rayOf(event);
    const far = hold.depth / Math.max(dot(along, this.camera.forward), 0.05);
    return add(add(from, scale(along, far)), hold.offset);
  }

  go(event) {
    const hold = this.down.get(event.pointerId);
    if (!hold) {
      const over = this.pick(this.rayOf(event)).index;
      this.hovered = over;
      this.canvas.style.cursor = over < 0 ? 'default' : this.grabs.isHeld(over) ? 'not-allowed' : 'grab';
      return;
    }
    if (hold.depth === undefined) this.turnCamera(hold, event);
    hold.x = event.clientX;
    hold.y = event.clientY;
  }

  drag(event) {
    const hold = this.down.get(event.pointerId);
    if (hold?.depth === undefined) return;
    const joined = event.getCoalescedEvents?.() ?? [];
    for (const one of joined.length ? joined : [event]) {
      hold.last = one;
      this.grabs.move(event.pointerId, this.place(hold, one), hold.turn, one.timeStamp / 1000);
    }
  }

  turnCamera(hold, event) {
    const free = [...this.down.values()].filter((h) => h.depth === undefined);
    if (free.length === 2) {
      const other = free.find((h) => h !== hold);
      const before = Math.hypot(hold.x - other.x, hold.y - other.y);
      const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
      if (after > 0) this.camera.zoom(before / after);
    } else {
      this.camera.orbit((event.clientX - hold.x) * 0.006, (event.clientY - hold.y) * 0.006);
    }
  }

  end(event) {
    if (this.down.delete(event.pointerId)) this.grabs.letGo(event.pointerId);
  }

  wheel(event) {
    event.preventDefault();
    const held = [...this.down.entries()].find(([, h]) => h.depth !== undefined);
    if (!held) return this.camera.zoom(Math.exp(event.deltaY * 0.001));
    const [id, hold] = held;
    if (event.shiftKey) {
      const spin = about([0, 0, 1], (event.deltaY + event.deltaX) * 0.003);
      hold.turn = product(spin, hold.turn);
    } else hold.depth *= Math.exp(-event.deltaY * 0.0006);
    return this.grabs.move(id, this.place(hold, hold.last ?? event), hold.turn);
  }
}
