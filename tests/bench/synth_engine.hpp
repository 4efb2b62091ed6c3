// SPDX-License-Identifier: MIT
// What the whole engine costs: events, pool, voices, mix, filters, limiters.
#pragma once

#include <string>
#include <vector>

#include "synth-server/render/engine.hpp"

namespace splash::bench {

/// Names of the instruction sets that this processor has.
[[nodiscard]] std::vector<std::string> instruction_sets();

struct EngineCase {
  std::string instructions = "best";
  int voices = 16384;   ///< sounding all the time
  int tiles = 0;        ///< per side of a floor, each bubble spread over its neighbours; 0: mono
  int block = 64;       ///< frames per call
  double routes = 1.0;  ///< channels per voice, on average
  double cost = 0.0;    ///< of one core, in real time at 44.1 kHz [1]
  /// Voices that would fill a core at this cost.
  [[nodiscard]] double voices_per_core() const { return voices / cost; }
};

/// Fills in `routes` and `cost`: processor time of `seconds` of sound, median of five.
[[nodiscard]] EngineCase measure_engine(EngineCase wanted, double seconds = 0.1);

/// Bubbles per second that one core could start and play: radii such that they last 10 to 300 ms
/// (60 dB), spread over 36 tiles if `tiles` is 6.
struct OnsetCase {
  std::string instructions;
  int tiles = 0;
  double onsets = 0.0;  ///< per second and core
  double voices = 0.0;  ///< sounding on average while it was measured
};
[[nodiscard]] OnsetCase measure_onsets(const std::string& instructions, int tiles);

/// Of one core [1], so many births a second of bubbles of 3 to 30 mm on 36 channels up to 20 kHz at
/// 44.1 kHz, of which `singles` a second sound one by one: as the paper has them, or in coupled
/// clouds, with fine water on every channel, water under the foot and a gain of their own.
[[nodiscard]] double measure_flood(int births, double singles, bool everything);

/// Of one core [1]: the pitches of 10,000 births a second in a cloud as full as it gets.
[[nodiscard]] double measure_clouds();

}  // namespace splash::bench
