// SPDX-License-Identifier: MIT
// Which voice is the quietest: asked again and again when a flood of events meets a full pool. All
// loudnesses are known in closed form, so nothing depends on how rendering is cut into blocks.
// Looking through all voices for each event would cost more than rendering them: they are ranked
// once, and the quietest 64th of them serves until it is used up or 10 ms old.
#pragma once

#include <cstdint>
#include <vector>

#include "synth-server/voices/voice_life.hpp"

namespace splash::synth {

class Ranking {
 public:
  /// `places` of voices; `sample_rate` [Hz].
  Ranking(std::size_t places, double sample_rate);

  /// A voice begins at `sample` in a free place and ends at `end`.
  void enter(std::uint32_t place, const VoiceLife& life, std::int64_t sample,
             std::int64_t end) noexcept;
  /// The voice fades out from `sample` on: it no longer counts.
  void end_at(std::uint32_t place, std::int64_t sample) noexcept;

  static constexpr std::uint32_t kNone = 0xffffffffU;
  /// Among the quietest of the voices that sound at `sample` and are not kept, or kNone; never
  /// asked of the past.
  [[nodiscard]] std::uint32_t quietest(std::int64_t sample) noexcept;

  /// Natural logarithm of a voice's amplitude at `sample` [ln m].
  [[nodiscard]] double level(std::uint32_t place, std::int64_t sample) const noexcept;

 private:
  struct Line {
    double top = 0.0;         ///< its logarithm at first [ln m]
    double decay = 0.0;       ///< per sample
    double intercept = 0.0;   ///< of the decay's line at sample 0 of the clock [ln m]
    std::int64_t since = 0;   ///< sample at which it began
    std::int64_t until = -1;  ///< sample at which it ends or begins to fade
    bool kept = false;        ///< never the quietest
  };
  struct Candidate {
    float level = 0.0F;  ///< when ranked [ln m]
    std::uint32_t place = 0;
    std::int64_t since = 0;
  };
  [[nodiscard]] bool stands(const Candidate& candidate, std::int64_t sample) const noexcept;
  void rank(std::int64_t sample) noexcept;
  /// The level up to which voices become candidates [ln m].
  [[nodiscard]] float threshold(std::size_t sounding, float least, float most) const noexcept;

  double sample_rate_;
  std::int64_t fresh_;             ///< samples for which a ranking serves
  std::vector<Line> lines_;        ///< by place
  std::vector<float> levels_;      ///< by place, of the last ranking; infinite: not sounding
  std::size_t used_ = 0;           ///< places from here on never had a voice
  std::vector<Candidate> ranked_;  ///< the quietest first
  std::size_t next_ = 0;           ///< in ranked_
  std::int64_t ranked_at_ = -1;    ///< sample; -1: never
};

}  // namespace splash::synth
