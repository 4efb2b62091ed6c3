// SPDX-License-Identifier: MIT
// A soft sine in the middle of each channel's band, one channel at a time, through the same guard
// that events go through.
#pragma once

#include <atomic>
#include <vector>

#include "synth-server/audio/audio_output.hpp"
#include "synth-server/output/fade.hpp"
#include "synth-server/output/output_guard.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

class TestTone final : public BlockSource {
 public:
  static constexpr int kNone = -1;

  TestTone(const Rig& rig, double sample_rate);

  void render(const AudioBlock& block) noexcept override;

  /// From any thread: the channel that sounds, from 0; kNone: none. The one before fades out first.
  void choose(int channel) noexcept { chosen_ = channel; }
  /// [Hz]
  [[nodiscard]] double frequency(int channel) const;

 private:
  struct Voice {
    double step = 0.0;       ///< of the phase, per sample [rad]
    double amplitude = 0.0;  ///< [full scale]
    OutputGuard guard;
  };
  [[nodiscard]] double next(double gain) noexcept;

  double sample_rate_;
  std::vector<Voice> voices_;
  std::atomic<int> chosen_{kNone};
  int playing_ = kNone;
  double phase_ = 0.0;  ///< [rad]
  Fade fade_;
};

}  // namespace splash::synth
