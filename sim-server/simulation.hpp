// SPDX-License-Identifier: MIT
// A scene at work: water, bodies and detectors, frame by frame. Knows neither clocks nor OSC.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/detect/detector.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/needs.hpp"
#include "sim-server/tracking/live_motion.hpp"

namespace splash::sim {

/// What one frame did.
struct FrameResult {
  double seconds = 0.0;  ///< simulated time at its end [s]
  Detections found;
  Survey survey;
  bool restored = false;  ///< the state had to be taken back to the last good one
};

/// Sums over a run.
struct RunTotals {
  std::int64_t steps = 0;
  std::int64_t frames = 0;
  double mean_excess_sum = 0.0;  ///< of the frames' mean density errors [1]
  double max_excess = 0.0;       ///< [1]
  std::uint64_t resets = 0;
  std::uint64_t bubbles_dropped = 0;
  SkipTotals skipped;
};

class Simulation {
 public:
  /// `tracker`: a marker file that replaces the scene's, or empty. Builds all kernels. Throws
  /// protocol::ConfigError for what the scene says wrong, std::runtime_error for the device.
  Simulation(Device& device, const Scene& scene, const std::filesystem::path& tracker);

  /// Simulates one frame: some equal steps, the detectors in the last one.
  [[nodiscard]] FrameResult advance();

  [[nodiscard]] double seconds() const noexcept { return seconds_; }
  [[nodiscard]] const RunTotals& totals() const noexcept { return totals_; }
  [[nodiscard]] int particles() const noexcept { return fluid_.params().count; }
  [[nodiscard]] const Bodies& bodies() const noexcept { return bodies_; }
  [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
  [[nodiscard]] Fluid& fluid() noexcept { return fluid_; }
  [[nodiscard]] double time_step() const noexcept { return largest_step_; }
  /// The body that an OSC tracker moves, or null.
  [[nodiscard]] LiveMotion* live_body(int body) const noexcept;
  /// Index of the body nearest to a place, -1 without bodies.
  [[nodiscard]] int nearest_body(const Vector3& place) const;

 private:
  [[nodiscard]] std::vector<Step> plan_frame(const FrameSteps& steps,
                                             std::vector<BodyStep>& poses) const;
  /// All of a frame that computes anything.
  [[nodiscard]] FrameResult compute(const std::vector<Step>& plan, const FrameNeeds& needs);
  void count(const FrameNeeds& needs);
  void keep_healthy(FrameResult& result);

  Scene scene_;
  std::vector<LiveMotion*> live_;
  Bodies bodies_;
  Fluid fluid_;
  Detector detector_;
  Needs needs_;
  Survey survey_;  ///< the last one
  double seconds_ = 0.0;
  double detected_at_ = 0.0;   ///< time of the last detection [s]
  double largest_step_ = 0.0;  ///< [s]
  double step_share_ = 1.0;    ///< of the largest step, less after a failure [1]
  Snapshot good_;
  RunTotals totals_;
};

}  // namespace splash::sim
