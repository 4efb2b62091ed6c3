// SPDX-License-Identifier: MIT
// One run over a bad link: the simulator's sender, the link, the synth down to its samples, and
// what is wrong with what came of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/network/impaired_link.hpp"

namespace splash::network {

struct LinkReport {
  std::uint64_t sent = 0;  ///< bundles
  std::uint64_t lost = 0, duplicates = 0, reordered = 0;
  std::uint64_t events = 0;  ///< that came
  std::uint64_t late = 0, too_late = 0;
  std::vector<std::string> wrong;  ///< one line for each broken rule; empty: all is right
};

/// Forty seconds of dense events and of pauses with heartbeats alone, five of them cut off, then
/// heartbeats over the healed link until all voices have ended.
[[nodiscard]] LinkReport run_link(double loss, double duplication, double reordering,
                                  std::uint32_t seed);

/// The impairments of the whole grid.
inline constexpr double kLosses[] = {0.0, 0.01, 0.05, 0.20, 0.50};
inline constexpr double kDuplications[] = {0.0, 0.02, 0.10};
inline constexpr double kReorderings[] = {0.0, 0.05, 0.20};

}  // namespace splash::network
