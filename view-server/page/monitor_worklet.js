// SPDX-License-Identifier: MIT
// Plays the stereo monitor in the audio thread: a ring of samples, kept about as full as arrivals
// need, read a little faster or slower to hold that.

const RING = 1 << 15; // frames
const SPARE = 0.01; // [s] left in the ring when an arrival is as late as they get
const MOST = 0.11; // [s] in the ring in the mean
const LOOK = 2; // [s] after which the ring's fill is chosen anew

class Monitor extends AudioWorkletProcessor {
  constructor() {
    super();
    this.ring = [new Float32Array(RING), new Float32Array(RING)];
    this.clear();
    this.wanted = 0.03; // [s] in the ring in the mean
    this.fill = this.wanted; // a mean of what is there [s]
    this.dip = 0; // how far below it the ring has been since the last look [s]
    this.looked = 0; // how long ago [s]
    this.gain = 0;
    this.port.onmessage = ({ data: way }) => { // on which sound comes
      way.onmessage = ({ data }) => this.take(data);
    };
  }

  clear() {
    this.written = 0;
    this.read = 0;
    this.playing = false;
  }

  take({ samples, rate, moment, first }) {
    if (rate !== this.rate || first !== this.next) this.clear();
    this.rate = rate;
    this.next = first + samples.length / 2;
    for (let i = 0; i < samples.length; i += 2) {
      const at = this.written++ & (RING - 1);
      this.ring[0][at] = samples[i];
      this.ring[1][at] = samples[i + 1];
    }
    // The moment at which the frame numbered `written` leaves a device.
    this.end = moment + samples.length / 2 / rate;
  }

  process(_, [out]) {
    const rate = this.rate ?? sampleRate;
    const stored = (this.written - this.read) / rate;
    if (!this.playing && stored >= this.wanted) {
      this.read = Math.max(this.read, this.written - Math.round(this.wanted * rate));
      this.playing = true;
      this.fill = this.wanted;
    }
    if (stored > MOST + 0.1) this.read = this.written - this.wanted * rate;
    const step = this.pace(rate, stored);
    for (let i = 0; i < out[0].length; ++i) {
      const whole = Math.floor(this.read);
      const running = this.playing && whole + 1 < this.written;
      if (this.playing && !running) this.starve();
      this.gain += ((running ? 1 : 0) - this.gain) * 0.01;
      const part = this.read - whole;
      for (let side = 0; side < 2; ++side) {
        const a = this.ring[side][whole & (RING - 1)];
        const b = this.ring[side][(whole + 1) & (RING - 1)];
        const value = a + part * (b - a);
        out[Math.min(side, out.length - 1)][i] = running ? this.gain * Math.tanh(value) : 0;
      }
      if (running) this.read += step;
    }
    this.tell(rate);
    return true;
  }

  /// Frames of the ring for each of the output: up to half a percent off to hold the fill.
  pace(rate, stored) {
    this.fill += 0.01 * (stored - this.fill);
    const off = Math.min(Math.max((this.fill - this.wanted) * 0.2, -0.005), 0.005);
    this.dip = Math.max(this.dip, this.fill - stored);
    this.looked += 128 / sampleRate;
    if (this.looked > LOOK && this.playing) {
      const enough = Math.min(this.dip + SPARE, MOST);
      this.wanted += (enough > this.wanted ? 1 : 0.2) * (enough - this.wanted);
      this.look();
    }
    return (rate / sampleRate) * (1 + off);
  }

  look() {
    this.dip = 0;
    this.looked = 0;
  }

  starve() {
    this.playing = false;
    this.wanted = Math.min(MOST, this.wanted + 0.01);
    this.look();
  }

  tell(rate) {
    this.blocks = (this.blocks ?? 0) + 1;
    if (this.blocks % 64 || !this.playing) return;
    this.port.postMessage({ context: currentTime, wanted: this.wanted,
      moment: this.end - (this.written - this.read) / rate });
  }
}
registerProcessor('monitor', Monitor);
