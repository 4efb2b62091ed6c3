// SPDX-License-Identifier: MIT
// The synth's stereo monitor in this browser: started by a click, measured against its own moments.

const LOOK = 12; // measurements, six a second

export class Sound {
  constructor(link) {
    this.link = link;
    this.lag = null; // how much later than its moment a sample is heard here, in the mean [s]
    this.lags = []; // of the last two seconds [s]
    this.rate = 48000;
    this.recent = new Float32Array(8192); // what was played last, left and right in turn
    this.at = 0;
  }

  get isOn() {
    return this.context?.state === 'running';
  }

  async start() {
    if (!this.context) {
      this.context = new AudioContext({ latencyHint: 'interactive', sampleRate: this.rate });
      await this.context.audioWorklet.addModule('monitor_worklet.js');
      this.node = new AudioWorkletNode(this.context, 'monitor', { outputChannelCount: [2] });
      this.node.connect(this.context.destination);
      this.node.port.onmessage = ({ data }) => this.measure(data);
    }
    await this.context.resume();
    this.lead();
    this.context.onstatechange = () => this.lead();
  }

  async stop() {
    await this.context?.suspend();
  }

  /// Leads the sound to the audio thread past this one, which may be drawing; while it plays.
  lead() {
    this.lag = null;
    this.lags = [];
    if (!this.isOn) return this.link.hear(null);
    const { port1, port2 } = new MessageChannel();
    this.node.port.postMessage(port1, [port1]);
    return this.link.hear(port2);
  }

  /// `context`: when the sample of `moment` goes out, by the audio's clock.
  measure({ context, moment }) {
    const stamp = this.context.getOutputTimestamp?.();
    const ahead = stamp?.contextTime > 0
      ? context - stamp.contextTime - (performance.now() - stamp.performanceTime) / 1000
      : this.context.outputLatency || this.context.baseLatency || 0;
    this.lags.push(this.link.now() + ahead - moment);
    if (this.lags.length > LOOK) this.lags.shift();
    this.lag = this.lags.reduce((a, b) => a + b) / this.lags.length;
  }

  take(frame) {
    this.rate = frame.rate;
    for (const sample of frame.samples) this.recent[this.at++ % this.recent.length] = sample;
  }

  /// The last n frames of one side, oldest first.
  last(n, side) {
    const out = new Float32Array(n);
    const size = this.recent.length;
    for (let i = 0; i < n; ++i) {
      out[i] = this.recent[(this.at - 2 * (n - i) + side + 2 * size) % size];
    }
    return out;
  }

  /// A stream of what is heard, for a film.
  stream() {
    if (!this.isOn) return null;
    this.tap ??= this.context.createMediaStreamDestination();
    this.node.connect(this.tap);
    return this.tap.stream;
  }
}
