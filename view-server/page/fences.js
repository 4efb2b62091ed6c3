// SPDX-License-Identifier: MIT
// Which pictures the graphics have been given and not yet drawn. The browser may keep several; each
// of them would be older when it is seen. They are looked at between pictures, too: who waited for
// the browser's next picture would count up to 16 ms too many.

const BETWEEN = 2; // looks [ms]; browsers make 4 of it

export class Fences {
  /// Calls `drawn(moment, begun)` for each picture as soon as it is finished.
  constructor(gl, drawn) {
    Object.assign(this, { gl, drawn });
    this.pending = []; // {fence, moment, begun}, the oldest first
    this.timer = null;
  }

  /// All that was drawn since the last one is the picture of this moment; it was begun at `begun`.
  add(moment, begun) {
    const { gl } = this;
    this.pending.push({ fence: gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0), moment, begun });
    gl.flush();
    this.timer ??= setTimeout(() => this.again(), BETWEEN);
  }

  again() {
    this.look();
    this.timer = this.pending.length > 0 ? setTimeout(() => this.again(), BETWEEN) : null;
  }

  look() {
    const { gl, pending } = this;
    while (pending.length > 0
           && gl.clientWaitSync(pending[0].fence, 0, 0) !== gl.TIMEOUT_EXPIRED) {
      const { fence, moment, begun } = pending.shift();
      gl.deleteSync(fence);
      this.drawn(moment, begun);
    }
  }
}
