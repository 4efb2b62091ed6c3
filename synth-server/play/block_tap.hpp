// SPDX-License-Identifier: MIT
// A copy of the blocks that the device gets, for viewers; made only while there are any.
#pragma once

namespace splash::synth {

class BlockTap {
 public:
  BlockTap() = default;
  virtual ~BlockTap() = default;
  BlockTap(const BlockTap&) = delete;
  BlockTap& operator=(const BlockTap&) = delete;

  /// From the audio thread: channels[c][i] leave the device from `time` on [s, monotonic]. Neither
  /// waits nor allocates.
  virtual void push(const float* const* channels, int frames, double time,
                    double sample_rate) noexcept = 0;
};

}  // namespace splash::synth
