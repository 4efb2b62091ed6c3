// SPDX-License-Identifier: MIT
// Which transducer hangs on which channel, while all plays: a soft tone of a second on one channel,
// in place of the water there.
#pragma once

#include <vector>

#include "synth-server/output/fade.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// A sine in the middle of a channel's band, at a tenth of its ceiling.
struct Tone {
  double step = 0.0;       ///< of the phase, per sample [rad]
  double amplitude = 0.0;  ///< [full scale]
};

/// Of each channel; `sample_rate` [Hz].
[[nodiscard]] std::vector<Tone> tones_of(const Rig& rig, double sample_rate);

class LiveTone {
 public:
  static constexpr int kNone = -1;

  LiveTone(std::vector<Tone> tones, double sample_rate);

  /// The channel that sounds for a second from now on, from 0. The one before fades out first.
  /// `share`: of the tone's amplitude, where a ceiling was lowered [1].
  void choose(int channel, double share = 1.0) noexcept {
    chosen_ = channel;
    chosen_share_ = share;
  }
  /// Blends from channels[c][i] to the tone and back: neither can exceed the channel's ceiling, so
  /// that nothing between them does.
  void process(float* const* channels, int frames) noexcept;

 private:
  std::vector<Tone> tones_;
  int second_;  ///< [samples]
  Fade fade_;
  int chosen_ = kNone;
  double chosen_share_ = 1.0;
  int playing_ = kNone;
  double share_ = 1.0;  ///< of what plays
  int left_ = 0;        ///< of its second [samples]
  double phase_ = 0.0;  ///< [rad]
};

}  // namespace splash::synth
