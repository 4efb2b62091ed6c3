// SPDX-License-Identifier: MIT
// Scenes with so little water that a busy machine keeps up with them.
#pragma once

#include <string>

#include "tests/support/programs.hpp"

namespace splash::tests {

/// A scene file that is removed with this.
class SmallScene {
 public:
  /// `motion`: the YAML of the only body's motion, a mapping in flow style. The body is a disc 5 cm
  /// thick, high above the water at first, whose level is kLevel. `solver`: as in a scene.
  explicit SmallScene(const std::string& motion, int seed = 1, const std::string& solver = "auto");
  ~SmallScene();
  SmallScene(const SmallScene&) = delete;
  SmallScene& operator=(const SmallScene&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  static constexpr double kLevel = 0.2;        ///< [m]
  static constexpr double kRest = 0.35;        ///< height of the disc's centre at the start [m]
  static constexpr double kUnderside = 0.025;  ///< of the disc below its centre [m]

 private:
  std::string path_;
};

/// Runs sim-server with a scene for so many simulated seconds, as fast as it can.
[[nodiscard]] Ended simulate(const std::string& scene, double seconds,
                             const Arguments& further = {},
                             const ChildProcess::Environment& environment = {});

/// Down into the water and out again, once a second, for ever: an impact and bubbles each time.
[[nodiscard]] std::string plunging();
/// Where /body/pose says.
[[nodiscard]] std::string tracked();

}  // namespace splash::tests
