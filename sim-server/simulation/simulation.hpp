// SPDX-License-Identifier: MIT
// A scene at work: water, bodies and detectors, frame by frame. Knows neither clocks nor OSC.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/motion/posed_motion.hpp"
#include "sim-server/detect/cavity_watch.hpp"
#include "sim-server/detect/detector.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/free_bodies/body_pushes.hpp"
#include "sim-server/fluid/health/checkpoint.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "sim-server/scene/support_state.hpp"
#include "sim-server/simulation/frame_plan.hpp"
#include "sim-server/simulation/hung_bodies.hpp"
#include "sim-server/simulation/recovery/recovery.hpp"
#include "sim-server/simulation/recovery/step_fault.hpp"
#include "sim-server/start/settle.hpp"

namespace splash::sim {

/// What one frame did.
struct FrameResult {
  double seconds = 0.0;  ///< simulated time at its end [s]
  Detections found;
  FluidStats stats;
  std::vector<BodyPush> pushes;         ///< that devices feel, while somebody wants to
  std::optional<StepFault> step_fault;  ///< something went wrong; found is of a sound try, or empty
};

/// Sums over a run.
struct RunTotals {
  std::int64_t steps = 0;
  std::int64_t frames = 0;
  double mean_excess_sum = 0.0;  ///< of the frames' mean density errors [1]
  double max_excess = 0.0;       ///< [1]
  std::uint64_t retried = 0;     ///< frames that were sound only with shorter steps
  std::uint64_t calmed = 0;      ///< frames given up, the water around a fault stopped
  std::uint64_t resets = 0;      ///< frames given up, the scene begun anew
  std::uint64_t bubbles_dropped = 0;
  std::size_t bubbles_alive = 0;       ///< bubble particles, now
  double bubbles_alive_sum = 0.0;      ///< of the frames' numbers of them
  std::size_t bubbles_alive_most = 0;  ///< of any frame
  AirTotals air;
  NoCavity no_cavity;
  SkipTotals skipped;
  std::uint64_t felt = 0;  ///< frames whose pushes on bodies were found
};

/// Where in a step a hook is called.
enum class Moment { before, between };

/// For tests: may change what a step works on, and its length.
using StepHook = std::function<void(Fluid&, Step&, Moment)>;

class Simulation {
 public:
  /// `tracker`: a marker file that replaces the scene's, or empty. Builds all kernels and lets the
  /// water settle, whose progress it can `tell`. Throws program::ConfigError for what the scene
  /// says wrong, program::Failure for water that does not come to rest, DeviceError for the
  /// device.
  Simulation(Device& device, const Scene& scene, const std::filesystem::path& tracker,
             const Progress& tell = {});

  /// Simulates one frame: some equal steps, the detectors in the last one. What is not sound is
  /// done again or given up (Recovery); nothing of it is told.
  [[nodiscard]] FrameResult advance();
  /// Our clock when simulated time was 0, as of the next frame [s]: what poses are stamped by.
  void set_origin(double origin) noexcept { origin_ = origin; }
  /// How long steps are, from the next frame on.
  [[nodiscard]] StepPolicy& step_policy() noexcept { return step_policy_; }
  /// Detection by other thresholds, from the next frame on; `cavity_by_count` stays.
  void set_detection(const DetectSettings& settings);
  /// Goes on from `water`, which a simulation of the same scene had at `seconds`; bubbles are lost.
  void resume(const Snapshot& water, double seconds) {
    fluid_.restore(water);
    seconds_ = detected_at_ = seconds;
    sound_.keep(fluid_.device(), state());
    planner_.forget();
    cavity_watch_.forget();
  }
  /// The scene begins anew, its time goes on: water, free bodies and the bodies' own motions.
  void begin_anew();
  /// Whether the pushes on bodies are found, from the next frame on. Needs can_feel(). The first
  /// time builds kernels where no body follows poses from the start on.
  void feel(bool on);
  /// Poses can move a body, in water that is not a grid's, or a body hangs on a device.
  [[nodiscard]] bool can_feel() const noexcept { return can_feel_; }
  void set_hook(StepHook hook) { hook_ = std::move(hook); }

  [[nodiscard]] double seconds() const noexcept { return seconds_; }
  [[nodiscard]] const RunTotals& totals() const noexcept { return totals_; }
  /// Of the pressure solver, without the settling.
  [[nodiscard]] SolverWork solver_work() const { return fluid_.solver_work(); }
  [[nodiscard]] int particles() const noexcept { return fluid_.params().count; }
  [[nodiscard]] const Bodies& bodies() const noexcept { return bodies_; }
  [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
  /// Of each particle, by its id: what came to rest before time began, and what did not.
  [[nodiscard]] const std::vector<SupportState>& support_states() const noexcept {
    return support_states_;
  }
  [[nodiscard]] Fluid& fluid() noexcept { return fluid_; }
  /// Where the bubble particles are [m].
  [[nodiscard]] std::vector<Vector3> bubble_places() const { return detector_.bubble_places(); }
  [[nodiscard]] double time_step() const noexcept { return largest_step_; }
  [[nodiscard]] float sound_speed() const noexcept {
    return fluid_.params().sound_speed;
  }  ///< [m/s]
  /// The body that poses can move, or null: the water moves it, or there is none.
  [[nodiscard]] PosedMotion* live_body(int body) const noexcept;
  /// Index of the body nearest to a place when events were last looked for, -1 without bodies.
  [[nodiscard]] int nearest_body(const Vector3& place) const {
    return bodies_.nearest(place, detected_at_);
  }

 private:
  [[nodiscard]] std::vector<Step> steps_of(const FrameSteps& division,
                                           std::vector<BodyStep>& poses) const;
  /// Where bodies and devices are in the steps of a frame, to the device.
  void set_bodies(const FrameSteps& steps, const std::vector<BodyStep>& poses);
  /// What is felt of a frame of so many seconds that has been computed.
  [[nodiscard]] std::vector<BodyPush> find_pushes(double seconds);
  /// One try of a frame; nullopt: it was not sound.
  [[nodiscard]] std::optional<FrameResult> attempt(const std::vector<Step>& steps,
                                                   const FramePlan& plan);
  void enqueue(const std::vector<Step>& steps, const FramePlan& plan, double since);
  /// What the detectors found in a frame that was sound.
  [[nodiscard]] Detections collect(double detect_time, double since);
  [[nodiscard]] FrameResult hold_still(double frame);
  /// Of the frame that has been computed, with so many steps.
  [[nodiscard]] std::optional<Diagnosis> diagnosis(std::size_t steps);
  void keep(const FrameResult& result);
  /// Of bodies and the piston [m/s].
  [[nodiscard]] double fastest_mover(double seconds) const;
  void set_largest_step(double fastest, double acceleration);
  void count(const FramePlan& plan);

  [[nodiscard]] std::vector<cl::Buffer> state() const;
  /// Computes a frame with all that a splash needs, and takes it back.
  void rehearse();
  /// Takes the state back to the last sound one, and notes what was wrong.
  [[nodiscard]] StepFault examine(const Diagnosis& what, double dt);
  /// Ends a frame that no try made sound.
  /// Water and free bodies as they were when time began; `seconds`: now [s].
  void restore_start(double seconds);
  [[nodiscard]] FrameResult give_up(StepFault& step_fault, double frame);

  Scene scene_;
  std::vector<PosedMotion*> live_;
  Bodies bodies_;
  HungBodies hung_;
  std::vector<SupportState> support_states_;
  Fluid fluid_;
  Detector detector_;
  CavityWatch cavity_watch_;
  FramePlanner planner_;
  FluidStats stats_;                    ///< the last one
  std::unique_ptr<BodyPushes> pushes_;  ///< null until somebody wants to feel the water
  bool can_feel_ = false;
  bool feels_ = false;
  std::vector<BodyPush> felt_;  ///< of the last frame that was computed
  double seconds_ = 0.0;
  double begun_ = 0.0;        ///< when the scene last began anew [s]
  double detected_at_ = 0.0;  ///< time of the last detection [s]
  StepPolicy step_policy_;
  double largest_step_ = 0.0;  ///< [s]
  double contact_step_ = 0.0;  ///< no step is longer (bodies/contact_step.hpp) [s]
  double thrown_until_ = 0.0;  ///< water may be as fast as it can be [s]
  double origin_ = 0.0;        ///< our clock when simulated time was 0 [s]
  Recovery recovery_;
  Checkpoint sound_;  ///< the end of the last sound frame
  Snapshot start_;    ///< when time began
  StepHook hook_;
  std::optional<Diagnosis> wrong_;  ///< with the last try
  RunTotals totals_;
};

}  // namespace splash::sim
