// SPDX-License-Identifier: MIT
// What the kernels need not know of the voices of a pack: which lanes are taken, and from when to
// when each sounds.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "synth-server/render/voice_span.hpp"
#include "synth-server/voices/bubble_pack.hpp"

namespace splash::synth {

inline constexpr auto kPackLanes = static_cast<std::size_t>(kPackVoices);

struct Sitters {
  static constexpr std::uint32_t kFull = 0xffffU;
  std::uint32_t taken = 0;                   ///< a bit per lane
  std::uint32_t leaving = 0;                 ///< of these, those that were told to make room
  std::uint32_t kept = 0;                    ///< same, those that are not told to
  std::uint32_t cavities = 0;                ///< same, those that are no bubbles
  std::int64_t calm_from = 0;                ///< all have started by then
  std::int64_t calm_to = VoiceSpan::kNever;  ///< none ends or fades before
  std::array<VoiceSpan, kPackLanes> spans;

  void note(const VoiceSpan& span) noexcept {
    calm_from = std::max(calm_from, span.start);
    calm_to = std::min({calm_to, span.end, span.fade});
  }
};

}  // namespace splash::synth
