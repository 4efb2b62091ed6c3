// SPDX-License-Identifier: MIT
// Simulates a scene frame by frame: water, bodies and detectors. It knows neither clocks nor OSC.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/bodies/motion/posed_motion.hpp"
#include "sim-server/detect/cavity_watch.hpp"
#include "sim-server/detect/detector.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/free_bodies/body_pushes.hpp"
#include "sim-server/fluid/health/health.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "sim-server/scene/support_state.hpp"
#include "sim-server/scene/tank_motion.hpp"
#include "sim-server/simulation/frame_plan.hpp"
#include "sim-server/simulation/free_bodies.hpp"
#include "sim-server/simulation/recovery/recovery.hpp"
#include "sim-server/start/settle.hpp"

namespace splash::sim {

/// The result of one frame.
struct FrameResult {
  double seconds = 0.0;  ///< simulated time at its end [s]
  Detections found;
  FluidStats stats;
  std::vector<BodyPush> pushes;         ///< forces that devices feel, while they are asked for
  std::optional<StepFault> step_fault;  ///< a fault; `found` is of a try without one, or empty
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

/// The moment in a step at which a hook is called.
enum class Moment { before, between };

/// For tests: a hook may change the state that a step works on, and the step's length.
using StepHook = std::function<void(Fluid&, Step&, Moment)>;

class Simulation {
 public:
  /// Builds all kernels and lets the water settle. `tracker`: a marker file that replaces the
  /// scene's, or empty; `tell` is called with the progress of the settling; `settled`: a file that
  /// keeps the water at rest (start/settled_water.hpp), or empty. Throws program::ConfigError for
  /// what the scene says wrong, program::Failure for water that does not come to rest and for the
  /// file, DeviceError for the device.
  Simulation(Device& device, const Scene& scene, const std::filesystem::path& tracker,
             const Progress& tell = {}, const std::filesystem::path& settled = {});

  /// Simulates one frame: some equal steps, with the detectors in the last one. A try with a fault
  /// is repeated or given up (Recovery); its events are discarded.
  [[nodiscard]] FrameResult advance();
  /// Sets the wall clock at simulated time 0, as of the next frame [s]; poses are stamped by it.
  void set_origin(double origin) noexcept { origin_ = origin; }
  /// The length of steps, from the next frame on.
  [[nodiscard]] StepPolicy& step_policy() noexcept { return step_policy_; }
  /// Detects by other thresholds, from the next frame on; `cavity_by_count` stays.
  void set_detection(const DetectSettings& settings);
  /// Continues from `water`, which a simulation of the same scene had at `seconds`; bubbles are
  /// lost.
  void resume(const Snapshot& water, double seconds) {
    fluid_.restore(water);
    seconds_ = detected_at_ = seconds;
    felt_of_.clear();
    sound_.keep(fluid_.device(), state());
    planner_.forget();
    cavity_watch_.forget();
  }
  /// Restarts the scene (water, free bodies and the bodies' own motions); its time goes on.
  void restart();
  /// Computes the forces on bodies, or not, from the next frame on. Requires can_feel(). The first
  /// call builds kernels where no body follows poses from the start on.
  void feel(bool on);
  /// Computes the forces on the bodies that the scene's gauges read, from now on, if the solver is
  /// the grid's: Bodies::force() is then the mean force over the last frame. Must be called before
  /// the first frame; until that ends, the force is that of a trial step.
  void measure_forces();
  /// Whether forces can be computed: poses can move a body, or a body hangs on a device.
  [[nodiscard]] bool can_feel() const noexcept { return can_feel_; }
  void set_hook(StepHook hook) { hook_ = std::move(hook); }

  /// Whether the water at rest came from a file.
  [[nodiscard]] bool took_up_water() const noexcept { return took_up_water_; }
  [[nodiscard]] double seconds() const noexcept { return seconds_; }
  [[nodiscard]] const RunTotals& totals() const noexcept { return totals_; }
  /// The work of the pressure solver, without the settling.
  [[nodiscard]] SolveWork solver_work() const { return fluid_.solver_work(); }
  [[nodiscard]] int particles() const noexcept { return fluid_.params().count; }
  [[nodiscard]] const Bodies& bodies() const noexcept { return bodies_; }
  [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
  /// The state of each particle, by its id, before the water came to rest.
  [[nodiscard]] const std::vector<SupportState>& support_states() const noexcept {
    return support_states_;
  }
  [[nodiscard]] Fluid& fluid() noexcept { return fluid_; }
  /// The places of the bubble particles [m].
  [[nodiscard]] std::vector<Vector3> bubble_places() const { return detector_.bubble_places(); }
  [[nodiscard]] double time_step() const noexcept { return largest_step_; }
  [[nodiscard]] float sound_speed() const noexcept {
    return fluid_.params().sound_speed;
  }  ///< [m/s]
  /// Returns the body's motion if poses can move it, null if the water moves it or it does not
  /// exist.
  [[nodiscard]] PosedMotion* live_body(int body) const noexcept;
  /// The index of the body nearest to a place when events were last detected; -1 without bodies.
  [[nodiscard]] int nearest_body(const Vector3& place) const {
    return bodies_.nearest(place, detected_at_);
  }

 private:
  [[nodiscard]] std::vector<Step> steps_of(const FrameSteps& division,
                                           std::vector<BodyStep>& poses) const;
  /// Sets where bodies and devices are in the steps of a frame, and how the tank moves, on the
  /// device.
  void set_bodies(const FrameSteps& steps, const std::vector<BodyStep>& poses);
  /// Whether poses move the body, so that somebody may feel it.
  [[nodiscard]] bool is_felt_now(int body) const;
  /// The same of each body; empty: nobody feels any.
  [[nodiscard]] std::vector<bool> felt_now() const;
  /// Whether the force's derivatives are found in the frame of these steps, or are those of before.
  [[nodiscard]] bool wants_rates(const std::vector<BodyStep>& poses, double step, double frame);
  /// Stores the measured forces of a frame that lasts so many seconds in the bodies.
  void note_forces(double seconds);
  /// Returns the forces that are felt in a frame of so many seconds that has been computed.
  [[nodiscard]] std::vector<BodyPush> find_pushes(double seconds);
  /// Tries to compute a frame; nullopt: it had a fault.
  [[nodiscard]] std::optional<FrameResult> attempt(const std::vector<Step>& steps,
                                                   const FramePlan& plan);
  void enqueue(const std::vector<Step>& steps, const FramePlan& plan, double since);
  /// The detections of a frame without a fault.
  [[nodiscard]] Detections collect(double detect_time, double since);
  [[nodiscard]] FrameResult hold_still(double frame);
  /// The fault of the frame that has been computed, with so many steps.
  [[nodiscard]] std::optional<Diagnosis> diagnosis(std::size_t steps);
  void keep(const FrameResult& result);
  /// The speed of the fastest body or the piston [m/s].
  [[nodiscard]] double fastest_mover(double seconds) const;
  void set_largest_step(double fastest, double acceleration);
  void limit_step();
  void count(const FramePlan& plan);

  [[nodiscard]] std::vector<cl::Buffer> state() const;
  /// Computes a frame with all kernels that a splash uses, and discards it.
  void rehearse();
  /// Restores the last good state and describes the fault.
  [[nodiscard]] StepFault examine(const Diagnosis& what, double dt);
  /// Restores water and free bodies as they were when time began; `seconds`: now [s].
  void restore_start(double seconds);
  /// Ends a frame in which every try had a fault.
  [[nodiscard]] FrameResult give_up(StepFault& step_fault, double frame);

  Scene scene_;
  std::vector<PosedMotion*> live_;
  Bodies bodies_;
  HungBodies hung_;
  TankMotion tank_motion_;
  std::vector<SupportState> support_states_;
  Fluid fluid_;
  Detector detector_;
  CavityWatch cavity_watch_;
  FramePlanner planner_;
  FluidStats stats_;                    ///< the last one
  std::unique_ptr<BodyPushes> pushes_;  ///< null until forces are asked for
  bool took_up_water_ = false;
  bool can_feel_ = false;
  bool feels_ = false;
  std::set<std::size_t> measured_;  ///< bodies whose forces gauges read
  std::vector<BodyPush> felt_;      ///< of the last frame that was computed
  std::vector<bool> felt_of_;       ///< per body, whether felt_ has its force; empty: none asked
  bool rates_anew_ = true;          ///< in this frame it is found how forces depend on speeds
  double rated_way_ = 0.0;          ///< that anything may have gone since that was found [m]
  double rated_step_ = 0.0;         ///< the time step then [s]
  double seconds_ = 0.0;
  double begun_ = 0.0;        ///< when the scene last began anew [s]
  double detected_at_ = 0.0;  ///< time of the last detection [s]
  StepPolicy step_policy_;
  double largest_step_ = 0.0;  ///< [s]
  double contact_step_ = 0.0;  ///< no step is longer (bodies/mass.hpp) [s]
  double thrown_until_ = 0.0;  ///< water may be as fast as it can be [s]
  double origin_ = 0.0;        ///< our clock when simulated time was 0 [s]
  Recovery recovery_;
  Checkpoint sound_;  ///< the end of the last good frame
  Snapshot start_;    ///< when time began
  StepHook hook_;
  std::optional<Diagnosis> wrong_;  ///< the fault of the last try
  RunTotals totals_;
};

}  // namespace splash::sim
