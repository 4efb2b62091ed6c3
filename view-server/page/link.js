// SPDX-License-Identifier: MIT
// The WebSocket to view-server: opens it again when it ends, and knows the server's clock by /ping.
import { decode, encode, encodeAt } from './osc.js';
import { readFrame } from './wire.js';

const PING_EVERY = 500; // [ms]
const SAMPLES = 32; // of the clock; the one with the shortest way counts (RFC 5905, section 8)
const AGAIN_AFTER = 700; // [ms]

export class Link {
  /// `on`: functions by kind of frame, `osc(message)`, `told(json)`, `open()`, `closed()`.
  constructor(on) {
    this.on = on;
    this.samples = [];
    this.offset = 0; // server's clock minus the page's [s]
    this.connect();
    setInterval(() => this.send('/ping', ',t', this.ownClock()), PING_EVERY);
  }

  ownClock() {
    return (performance.timeOrigin + performance.now()) / 1000;
  }

  /// The server's clock [Unix s].
  now() {
    return this.ownClock() + this.offset;
  }

  connect() {
    const address = `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/view`;
    this.socket = new WebSocket(address);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => {
      this.samples = [];
      this.send('/ping', ',t', this.ownClock());
      this.on.open();
      this.ask();
    };
    this.socket.onmessage = ({ data }) => this.take(data);
    this.socket.onclose = () => {
      this.on.closed();
      setTimeout(() => this.connect(), AGAIN_AFTER);
    };
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  send(address, types, ...values) {
    if (this.isOpen) this.socket.send(encode(address, types, ...values));
  }

  /// In a bundle that says when it was made, by the page's clock [Unix s].
  sendAt(time, address, types, ...values) {
    if (this.isOpen) this.socket.send(encodeAt(time, address, types, ...values));
  }

  /// Asks for one more state.
  ask() {
    if (this.isOpen) this.socket.send(new Uint8Array(0));
  }

  take(data) {
    if (typeof data === 'string') return this.on.told(JSON.parse(data));
    const bytes = new Uint8Array(data);
    if (bytes[0] === 35 || bytes[0] === 47) {
      for (const message of decode(bytes)) {
        if (message.address === '/pong') this.takePong(message.values);
        else this.on.osc(message);
      }
      return undefined;
    }
    const frame = readFrame(data);
    return frame && this.on[frame.kind]?.(frame);
  }

  takePong([t0, t1, t2]) {
    const t3 = this.ownClock();
    this.samples.push({ offset: (t1 - t0 + t2 - t3) / 2, trip: t3 - t0 - (t2 - t1) });
    if (this.samples.length > SAMPLES) this.samples.shift();
    this.offset = this.samples.reduce((a, b) => (b.trip < a.trip ? b : a)).offset;
  }
}
