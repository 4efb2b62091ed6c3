// SPDX-License-Identifier: MIT
// Air that bodies take down as they go into the water. Skin that pushes the water away does work on
// it, by the drag of a body that leaves a hollow (Newton's law of the sine squared; a disc has
// C_d = 1.1),
//   dW/dt = 1/2 C_d rho (u.n)^3 dA    where u.n > 0,
// u being its velocity relative to the water as that was before the body came. Of this work the
// share eta lifts air (Hoque & Aoki 2008), on average from half the depth |u| t_p / 2 that it goes
// to while the hollow is open, so
//   dV/dt = eta C_d (u.n) ((u.n)^2 - u0^2) / (g |u| t_p) dA
// for t_p = 2.285 sqrt(R / g) after the skin came out of the air into the water
// (cavity_laws.hpp); pi R^2 is what the body shows along its motion. Straight down a body of the
// area A takes in eta C_d A u^2 / g, whatever the water's spacing: of the water that it goes
// through the part 0.029 sqrt(u^2 / (g R)) with eta = 0.06. Slower than u0 nothing: the eddies of a
// wake have a third of the body's speed, and need bubble_onset. The air breaks up into bubbles as
// the hollow collapses, t_p / 2 later, where it was taken.
#pragma once

#include <vector>

#include "sim-server/detect/bubble_state.h"
#include "sim-server/detect/impacts.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// What bodies' wakes do in a frame.
struct WakeAir {
  /// Air that breaks up into bubbles; id: that of a point of the skin, counted on from the water's
  /// particles.
  std::vector<AirFold> folds;
  double work = 0.0;  ///< of bodies on the water, above u0: eta of it takes air down [J]
};

class Wakes {
 public:
  /// `gravity` [m/s2], `density` of water [kg/m3]; `particles`: their number.
  Wakes(double gravity, double density, int particles)
      : gravity_(gravity), density_(density), first_id_(particles) {}

  /// Of the `frame` [s] that ends at `time` [s]; `impacts` has observed the `points` then.
  [[nodiscard]] WakeAir observe(double time, double frame, const std::vector<SurfacePoint>& points,
                                const ImpactWatch& impacts, const DetectSettings& settings);
  void forget() { taken_.clear(); }

 private:
  struct Taken {
    double breaks_up = 0.0;  ///< [s]
    double air = 0.0;        ///< [m3]
    int point = 0;
    Touch touch = {};  ///< of it then
  };
  double take(double time, double frame, const std::vector<SurfacePoint>& points,
              const ImpactWatch& impacts, const DetectSettings& settings);

  double gravity_;
  double density_;
  int first_id_;
  std::vector<Taken> taken_;
};

}  // namespace splash::sim
