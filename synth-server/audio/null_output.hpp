// SPDX-License-Identifier: MIT
// An output without a device: a thread that asks for blocks when a device would, and forgets them.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "synth-server/audio/audio_output.hpp"

namespace splash::synth {

class NullOutput final : public AudioOutput {
 public:
  /// Throws std::invalid_argument naming the value when a number is not positive.
  NullOutput(int channels, int sample_rate, int block);
  ~NullOutput() override;

  void start(BlockSource& source) override;
  void stop() noexcept override;
  [[nodiscard]] const AudioFormat& format() const noexcept override { return format_; }
  [[nodiscard]] std::uint64_t frames() const noexcept override { return frames_; }
  [[nodiscard]] std::string scheduling() const override { return "ordinary thread, no device"; }

 private:
  /// Blocks carry the moment they were due, not the one at which the thread woke: this clock is
  /// exact. A thread that woke late renders what it missed; beyond a second it counts an xrun.
  void run(BlockSource& source);

  AudioFormat format_;
  std::vector<float> samples_;
  std::vector<float*> channels_;
  std::atomic<std::uint64_t> frames_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace splash::synth
