// SPDX-License-Identifier: MIT
// Decides how a frame with a fault is recovered. First it is computed again from the last good
// state with steps of half the length, up to three times. Then the water around the fault is
// stopped in its last good state, and time goes on. When that does not help either, the scene
// restarts. So recovery always ends, and soon. And the fault: where it is, how the water around it
// is stopped, and how it is described.
#pragma once

#include <string>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/health/health.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

enum class Remedy {
  retry,  ///< compute the frame once more
  calm,   ///< give the frame up; stop the water around the fault
  reset,  ///< give the frame up; begin with the scene's first state
};

class Recovery {
 public:
  static constexpr int kTries = 3;          ///< of a frame, besides the first
  static constexpr int kFramesGivenUp = 3;  ///< in a row, the last of which is the scene's reset

  /// The part of the largest stable step that the next try is computed with [1].
  [[nodiscard]] double step_share() const noexcept { return share_; }
  /// The number of frames given up in a row.
  [[nodiscard]] int given_up() const noexcept { return given_up_; }
  /// The number of failed tries of the present frame.
  [[nodiscard]] int failed_tries() const noexcept { return failed_; }

  /// Takes note of a try with a fault. Returns what to do about it.
  [[nodiscard]] Remedy failed() noexcept;
  /// Takes note of a frame without a fault: steps grow again gradually.
  void succeeded() noexcept;

 private:
  double share_ = 1.0;
  int failed_ = 0;
  int given_up_ = 0;
};

/// A fault of a frame and how it was recovered, for the log.
struct StepFault {
  Diagnosis what;
  std::int64_t step = 0;            ///< of the run
  double seconds = 0.0;             ///< simulated, at the beginning of that step [s]
  Vector3 place = {0.0, 0.0, 0.0};  ///< of the particle when it last was sound [m]
  std::string body;                 ///< the nearest to that place; empty: none
  double distance = 0.0;            ///< of its centre [m]
  Remedy remedy = Remedy::retry;    ///< that ended it
  int tries = 0;                    ///< that failed
  double calmed = 0.0;              ///< radius within which the water was stopped [m]
};

/// Returns what was wrong with which particle or body, and where.
[[nodiscard]] std::string describe_fault(const StepFault& step_fault);
/// Returns a sentence: time, place, fault, likely cause and recovery.
[[nodiscard]] std::string describe(const StepFault& step_fault);

// Locates a fault once the water is back in its last good state, and stops the water around it.

/// Adds the place of a fault and the nearest body to `step_fault`, whose diagnosis and time are
/// known. `sound_at`: time of the water's state [s].
void locate(StepFault& step_fault, Fluid& fluid, const Bodies& bodies, const Scene& scene,
            double sound_at);

/// Stops the water and the free bodies around the fault, or all of it when many particles were
/// wrong. The radius grows with `times`, the number of frames given up in a row; it is stored in
/// `step_fault`.
void calm(StepFault& step_fault, Fluid& fluid, Bodies& bodies, int times, double sound_at);

}  // namespace splash::sim
