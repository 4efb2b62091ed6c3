// SPDX-License-Identifier: MIT
// Messages to and from view-server, through the thread that owns the WebSocket (socket.js), and the
// server's clock, which is measured by /ping.
import { decode, encode, encodeAt } from './osc.js';
import { readFrame } from './wire.js';

const PING_EVERY = 500; // [ms]
const SAMPLES = 32; // of the clock; the one with the shortest way counts (RFC 5905, section 8)

export class Link {
  /// `on`: functions by kind of frame, `osc(message)`, `told(json)`, `open()`, `closed()`.
  constructor(on) {
    this.on = on;
    this.samples = [];
    this.offset = 0; // server's clock minus the page's [s]
    this.isOpen = false;
    this.thread = new Worker(new URL('./socket.js', import.meta.url), { type: 'module' });
    this.thread.onmessage = ({ data }) => this.note(data);
    const protocol = location.protocol === 'https:' ? 'wss' : 'ws';
    this.thread.postMessage({ address: `${protocol}://${location.host}/view` });
    setInterval(() => this.send('/ping', ',t', this.ownClock()), PING_EVERY);
  }

  ownClock() {
    return (performance.timeOrigin + performance.now()) / 1000;
  }

  /// The server's clock [Unix s].
  now() {
    return this.ownClock() + this.offset;
  }

  note({ isOpen, data, came }) {
    if (isOpen === undefined) return this.take(data, came);
    this.isOpen = isOpen;
    if (!isOpen) return this.on.closed();
    this.samples = [];
    this.send('/ping', ',t', this.ownClock());
    return this.on.open();
  }

  send(address, types, ...values) {
    this.thread.postMessage({ data: encode(address, types, ...values) });
  }

  /// In a bundle that says when it was made, by the page's clock [Unix s].
  sendAt(time, address, types, ...values) {
    this.thread.postMessage({ data: encodeAt(time, address, types, ...values) });
  }

  /// So many states were taken: as many more may come.
  ask(taken) {
    this.thread.postMessage({ taken });
  }

  /// Sound goes to this port of the audio thread, too; null: to none.
  hear(port) {
    this.thread.postMessage({ hears: port }, port ? [port] : []);
  }

  /// `came`: when, by the page's clock [Unix s].
  take(data, came) {
    if (typeof data === 'string') return this.on.told(JSON.parse(data));
    const bytes = new Uint8Array(data);
    if (bytes[0] === 35 || bytes[0] === 47) {
      for (const message of decode(bytes)) {
        if (message.address === '/pong') this.takePong(message.values, came);
        else this.on.osc(message);
      }
      return undefined;
    }
    const frame = readFrame(data);
    return frame && this.on[frame.kind]?.(frame);
  }

  takePong([t0, t1, t2], t3) {
    this.samples.push({ offset: (t1 - t0 + t2 - t3) / 2, trip: t3 - t0 - (t2 - t1) });
    if (this.samples.length > SAMPLES) this.samples.shift();
    this.offset = this.samples.reduce((a, b) => (b.trip < a.trip ? b : a)).offset;
  }
}
