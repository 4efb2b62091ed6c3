// SPDX-License-Identifier: MIT
// Air that has been folded in and not told yet: bubbles are drawn from it until it is used up, so
// that the sum of their volumes is the air's, but for the last one.
#pragma once

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// Volume of a bubble [m3].
[[nodiscard]] double bubble_volume(double radius);

class AirAccount {
 public:
  /// In a frame of `frame` seconds so much air is folded in [m3].
  void begin(double air, double frame);
  /// No bubble is larger now: as large as the air of the last 0.1 s, and 8 mm or more, within the
  /// settings' radii (the largest pocket bounds its fragments: Deike et al. 2016) [m].
  [[nodiscard]] double largest(const DetectSettings& settings) const;

  /// Its part of the frame's air [m3].
  void add(double air) noexcept { owed_ += air; }
  /// Whether there is air for a bubble.
  [[nodiscard]] bool is_open() const noexcept { return owed_ > 0.0; }
  /// A bubble of that radius is told [m].
  void take(double radius) { owed_ -= bubble_volume(radius); }
  /// Of what could not be told no more than so much is kept [m3].
  void keep(double most);
  /// Told less, or more, than folded in [m3].
  [[nodiscard]] double owed() const noexcept { return owed_; }

 private:
  double owed_ = 0.0;    ///< [m3]
  double recent_ = 0.0;  ///< of about the last 0.1 s [m3]
};

}  // namespace splash::sim
