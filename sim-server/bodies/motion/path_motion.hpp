// SPDX-License-Identifier: MIT
// A body that runs through known poses: scripts and recordings. Between two poses the way is a
// formula, and the velocities are that formula's derivative, so position and velocity agree.
#pragma once

#include <vector>

#include "sim-server/bodies/motion/motion.hpp"

namespace splash::sim {

enum class Between {
  straight,  ///< constant speed and spin between poses
  monotone,  ///< cubic without overshoot (Fritsch & Butland 1984); stops where the direction turns
  through,   ///< cubic with the parabola's slope at each pose (Catmull-Rom): for sampled motion
};

class PathMotion : public Motion {
 public:
  /// `start`: seconds on the path's own clock at simulated time 0. Before the first pose and after
  /// the last it stands still there; with `repeat` the path from `start` to the end comes again.
  /// Throws std::invalid_argument: no pose, times not increasing, `start` at or after the end,
  /// or `repeat` with a last pose that is not the one at `start` (within 1 cm and 5 degrees).
  PathMotion(const std::vector<Keyframe>& poses, Between between, bool repeat = false,
             double start = 0.0);

  [[nodiscard]] BodyState at(double seconds) const override;
  [[nodiscard]] double fastest() const override;
  [[nodiscard]] std::vector<double> moments() const override;

 private:
  struct Knot {
    double time = 0.0;
    Vector3 position = {};
    Quaternion rotation = {0.0, 0.0, 0.0, 1.0};
    Vector3 velocity = {};  ///< [m/s]
    Vector3 spin = {};      ///< in the body's own frame [rad/s]
  };

  void set_slopes(Between between);
  void check_repeat() const;
  [[nodiscard]] BodyState on_path(double time) const;
  [[nodiscard]] BodyState straight(const Knot& from, const Knot& to, double time) const;
  [[nodiscard]] BodyState cubic(const Knot& from, const Knot& to, double time) const;

  std::vector<Knot> knots_;
  bool straight_;
  bool repeat_;
  double start_;
};

}  // namespace splash::sim
