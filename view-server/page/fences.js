// SPDX-License-Identifier: MIT
// Which pictures the graphics have been given and not yet drawn. The browser may keep several; each
// of them would be older when it is seen.

export class Fences {
  constructor(gl) {
    this.gl = gl;
    this.pending = []; // {fence, moment}, the oldest first
  }

  /// All that was drawn since the last one is the picture of this moment.
  add(moment) {
    const { gl } = this;
    this.pending.push({ fence: gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0), moment });
    gl.flush();
  }

  /// Calls `drawn` with the moment of each picture that is finished by now.
  look(drawn) {
    const { gl, pending } = this;
    while (pending.length > 0
           && gl.clientWaitSync(pending[0].fence, 0, 0) !== gl.TIMEOUT_EXPIRED) {
      const { fence, moment } = pending.shift();
      gl.deleteSync(fence);
      drawn(moment);
    }
  }
}
