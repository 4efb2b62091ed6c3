// SPDX-License-Identifier: MIT
// Bodies and water by hand: what the surface points of bodies would see, told frame by frame.
#pragma once

#include <functional>
#include <vector>

#include "sim-server/detect/impacts.hpp"

namespace splash::sim {

inline constexpr double kSpacing = 0.02;      ///< [m]
inline constexpr double kStoryFrame = 0.004;  ///< [s]

/// Of water on a cubic lattice, support two spacings.
[[nodiscard]] SurfaceDistance surface_distance();

/// A flat underside over flat water, both level: heights and vertical speeds.
struct Scenery {
  double underside = 0.1;  ///< of the body [m]
  double speed = 0.0;      ///< of the body, upwards [m/s]
  double level = 0.0;      ///< of the water [m]
  double flow = 0.0;       ///< of the water, upwards [m/s]
  double drift = 0.0;      ///< of the body, sideways [m/s]
  bool water = true;       ///< any there at all
  double ahead = 1.0;      ///< matter behind the water's surface: 1 if it is deep [1]
  double thin = 0.0;       ///< how far thin water reaches above the level [m]
};

/// The area of such an underside [m2].
inline constexpr double kUnderside = 0.08 * 0.08;

/// 4 x 4 points from (0, 0) to (6 cm, 6 cm), each with 2 cm x 2 cm around it.
void add_body(std::vector<SurfacePoint>& points, int body, const Scenery& at);

struct Announced {
  double at = 0.0;  ///< when it was said [s]
  DetectedImpact impact;
};

/// What is to be seen at a time, or what the skin's points see then.
using Story = std::function<Scenery(double)>;
using Sights = std::function<std::vector<SurfacePoint>(double)>;

/// Lives through what they see, frame by frame.
std::vector<Announced> live_through(ImpactWatch& watch, double seconds, const Sights& sights);
/// The same of one body of one underside's area.
[[nodiscard]] std::vector<Announced> live_through(double seconds, const Sights& sights);

/// Lives through the stories of all bodies, frame by frame. `nearer`: as in ImpactWatch.
[[nodiscard]] std::vector<Announced> watch(const std::vector<Story>& bodies, double seconds,
                                           const DetectSettings& settings = {},
                                           double nearer = 0.0);
[[nodiscard]] std::vector<Announced> watch(const Story& body, double seconds,
                                           const DetectSettings& settings = {},
                                           double nearer = 0.0);

struct Leg {
  double until = 0.0;   ///< [s]
  double height = 0.0;  ///< at its end [m]
};
/// An underside at constant speed from one height to the next, which stays at the last.
[[nodiscard]] Story path(double from, std::vector<Leg> legs);

}  // namespace splash::sim
