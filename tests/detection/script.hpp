// SPDX-License-Identifier: MIT
// Scenes of a few lines: a tank of water whose level is at a height, and bodies on straight ways.
#pragma once

#include <string>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::detection {

/// A number as YAML reads it, and a place in brackets.
[[nodiscard]] std::string digits(double value);
[[nodiscard]] std::string digits(const sim::Vector3& place);

/// Turned about y: the +x end down by so many degrees.
[[nodiscard]] sim::Quaternion pitched(double degrees);

[[nodiscard]] sim::Shape box(const sim::Vector3& size);
[[nodiscard]] sim::Shape ball(double diameter);
[[nodiscard]] sim::Shape disc(double diameter, double thickness);
/// Length, width and thickness of a hand.
[[nodiscard]] sim::Shape hand();

/// A motion of straight parts at constant speed: in closed form whatever reads it.
class Way {
 public:
  explicit Way(const sim::Vector3& start, const sim::Quaternion& turn = {0.0, 0.0, 0.0, 1.0});
  Way& to(const sim::Vector3& place, double speed);
  /// By so much, at that velocity.
  Way& go(const sim::Vector3& velocity, double seconds);
  Way& wait(double seconds);

  [[nodiscard]] const sim::Vector3& place() const noexcept { return keys_.back().position; }
  [[nodiscard]] double end() const noexcept { return keys_.back().time; }
  /// The `motion` of a body.
  [[nodiscard]] std::string text() const;

 private:
  void add(const sim::Vector3& place, double time);
  std::vector<sim::Keyframe> keys_;
};

/// An open box of water.
struct Pool {
  sim::Vector3 lower = {0.0, 0.0, 0.0};  ///< of the water at rest [m]
  sim::Vector3 upper = {0.0, 0.0, 0.0};
  double spacing = 0.025;
  double above = 0.4;  ///< of the walls above the level [m]

  /// A whole scene; `bodies` as body_text gives them, `water`: more of it, lines of a list.
  [[nodiscard]] std::string scene(const std::vector<std::string>& bodies,
                                  const std::string& water = "") const;
};

/// One whose floor is at z = 0, its middle at x = y = 0, with water up to `level`.
struct Basin {
  double length = 0.45;  ///< along x [m]
  double width = 0.36;   ///< along y [m]
  double level = 0.24;   ///< [m]
  double spacing = 0.025;

  /// The same.
  [[nodiscard]] std::string scene(const std::vector<std::string>& bodies,
                                  const std::string& water = "") const;
};

/// `shape` is written as it stands, e.g. "kind: sphere, size: [0.1, 0.1, 0.1]".
[[nodiscard]] std::string shape_text(const sim::Shape& shape);
[[nodiscard]] std::string body_text(const std::string& name, const std::string& shape,
                                    const std::string& motion);
[[nodiscard]] std::string free_text(const std::string& name, const std::string& shape,
                                    const sim::Vector3& place, double density);

}  // namespace splash::detection
