// SPDX-License-Identifier: MIT
// Bodies that are held: where each is wanted, and the poses that bring it there, smoothed and
// bounded to what a body may do. Each holder (a pointer, a controller) holds one body.
import { OneEuro } from './one_euro.js';
import { between, clamp, length, scale, sub, add } from './vector.js';

const EVERY = 10; // [ms] between poses
const SPEED_MAX = 5; // [m/s]

export class Grabs {
  constructor(link) {
    this.link = link;
    this.held = new Map(); // holder -> what it holds
    this.box = null;
    setInterval(() => this.send(), EVERY);
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

  take(holder, index, place, turn) {
    if (this.holds(index)) return false;
    this.held.set(holder, { index, place: [...place], turn: [...turn], wanted: [...place],
      wantedTurn: [...turn], filter: new OneEuro(place), at: performance.now() });
    this.link.send('/body/grab', ',ii', index, 1);
    this.send();
    return true;
  }

  /// Where the holder has its body now; the turn is left as it is where none is given.
  move(holder, place, turn) {
    const grab = this.held.get(holder);
    if (!grab || !place.every(Number.isFinite)) return;
    const { lower, upper } = this.box;
    grab.wanted = place.map((x, i) => clamp(x, lower[i], upper[i]));
    if (turn && turn.every(Number.isFinite)) grab.wantedTurn = turn;
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

  send() {
    const now = performance.now();
    for (const grab of this.held.values()) {
      const step = clamp((now - grab.at) / 1000, 0.002, 0.1);
      grab.at = now;
      const smooth = grab.filter.next(grab.wanted, step);
      const way = sub(smooth, grab.place);
      const far = length(way);
      const most = SPEED_MAX * step;
      grab.place = add(grab.place, scale(way, far > most ? most / far : 1));
      grab.turn = between(grab.turn, grab.wantedTurn, Math.min(1, 12 * step));
      this.link.send('/body/pose', ',ifffffff', grab.index, ...grab.place, ...grab.turn);
    }
  }
}
