// SPDX-License-Identifier: MIT
// How the programs are, in words, out of their /status.reply: what went wrong of late goes before
// what only is.

const LATELY = 6; // [s]
// Counters of either program, with what it means that they grow.
const GROWS = [
  ['sim-server', 9, (n) => `The water became unstable ${n} times; it was put right`],
  ['sim-server', 7, (n) => `The network refused ${n} packets of the simulator`],
  ['synth-server', 13, () => 'An output was silenced: what it was to play was no number'],
  ['synth-server', 9, (n) => `The sound device missed ${n} deadlines`],
  ['synth-server', 8, (n) => `${n} events found no voice`],
  ['synth-server', 5, (n) => `${n} packets were lost on the way to the synth`],
  ['synth-server', 3, (n) => `${n} events came too late and sounded at once`],
];
const PATIENCE = 300; // [s] with a scene that was chosen: its kernels may have to be compiled
const PACE = 11; // simulated seconds in a second

export class Words {
  constructor() {
    this.told = new Map(); // program -> [{at, values}]
    this.simWasThere = false;
  }

  /// `at`: [s].
  note(values, at) {
    const before = this.told.get(values[0]) ?? [];
    // Who began anew counts anew.
    const same = before.length === 0 || values[2] >= before.at(-1).values[2];
    const kept = same ? before.filter((one) => at - one.at < LATELY) : [];
    this.told.set(values[0], [...kept, { at, values }]);
  }

  forget() {
    this.told.clear();
  }

  last(program) {
    return this.told.get(program)?.at(-1)?.values;
  }

  /// {text, bad}
  say({ open, sim, synth, rests, paused, muted, going, description }) {
    const bad = (text) => ({ text, bad: true });
    if (!open) return bad('view-server does not answer; connecting again');
    if (going && performance.now() - going.since < 1000 * PATIENCE) {
      return { text: `The ${going.what} ${going.name} is being made ready`, bad: false };
    }
    this.simWasThere ||= sim;
    if (!this.simWasThere) {
      return { bad: false, text: 'Waiting for the simulator, which is started with --show: the first time it makes its '
        + 'kernels, for a minute or more' };
    }
    if (!sim && !synth) return bad('Neither simulator nor synth answers: are they started with --show?');
    if (!sim) return bad('No simulator: it has ended, or was not started with --show');
    if (rests) return { text: 'The water comes to rest', bad: false };
    if (!synth) return bad('No synth: the water is seen, not heard');
    if (paused) return { text: 'Paused', bad: false };
    for (const [program, field, text] of GROWS) {
      const told = this.told.get(program) ?? [];
      const grown = told.length > 1 ? told.at(-1).values[field] - told[0].values[field] : 0;
      if (grown > 0) return bad(text(grown));
    }
    const pace = this.last('sim-server')?.[PACE] ?? 1;
    if (pace > 0 && pace < 0.9) {
      return bad(`Slower than real time: ${pace.toFixed(2)} simulated seconds in a second; a smaller scene or a `
        + 'faster device helps');
    }
    return { text: muted ? 'Muted' : description, bad: false };
  }
}
