// SPDX-License-Identifier: MIT
// Entrained air that has not become bubbles yet. Bubbles are drawn until it is used up, so that the
// sum of their volumes is the air's, but for the last one.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Volume of a bubble [m3].
[[nodiscard]] double bubble_volume(double radius);

class AirAccount {
 public:
  /// The part of the energy `lost` at the water's surface in a frame [J] that no body has given to
  /// the water: bodies' `work` in this frame [J], and what is left of their earlier work, which
  /// decays within about a second, are subtracted first [J].
  [[nodiscard]] double own_loss(double lost, double work, double frame);

  /// Begins a frame of `frame` seconds, in which `air` is entrained [m3].
  void begin(double air, double frame);
  /// Largest radius of a bubble now: that of a sphere of the air of the last 0.1 s, 8 mm at least,
  /// within the settings' radii (a pocket bounds its fragments: Deike et al. 2016) [m].
  [[nodiscard]] double largest(const DetectSettings& settings) const;

  /// Adds a part of the frame's air [m3].
  void add(double air) noexcept { owed_ += air; }
  /// Whether some of it is left for a bubble.
  [[nodiscard]] bool has_air() const noexcept { return owed_ > 0.0; }
  /// Takes the volume of a bubble of that radius [m].
  void take(double radius) { owed_ -= bubble_volume(radius); }
  /// Forgets what is left above `most` [m3].
  void keep(double most);
  /// Air left; negative: the last bubble took more than there was [m3].
  [[nodiscard]] double owed() const noexcept { return owed_; }

 private:
  double owed_ = 0.0;    ///< [m3]
  double recent_ = 0.0;  ///< of about the last 0.1 s [m3]
  double given_ = 0.0;   ///< work of bodies that water has not lost yet [J]
};

}  // namespace splash::sim
