// SPDX-License-Identifier: MIT
// How loud a voice is at any time and when it is over, known in closed form at its start. So no
// decision of the engine depends on what has been rendered already, or in which blocks.
#pragma once

#include <cstdint>
#include <limits>

namespace splash::synth {

/// Length of the fade of a cavity that surfaces or breaks: two to three of its periods [s].
inline constexpr double kBreakFade = 0.05;

struct VoiceLife {
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  double log_amplitude = 0.0;  ///< natural logarithm of the amplitude at the start [ln m]
  double decay = 0.0;          ///< amplitude falls as e^(-decay t) [1/s]
  double hold = 0.0;           ///< decay begins after this [s]
  std::int64_t length = 0;     ///< samples until the amplitude is under the floor; 0: never audible
  std::int64_t fold = 0;       ///< sample at which the pitch reaches Nyquist
  std::int64_t breaks = kNever;  ///< sample at which it begins to fade within kBreakFade
  bool kept = false;             ///< a cavity: not told to make room, however quiet
};

}  // namespace splash::synth
