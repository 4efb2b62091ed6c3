// SPDX-License-Identifier: MIT
// Which transducer hangs on which channel: a soft tone on one channel at a time.
#pragma once

#include <atomic>
#include <vector>

#include "synth-server/audio/audio_output.hpp"
#include "synth-server/output/fade.hpp"
#include "synth-server/output/output_guard.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// A sine in the middle of a channel's band, at a tenth of its ceiling.
struct Tone {
  double step = 0.0;       ///< of the phase, per sample [rad]
  double amplitude = 0.0;  ///< [full scale]
};

/// Of each channel; `sample_rate` [Hz].
[[nodiscard]] std::vector<Tone> tones_of(const Rig& rig, double sample_rate);

/// While all plays: a second of tone, in place of the water there.
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

/// The tones alone, for as long as they are chosen, through the same guard that events go through.
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
    Tone tone;
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
