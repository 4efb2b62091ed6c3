// SPDX-License-Identifier: MIT
// The hollow that a body leaves behind itself as it goes into the water. Its slices across the
// body's way are independent of each other: the front pushes each aside as it goes through, and
// gravity shuts it (Duclaux et al. 2007; Bergmann et al. 2009; Aristoff et al. 2010, also of bodies
// that slow down). Of a slice at depth z, tau after a front of radius R went through it with speed
// U, (r r')' = -g z, so
//   r^2 = R^2 + 2 a R U tau - g z tau^2,    r r' = a R U at first.
// All of it closes t_p = 2.285 sqrt(R / g_n) after the front went under the level (Glasheen &
// McMahon 1996; g_n = g z / s: of gravity the part along the way s), by the slice behind the body
// that is shut first. That gives a, and what is below that slice is shut in. For discs at constant
// speed u it is 1.75 to 2.1 R^3 (1 + 0.26 Fr^1/2) Fr^1/2, Fr = u^2/(g R), from Fr = 0.34 to 200
// (Bergmann et al. have the same, but for the factor); slower, water closes even without a, so
// a hollow fills from below and shuts nothing in.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Where the front of a body that goes in is: the skin that faces its motion.
struct Front {
  double time = 0.0;                ///< [s]
  Vector3 place = {0.0, 0.0, 0.0};  ///< its middle [m]
  double speed = 0.0;               ///< at which it goes on [m/s]
  double radius = 0.0;              ///< of the disc of its area across the motion [m]
};

class Hollow {
 public:
  /// `first`: where the front went in; `level` of the water [m], `gravity` downwards [m/s2].
  Hollow(const Front& first, double level, double gravity);

  /// The front is there now.
  void go_on(const Front& front);
  /// When it closes, if the front goes on as until now; never while it has gone nowhere [s].
  [[nodiscard]] double closes_at() const;
  /// When the front went in [s].
  [[nodiscard]] double began_at() const noexcept { return slices_.front().front.time; }
  /// Where its middle did [m].
  [[nodiscard]] const Vector3& entry() const noexcept { return slices_.front().front.place; }
  /// How far it has gone since [m].
  [[nodiscard]] double way() const noexcept { return slices_.back().way; }
  /// R of all of its way [m].
  [[nodiscard]] double radius() const;

  struct Air {
    double volume = 0.0;               ///< [m3]
    double rate = 0.0;                 ///< at which that grows [m3/s]
    Vector3 centre = {0.0, 0.0, 0.0};  ///< [m]
  };
  /// What is shut in at closes_at(), the front having gone on until then. The body fills the
  /// hollow's end: `free_behind(x)` is the share of its section that it leaves free so far behind
  /// its front, rising from 0 to 1 [m], [1].
  [[nodiscard]] std::optional<Air> shut_in(const std::function<double(double)>& free_behind) const;

 private:
  struct Slice {
    Front front;       ///< as it went through
    double way = 0.0;  ///< [m]
  };
  [[nodiscard]] double depth(const Slice& slice) const { return level_ - slice.front.place[2]; }
  [[nodiscard]] Slice at(double way) const;
  [[nodiscard]] double way_at(double time) const;

  double level_;
  double gravity_;
  double swept_ = 0.0;  ///< integral of R^2 along the way [m3]
  std::vector<Slice> slices_;
};

}  // namespace splash::sim
