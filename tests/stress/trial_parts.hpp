// SPDX-License-Identifier: MIT
// What trials are made of: a basin of still water, and bodies that stand, move or are tracked.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/stress/trial.hpp"

namespace splash::stress {

inline constexpr double kWide = 0.4;  ///< of the tank [m]
inline constexpr double kDeep = 0.2;  ///< of the water [m]
/// Of water out of a gap that closes at 0.5 m/s from 20 cm width: by continuity, where the gap is
/// as narrow as the narrowest here, 1 cm [m/s].
inline constexpr double kPinched = 5.0;
inline constexpr double kFall = 2.8;  ///< of what falls 0.4 m [m/s]

/// 0.4 m wide and long, 0.2 m deep, with room above.
[[nodiscard]] sim::Scene basin(double spacing);
[[nodiscard]] sim::Scene with(sim::Scene scene, std::vector<sim::BodySettings> bodies);

[[nodiscard]] sim::BodySettings ball(const sim::Vector3& place, double width = 0.12);
[[nodiscard]] sim::BodySettings box(const std::string& name, const sim::Vector3& size,
                                    const sim::Vector3& place);
/// From place to place in straight lines.
[[nodiscard]] sim::BodySettings moved(sim::BodySettings body,
                                      const std::vector<std::pair<double, sim::Vector3>>& way);
/// Moved by poses that arrive.
[[nodiscard]] sim::BodySettings tracked(sim::BodySettings body);

/// Groups 1 to 5, and what was reported of bodies.
void add_body_trials(std::vector<Trial>& all);
/// Group 6: bodies that the water moves.
void add_free_trials(std::vector<Trial>& all);
/// Groups 7 to 12, and what was reported of tanks.
void add_water_trials(std::vector<Trial>& all);

}  // namespace splash::stress
