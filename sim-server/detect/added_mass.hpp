// SPDX-License-Identifier: MIT
// Water that skin drags along when it gets wet (von Karman 1929, NACA TN 321).
#pragma once

#include <array>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Water that a flat face of `area` [m2] and so many times as long as wide drags along on one
/// side, head on [kg] (table of plates in DNV-RP-C205, to 1 %).
[[nodiscard]] double added_mass(double area, double aspect);

/// How deep water is moved by a blow of a face of that area: the added mass of a disc,
/// 4/3 rho R^3, grows by rho 0.36 sqrt(A) for each area that gets wet [m2], [m].
[[nodiscard]] double reach_of_blow(double area);

/// Skin that is about to get wet.
struct Wetting {
  double after = 0.0;  ///< the first touch [s]
  double area = 0.0;   ///< projected onto the water's surface [m2]
  double ahead = 0.0;  ///< matter that backs the water there [1]
  double speed = 0.0;  ///< at which it presses on the water [m/s]
  Vector3 place = {0.0, 0.0, 0.0};
};

/// Wet skin as it grows.
class Patch {
 public:
  void add(const Wetting& skin);
  [[nodiscard]] double area() const { return area_; }
  /// As far as water is behind the surface [m2].
  [[nodiscard]] double backed() const { return backed_; }
  /// Added mass, as far as water is behind the surface [kg].
  [[nodiscard]] double mass() const {
    return area_ > 0.0 ? backed_ / area_ * added_mass(area_, aspect()) : 0.0;
  }
  /// That mass, as fast as the skin is on average, by area [N s].
  [[nodiscard]] double momentum() const {
    return backed_ > 0.0 ? pressed_ / backed_ * mass() : 0.0;
  }

 private:
  /// Of the rectangle with the same second moments: from the two larger variances, which are the
  /// roots of  l^2 - trace l + minors = 0  since a flat patch has no third.
  [[nodiscard]] double aspect() const;

  double area_ = 0.0;     ///< [m2]
  double backed_ = 0.0;   ///< [m2]
  double pressed_ = 0.0;  ///< sum of its parts times their speeds [m3/s]
  Vector3 first_ = {0.0, 0.0, 0.0};
  std::array<Vector3, 3> second_ = {};
};

/// What gets wet within this time of the first touch is felt as one blow; what takes longer is
/// eased in [s].
inline constexpr double kAtOnce = 0.030;

/// How the added mass of a blow grows.
struct Growth {
  double area_at_once = 0.0;      ///< wet within kAtOnce, with water behind the surface [m2]
  double mass_at_once = 0.0;      ///< its added mass [kg]
  double momentum_at_once = 0.0;  ///< of that [N s]
  double rise = 0.0;              ///< after the first touch the blow is strongest [s]
  double area = 0.0;              ///< wet until then [m2]
  double momentum = 0.0;          ///< given to the water until then [N s]
};

/// Of skin that gets wet, looked at in steps of `step` seconds. The blow is strongest when in one
/// of the first 20 the added mass grows nearly as fast as in any: of a curved body's blow the first
/// part is sharp, what follows is drag.
[[nodiscard]] Growth growth_of(std::vector<Wetting> wettings, double step);

}  // namespace splash::sim
