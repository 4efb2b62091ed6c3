// SPDX-License-Identifier: MIT
// Bodies that are held, and the poses that they follow: a hundred a second at even moments, smoothed
// and bounded to what a body may do. Each holder (a pointer, a controller) holds one body.
import { HandPath } from './hand_path.js';
import { OneEuro } from './one_euro.js';
import { add, between, clamp, length, scale, sub } from './vector.js';

const PERIOD = 0.01; // [s] between poses
const LATEST = 0.2; // [s]: a page that stood still for longer leaves poses out
const SPEED_MAX = 5; // [m/s]
const TURN = 12; // [1/s]: a turn is followed with the inverse of this time

const seconds = () => performance.now() / 1000;

export class Grabs {
  constructor(link) {
    this.link = link;
    this.held = new Map(); // holder -> what it holds
    this.elsewhere = []; // bodies that other visitors hold
    this.box = null;
    setInterval(() => this.send(), (1000 * PERIOD) / 2);
  }

  /// Where bodies may go: the tank and the air above it.
  bound({ lower, upper }) {
    const wide = sub(upper, lower);
    const air = 0.3 * Math.max(wide[0], wide[1]);
    this.box = { lower, upper: [upper[0], upper[1], upper[2] + air] };
  }

  holds(index) {
    return [...this.held.values()].some((grab) => grab.index === index);
  }

  /// Whether somebody holds it, here or at another page.
  isHeld(index) {
    return this.holds(index) || this.elsewhere.includes(index);
  }

  /// Other visitors hold these bodies; returns those of them that were thought to be held here.
  heldElsewhere(indices) {
    this.elsewhere = indices;
    const lost = [...this.held].filter(([, { index }]) => indices.includes(index));
    for (const [holder] of lost) this.held.delete(holder);
    return lost.map(([, { index }]) => index);
  }

  take(holder, index, place, turn) {
    if (this.isHeld(index)) return false;
    const now = seconds();
    this.held.set(holder, { index, place: [...place], turn: [...turn],
      path: new HandPath(place, turn, now), filter: new OneEuro(place), next: now });
    this.link.send('/body/grab', ',ii', index, 1);
    this.send();
    return true;
  }

  /// Where the holder had its body at `moment` of performance.now() [s]; the turn is left as it is
  /// where none is given.
  move(holder, place, turn, moment = seconds()) {
    const grab = this.held.get(holder);
    if (!grab || !place.every(Number.isFinite)) return;
    const now = seconds();
    const { lower, upper } = this.box;
    const last = grab.path.spots.at(-1);
    const known = turn?.every(Number.isFinite) ? turn : last.turn;
    const then = Math.abs(now - moment) < 1 ? Math.min(moment, now) : now;
    grab.path.add(place.map((x, i) => clamp(x, lower[i], upper[i])), known, then, now);
  }

  letGo(holder) {
    const grab = this.held.get(holder);
    if (!grab) return;
    this.held.delete(holder);
    this.link.send('/body/grab', ',ii', grab.index, 0);
  }

  letAllGo() {
    for (const holder of [...this.held.keys()]) this.letGo(holder);
  }

  /// After the connection was lost: those still held are asked for again.
  again() {
    for (const { index } of this.held.values()) this.link.send('/body/grab', ',ii', index, 1);
  }

  /// All poses whose moment has come; each says when that was.
  send() {
    const now = seconds();
    for (const grab of this.held.values()) {
      if (now - grab.next > LATEST) grab.next = now - LATEST;
      for (; grab.next <= now - grab.path.hold; grab.next += PERIOD) {
        this.follow(grab, grab.path.at(grab.next));
        this.link.sendAt(performance.timeOrigin / 1000 + grab.next, '/body/pose', ',ifffffff',
          grab.index, ...grab.place, ...grab.turn);
      }
    }
  }

  follow(grab, { place, turn }) {
    const way = sub(grab.filter.next(place, PERIOD), grab.place);
    const far = length(way);
    const most = SPEED_MAX * PERIOD;
    grab.place = add(grab.place, scale(way, far > most ? most / far : 1));
    grab.turn = between(grab.turn, turn, TURN * PERIOD);
  }
}
