// SPDX-License-Identifier: MIT
#include "sim-server/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/settle.hpp"
#include "sim-server/scene/flow.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/tracking/make_motion.hpp"

namespace splash::sim {
namespace {

/// Frames between two copies of the state: it is what a failure goes back to.
constexpr std::int64_t kSnapshotFrames = 20;

/// The lattice is no stable packing: the water finds a better one in the first second, and would
/// be heard doing so. It is given this long before time begins [s].
constexpr double kSettleSeconds = 1.0;

Bodies make_bodies(const Scene& scene, const std::filesystem::path& tracker,
                   std::vector<LiveMotion*>& live) {
  std::vector<std::unique_ptr<Motion>> motions;
  for (const BodySettings& body : scene.bodies) {
    motions.push_back(make_motion(body, tracker));
    live.push_back(dynamic_cast<LiveMotion*>(motions.back().get()));
  }
  const double support = support_radius(scene);
  return {sample_bodies(scene.bodies, particle_spacing(scene), support), std::move(motions),
          support};
}

std::vector<Vector3> particles_around(const Scene& scene, const Bodies& bodies) {
  std::vector<Keyframe> poses;
  for (std::size_t b = 0; b < bodies.count(); ++b) {
    const BodyState state = bodies.state(b, 0.0);
    poses.push_back({0.0, state.position, state.rotation});
  }
  return initial_particles(scene, poses);
}

Fluid make_fluid(Device& device, const Scene& scene, const Bodies& bodies) {
  const std::vector<Vector3> particles = particles_around(scene, bodies);
  const std::vector<BoundaryPoint> boundary(bodies.points().begin(), bodies.points().end());
  return {device, make_params(scene, particles), settled(scene, particles), boundary,
          body_shapes(scene.bodies)};
}

SleepRule sleep_rule(const Scene& scene) {
  return {scene.skip.sleep_speed,
          static_cast<int>(std::ceil(scene.skip.sleep_after * scene.serve.frame_rate))};
}

/// Gives every particle the velocity of the scene's flow; the fastest of them [m/s].
double start_flow(Fluid& fluid, const Scene& scene) {
  if (scene.flow.kind == FlowKind::none) return 0.0;
  Snapshot state = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  double fastest = 0.0;
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    const auto at = [&](std::size_t axis) {
      return static_cast<double>(state.position[axis * stride + i]);
    };
    const Vector3 v = initial_velocity(scene, {at(0), at(1), at(2)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      state.velocity[axis * stride + i] = static_cast<float>(v[axis]);
    }
    fastest = std::max(fastest, length(v));
  }
  fluid.restore(state);
  return fastest;
}

}  // namespace

Simulation::Simulation(Device& device, const Scene& scene, const std::filesystem::path& tracker)
    : scene_(scene),
      bodies_(make_bodies(scene_, tracker, live_)),
      fluid_(make_fluid(device, scene_, bodies_)),
      detector_(fluid_, bodies_.points(), scene_.detect, scene_.seed, !scene_.skip.cavities),
      needs_(scene_.skip, scene_.detect.bubble_speed, fluid_.params().count) {
  largest_step_ =
      largest_time_step(fluid_.params(), bodies_.fastest(0.0), std::abs(scene_.fluid.gravity[2]),
                        scene_.fluid.time_step_factor);
  const PistonState piston = piston_at(scene_.wave_maker, 0.0);
  settle(fluid_, bodies_.at(0.0), piston.offset, kSettleSeconds, largest_step_);
  if (scene_.gate.present) fluid_.drop_last_wall();
  const double fastest = std::max(start_flow(fluid_, scene_), bodies_.fastest(0.0));
  largest_step_ = largest_time_step(fluid_.params(), fastest, std::abs(scene_.fluid.gravity[2]),
                                    scene_.fluid.time_step_factor);
  good_ = fluid_.snapshot();
  // The divergence-free solver balances all of the water in every step: none of it may sleep.
  const bool may_sleep = scene_.fluid.solver == PressureKind::weakly_compressible;
  if (scene_.skip.sleep && may_sleep) fluid_.let_sleep(sleep_rule(scene_));
}

std::vector<Step> Simulation::plan_frame(const FrameSteps& steps,
                                         std::vector<BodyStep>& poses) const {
  std::vector<Step> plan;
  for (int k = 0; k < steps.count; ++k) {
    const double time = seconds_ + k * steps.dt;
    const PistonState piston = piston_at(scene_.wave_maker, time);
    plan.push_back({steps.dt, piston.offset, piston.speed, static_cast<int>(poses.size()), k == 0});
    const std::vector<BodyStep> now = bodies_.at(time);
    poses.insert(poses.end(), now.begin(), now.end());
  }
  return plan;
}

FrameResult Simulation::advance() {
  const FrameSteps steps =
      steps_of_frame(1.0 / scene_.serve.frame_rate, step_share_ * largest_step_);
  std::vector<BodyStep> poses;
  const std::vector<Step> plan = plan_frame(steps, poses);
  const FrameNeeds needs =
      needs_.of_frame(poses, survey_, steps.count * steps.dt, plan.front().piston_speed != 0.0,
                      detector_.bubbles_alive());
  count(needs);
  if (needs.steps) {
    fluid_.set_bodies(poses);
    return compute(plan, needs);
  }
  FrameResult still;
  seconds_ += steps.count * steps.dt;
  detected_at_ = seconds_;
  still.seconds = seconds_;
  still.survey = survey_;
  totals_.mean_excess_sum += survey_.mean_excess;
  return still;
}

FrameResult Simulation::compute(const std::vector<Step>& plan, const FrameNeeds& needs) {
  const double dt = plan.front().dt;
  const auto steps = static_cast<int>(plan.size());
  const double detect_time = seconds_ + (steps - 1) * dt;
  const double since = detect_time - detected_at_;
  for (const Step& step : plan) {
    fluid_.prepare(step);
    if (&step == &plan.back()) detector_.enqueue(step, since, {needs.contacts, needs.bubbles});
    fluid_.advance(step);
  }
  seconds_ += steps * dt;
  totals_.steps += steps;
  fluid_.enqueue_survey();
  fluid_.device().queue().finish();

  FrameResult result;
  result.seconds = seconds_;
  result.found = detector_.collect(detect_time, since, static_cast<std::uint32_t>(totals_.steps));
  survey_ = result.survey = fluid_.survey_result();
  detected_at_ = detect_time;
  keep_healthy(result);
  return result;
}

void Simulation::count(const FrameNeeds& needs) {
  ++totals_.frames;
  SkipTotals& skipped = totals_.skipped;
  skipped.idle += !needs.steps;
  skipped.contacts += !needs.steps || !needs.contacts;
  skipped.bubbles += !needs.steps || !needs.bubbles;
  skipped.cavities = static_cast<std::uint64_t>(totals_.frames) - detector_.cavity_searches();
  skipped.asleep_sum += static_cast<double>(survey_.asleep) / fluid_.params().count;
}

void Simulation::keep_healthy(FrameResult& result) {
  totals_.bubbles_dropped = detector_.bubbles_dropped();
  if (result.survey.not_finite > 0) {
    // Nothing of a frame that went wrong is told; time goes on, with smaller steps for a while.
    fluid_.restore(good_);
    needs_.forget();
    result.found = {};
    result.restored = true;
    ++totals_.resets;
    step_share_ = std::max(step_share_ / 2.0, 0.125);
    return;
  }
  step_share_ = std::min(step_share_ * 1.02, 1.0);
  totals_.mean_excess_sum += result.survey.mean_excess;
  totals_.max_excess = std::max(totals_.max_excess, result.survey.max_excess);
  const double fastest = std::max(result.survey.speed, bodies_.fastest(seconds_));
  largest_step_ = largest_time_step(fluid_.params(), fastest, result.survey.acceleration,
                                    scene_.fluid.time_step_factor);
  if (totals_.frames % kSnapshotFrames == 0) good_ = fluid_.snapshot();
}

LiveMotion* Simulation::live_body(int body) const noexcept {
  const bool known = body >= 0 && static_cast<std::size_t>(body) < live_.size();
  return known ? live_[static_cast<std::size_t>(body)] : nullptr;
}

int Simulation::nearest_body(const Vector3& place) const {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < bodies_.count(); ++b) {
    const Vector3 centre = bodies_.state(b, detected_at_).position;
    const double distance =
        std::hypot(place[0] - centre[0], place[1] - centre[1], place[2] - centre[2]);
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(b);
    }
  }
  return nearest;
}

}  // namespace splash::sim
