// SPDX-License-Identifier: MIT
#include "sim-server/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/simulation/free_bodies.hpp"
#include "sim-server/simulation/recovery/recovery.hpp"
#include "sim-server/start/come_to_rest.hpp"
#include "sim-server/start/scene_start.hpp"
#include "sim-server/start/settled_water.hpp"

namespace splash::sim {
namespace {

/// What moves faster than this part of sound throws water that may reach the speed limit: splashes
/// are some times as fast as what makes them [1]. It flies for so long [s].
constexpr double kThrows = 1.0 / 8.0;
constexpr double kFlight = 1.0;

/// What counts as rest where the scene does not say it: packings that carry weight creep [m/s].
constexpr double kRestOfPackings = 0.02;
constexpr double kRestOnGrid = 0.003;

/// How forces on bodies depend on speeds is a matter of the water's shape. On a grid it takes six
/// solves, so it is found anew when something may have gone by this part of the spacing [1].
constexpr double kRatesHold = 0.1;

/// Slower water may sleep; 0: none may. Water that is shaken does not rest.
double sleep_speed(const Scene& scene) {
  if (!scene.skip.sleep || scene.tank_motion.present) return 0.0;
  const bool on_grid = scene.fluid.solver == PressureKind::grid_projected;
  const double usual = on_grid ? kRestOnGrid : kRestOfPackings;
  return scene.skip.sleep_speed > 0.0 ? scene.skip.sleep_speed : usual;
}

/// The grid's pressures are those of all water: all of it sleeps or none.
bool sleeps_whole(const Scene& scene) {
  return scene.fluid.solver == PressureKind::grid_projected;
}

SleepRule cells_sleep(const Scene& scene) {
  const double frames = std::ceil(scene.skip.sleep_after * scene.serve.frame_rate);
  return {sleeps_whole(scene) ? 0.0 : sleep_speed(scene), static_cast<int>(frames)};
}

WholeSleep all_sleep(const Scene& scene) {
  return {sleeps_whole(scene) ? sleep_speed(scene) : 0.0, scene.skip.sleep_after};
}

/// Slower water makes no bubbles: if none is faster than v, its eddies have v^2 / 2 at most, and
/// those that fold air in have 3/2 of the square of bubble_onset, or more [m/s].
double bubbling_speed(const DetectSettings& detect) {
  if (detect.bubble_per_particle) return detect.bubble_speed;
  return std::min(detect.bubble_speed, std::sqrt(3.0) * detect.bubble_onset);
}

double particle_volume(const FluidParams& p) {
  return static_cast<double>(p.mass) / static_cast<double>(p.rest_density);
}

std::vector<SkinPoint> skins_of(const Scene& scene, const FluidParams& p) {
  return sample_skins(scene.bodies, static_cast<double>(p.spacing));
}

std::unique_ptr<BodyPushes> make_pushes(Fluid& fluid, const Scene& scene,
                                        const std::set<std::size_t>& measured) {
  const std::vector<FreeBody> felt = felt_bodies(scene.bodies, measured);
  const auto spacing = static_cast<double>(fluid.params().spacing);
  return std::make_unique<BodyPushes>(fluid, felt, film_skins(scene.bodies, felt, spacing));
}

/// Whether a body is where poses are, from the start on.
bool has_tracked(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const BodySettings& body) {
    return body.motion.kind == MotionKind::osc && !is_tied(body);
  });
}

/// Where all particles are; waits [m].
std::vector<Vector3> read_places(Fluid& fluid) {
  const auto count = static_cast<std::size_t>(fluid.params().count);
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  const std::vector<float> parts =
      fluid.particles().position.read(fluid.device(), 2 * stride + count);
  return as_vectors(parts, stride, count);
}

}  // namespace

Simulation::Simulation(Device& device, const Scene& scene, const std::filesystem::path& tracker,
                       const Progress& tell, const std::filesystem::path& settled)
    : scene_(scene),
      bodies_(make_bodies(scene_, tracker, live_)),
      hung_(scene_.bodies, live_),
      tank_motion_(scene_.tank_motion, scene_.fluid.gravity),
      fluid_(make_fluid(device, scene_, bodies_, support_states_)),
      detector_(fluid_, skins_of(scene_, fluid_.params()), scene_.detect, scene_.seed,
                !scene_.skip.cavities),
      cavity_watch_(scene_, skins_of(scene_, fluid_.params()), particle_volume(fluid_.params()),
                    !scene_.skip.cavities),
      planner_(scene_.skip, bubbling_speed(scene_.detect), fluid_.params().count,
               all_sleep(scene_)),
      step_policy_(scene_.fluid) {
  if (settled.empty()) {
    come_to_rest(fluid_, scene_, bodies_, support_states_, tell);
  } else {
    took_up_water_ = rest_from_file(settled, fluid_, scene_, bodies_, support_states_, tell);
  }
  fluid_.forget_work();
  const std::vector<FreeBody> free = free_bodies(scene_.bodies);
  if (!free.empty()) {
    fluid_.release(free, film_skins(scene_.bodies, static_cast<double>(fluid_.params().spacing)),
                   scene_.frictions);
  }
  const double fastest = std::max(start_flow(fluid_, scene_), fastest_mover(0.0));
  contact_step_ = longest_contact_step(scene_.bodies, length(scene_.fluid.gravity));
  set_largest_step(fastest, std::abs(scene_.fluid.gravity[2]));
  start_ = fluid_.snapshot();
  sound_.keep(device, state());
  if (!sleeps_whole(scene_)) fluid_.let_sleep(cells_sleep(scene_));
  totals_.skipped.kernel_parts = fluid_.parts().left_out();
  can_feel_ = !hung_.empty() || !felt_bodies(scene_.bodies).empty();
  if (has_tracked(scene_)) feel(true);
  rehearse();
  feel(false);
}

void Simulation::set_detection(const DetectSettings& settings) {
  scene_.detect = settings;
  detector_.set(settings);
  cavity_watch_.set(settings);
  planner_.set_bubble_speed(bubbling_speed(settings));
}

// OpenCL on CPUs compiles a kernel when it first runs. On a machine's first start that takes
// seconds, which nobody minds before time begins, and everybody in the midst of a splash.
void Simulation::rehearse() {
  std::vector<BodyStep> poses;
  const FrameSteps division = steps_of_frame(1.0 / scene_.serve.frame_rate, largest_step_);
  const std::vector<Step> steps = steps_of(division, poses);
  set_bodies(division, poses);
  fluid_.begin_watch(steps.size());
  if (pushes_) pushes_->begin(fluid_, std::vector<bool>(pushes_->bodies().size(), true));
  for (const Step& step : steps) {
    fluid_.prepare(step);
    if (&step == &steps.back()) detector_.rehearse(step);
    fluid_.accelerate(step);
    if (&step == &steps.back() && pushes_) pushes_->add(fluid_, step);
    fluid_.move(step);
  }
  if (pushes_) pushes_->enqueue_read(fluid_);
  static_cast<void>(fluid_.stats());
  if (!measured_.empty()) note_forces(division.dt);
  sound_.recall(fluid_.device(), state());
  fluid_.note_recalled();
  fluid_.forget_work();
}

std::vector<cl::Buffer> Simulation::state() const {
  std::vector<cl::Buffer> all = fluid_.state();
  const std::vector<cl::Buffer> detected = detector_.state();
  all.insert(all.end(), detected.begin(), detected.end());
  return all;
}

std::vector<Step> Simulation::steps_of(const FrameSteps& division,
                                       std::vector<BodyStep>& poses) const {
  std::vector<Step> steps;
  for (int k = 0; k < division.count; ++k) {
    const double time = seconds_ + k * division.dt;
    const PistonState piston = piston_at(scene_.wave_maker, time - begun_);
    steps.push_back(
        {division.dt, piston.offset, piston.speed, static_cast<int>(poses.size()), k == 0});
    const std::vector<BodyStep> now = bodies_.at(time);
    poses.insert(poses.end(), now.begin(), now.end());
  }
  return steps;
}

void Simulation::set_bodies(const FrameSteps& steps, const std::vector<BodyStep>& poses) {
  fluid_.set_bodies(poses);
  if (scene_.tank_motion.present) {
    // For the whole frame as in its middle.
    const double middle = seconds_ - begun_ + 0.5 * steps.count * steps.dt;
    fluid_.set_tank(tank_motion_.at(middle), scene_.tank_motion.pivot, turns(scene_.tank_motion),
                    steps.dt);
  }
  if (hung_.empty()) return;
  fluid_.free_bodies()->hang(fluid_.device(), hung_.anchors(seconds_, steps.count, steps.dt));
}

// Many scenes have bodies that could be grabbed, and few are ever felt: what that takes is made
// when somebody asks.
void Simulation::feel(bool on) {
  feels_ = on && can_feel_;
  if (feels_ && !pushes_ && !felt_bodies(scene_.bodies).empty()) {
    pushes_ = make_pushes(fluid_, scene_, measured_);
  }
  fluid_.feel((feels_ || !measured_.empty()) && pushes_ != nullptr);
}

void Simulation::measure_forces() {
  if (!fluid_.solver().has_pushes()) return;
  for (const GaugeSettings& probe : scene_.gauges.probes) {
    if (probe.kind == GaugeKind::body && !is_free(scene_.bodies[probe.body])) {
      measured_.insert(probe.body);
    }
  }
  if (measured_.empty()) return;
  pushes_ = make_pushes(fluid_, scene_, measured_);
  feel(feels_);
  rehearse();
}

void Simulation::note_forces(double seconds) {
  const std::vector<BodyPush> all = pushes_->pushes(seconds);
  for (std::size_t k = 0; k < measured_.size(); ++k) {  // they come first
    bodies_.note_force(static_cast<std::size_t>(all[k].body), {all[k].force, all[k].torque});
  }
}

bool Simulation::is_felt_now(int body) const {
  const PosedMotion* const motion = live_body(body);
  return motion != nullptr && (motion->is_tracked() || motion->is_held());
}

std::vector<bool> Simulation::felt_now() const {
  std::vector<bool> all;
  for (std::size_t b = 0; feels_ && b < live_.size(); ++b) {
    all.push_back(is_felt_now(static_cast<int>(b)));
  }
  return all;
}

bool Simulation::wants_rates(const std::vector<BodyStep>& poses, double step, double frame) {
  double fastest = std::max(stats_.speed, fastest_mover(seconds_));
  bool appears = false;
  for (const BodyStep& pose : poses) {
    fastest = std::max(fastest, static_cast<double>(pose.speed));
    appears = appears || pose.grows > 0.0F;
  }
  rated_way_ += frame * fastest;
  const double holds = kRatesHold * static_cast<double>(fluid_.params().spacing);
  // Not the other way round: what is no number is found anew.
  const bool still = !appears && rated_way_ <= holds && step == rated_step_;
  return !(still && sleeps_whole(scene_) && felt_of_ == felt_now());
}

std::vector<BodyPush> Simulation::find_pushes(double seconds) {
  std::vector<BodyPush> all;
  for (BodyPush push : pushes_ ? pushes_->pushes(seconds) : std::vector<BodyPush>{}) {
    if (!is_felt_now(push.body)) continue;
    const BodyState state = bodies_.state(static_cast<std::size_t>(push.body), seconds_);
    push.velocity = state.velocity;
    push.spin = state.spin;
    if (!rates_anew_) {  // of the same bodies as before
      push.by_speed = felt_[all.size()].by_speed;
      push.by_spin = felt_[all.size()].by_spin;
    }
    all.push_back(push);
  }
  if (hung_.empty()) return all;
  const std::vector<FreeBodyEnd> ends = fluid_.free_bodies()->ends();
  const std::vector<BodyPush> hung = hung_.pushes(ends, seconds_, seconds);
  all.insert(all.end(), hung.begin(), hung.end());
  return all;
}

FrameResult Simulation::advance() {
  bool any_live = false;
  for (std::size_t b = 0; b < live_.size(); ++b) {
    if (live_[b] == nullptr) continue;
    any_live = true;
    const BodyState before = bodies_.state(b, seconds_);
    live_[b]->begin({seconds_, origin_ + seconds_, 1.0 / scene_.serve.frame_rate});
    bodies_.note_jump(b, before, seconds_);
  }
  if (any_live) limit_step();
  std::optional<StepFault> step_fault;
  while (true) {
    const FrameSteps division =
        steps_of_frame(1.0 / scene_.serve.frame_rate, recovery_.step_share() * largest_step_);
    std::vector<BodyStep> poses;
    const std::vector<Step> steps = steps_of(division, poses);
    FramePlan plan =
        planner_.plan(poses, stats_, division.count * division.dt,
                      steps.front().piston_speed != 0.0 || bodies_.restless(seconds_) ||
                          hung_.move(seconds_, division.count * division.dt),
                      detector_.bubbles_alive());
    // A frame tells the forces on bodies that are felt anew; while water sleeps they stay.
    plan.steps = plan.steps || (feels_ && felt_of_ != felt_now());
    rates_anew_ = wants_rates(poses, division.dt, division.count * division.dt);
    if (!step_fault) count(plan);
    if (!plan.steps) return hold_still(division.count * division.dt);
    set_bodies(division, poses);
    if (auto result = attempt(steps, plan)) {
      result->step_fault = step_fault;
      totals_.retried += step_fault.has_value();
      return *result;
    }
    StepFault now = examine(*wrong_, division.dt);
    if (!step_fault) step_fault = now;
    step_fault->tries = recovery_.failed_tries() + 1;
    step_fault->remedy = recovery_.failed();
    if (step_fault->remedy != Remedy::retry)
      return give_up(*step_fault, division.count * division.dt);
  }
}

FrameResult Simulation::hold_still(double frame) {
  FrameResult still;
  if (stats_.asleep < particles()) {  // they begin to
    stats_.asleep = particles();
    fluid_.note_asleep();
  }
  seconds_ += frame;
  bodies_.hold(seconds_, true);
  detected_at_ = seconds_;
  still.seconds = seconds_;
  still.stats = stats_;
  if (feels_) still.pushes = felt_;  // as nothing has changed
  totals_.mean_excess_sum += stats_.mean_excess;
  return still;
}

void Simulation::enqueue(const std::vector<Step>& steps, const FramePlan& plan, double since) {
  fluid_.begin_watch(steps.size());
  const bool weighs = (feels_ || !measured_.empty()) && pushes_;
  if (weighs) {
    std::vector<bool> wanted;
    for (const FreeBody& body : pushes_->bodies()) {
      wanted.push_back(rates_anew_ && is_felt_now(body.body));
    }
    pushes_->begin(fluid_, wanted);
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    Step step = steps[k];
    if (hook_) hook_(fluid_, step, Moment::before);
    fluid_.prepare(step);
    if (k + 1 == steps.size()) detector_.enqueue(step, since, {plan.contacts, plan.bubbles});
    if (hook_) hook_(fluid_, step, Moment::between);
    fluid_.accelerate(step);
    if (weighs) pushes_->add(fluid_, step);
    fluid_.move(step);
    fluid_.device().queue().flush();  // else a driver may begin with nothing before the end
  }
  fluid_.enqueue_stats();
  detector_.enqueue_read();
  if (weighs) pushes_->enqueue_read(fluid_);
  fluid_.device().queue().finish();
}

std::optional<Diagnosis> Simulation::diagnosis(std::size_t steps) {
  if (const auto found = fluid_.health().diagnosis()) return found;
  return look_at_free_bodies(fluid_, static_cast<int>(steps) - 1);
}

std::optional<FrameResult> Simulation::attempt(const std::vector<Step>& steps,
                                               const FramePlan& plan) {
  const double dt = steps.front().dt;
  const auto step_count = static_cast<int>(steps.size());
  const double detect_time = seconds_ + (step_count - 1) * dt;
  const double since = detect_time - detected_at_;
  const double mover = fastest_mover(seconds_);
  if (mover > kThrows * static_cast<double>(fluid_.params().sound_speed)) {
    thrown_until_ = seconds_ + kFlight;
  }
  // Upwards nothing ends a fall: the tank is open.
  const bool falls_out = scene_.fluid.gravity[2] > 0.0;
  fluid_.health().expect_speed(falls_out || seconds_ < thrown_until_);
  enqueue(steps, plan, since);
  wrong_ = diagnosis(steps.size());
  if (wrong_) return std::nullopt;
  seconds_ += step_count * dt;
  bring_free_bodies(fluid_, bodies_, seconds_);
  totals_.steps += step_count;
  FrameResult result;
  result.seconds = seconds_;
  result.found = collect(detect_time, since);
  result.stats = fluid_.stats_result();
  if (!measured_.empty()) note_forces(step_count * dt);
  if (feels_) {
    result.pushes = felt_ = find_pushes(step_count * dt);
    ++totals_.felt;
    if (rates_anew_) {
      rated_way_ = 0.0;
      rated_step_ = dt;
    }
  }
  felt_of_ = felt_now();
  detected_at_ = detect_time;
  keep(result);
  return result;
}

Detections Simulation::collect(double detect_time, double since) {
  Detections found =
      detector_.collect(detect_time, since, static_cast<std::uint32_t>(totals_.steps));
  if (!scene_.detect.cavity_by_count) {
    found.cavities = cavity_watch_.observe(seconds_, found.impacts, bodies_,
                                           [&] { return read_places(fluid_); });
  }
  return found;
}

void Simulation::count(const FramePlan& plan) {
  ++totals_.frames;
  SkipTotals& skipped = totals_.skipped;
  skipped.idle += !plan.steps;
  skipped.contacts += !plan.steps || !plan.contacts;
  skipped.bubbles += !plan.steps || !plan.bubbles;
  skipped.cavities = static_cast<std::uint64_t>(totals_.frames) - detector_.cavity_searches() -
                     cavity_watch_.looks();
  skipped.asleep_sum += static_cast<double>(stats_.asleep) / fluid_.params().count;
}

void Simulation::keep(const FrameResult& result) {
  fluid_.health().accept();
  sound_.keep(fluid_.device(), state());
  recovery_.succeeded();
  stats_ = result.stats;
  totals_.bubbles_dropped = detector_.bubbles_dropped();
  totals_.bubbles_alive = detector_.bubbles_alive();
  totals_.bubbles_alive_most = std::max(totals_.bubbles_alive_most, totals_.bubbles_alive);
  totals_.bubbles_alive_sum += static_cast<double>(totals_.bubbles_alive);
  totals_.air = detector_.air();
  totals_.no_cavity = cavity_watch_.none();
  totals_.mean_excess_sum += stats_.mean_excess;
  totals_.max_excess = std::max(totals_.max_excess, stats_.max_excess);
  const double fastest = std::max(stats_.speed, fastest_mover(seconds_));
  set_largest_step(fastest, stats_.acceleration);
}

double Simulation::fastest_mover(double seconds) const {
  return std::max(bodies_.fastest(seconds),
                  std::abs(piston_at(scene_.wave_maker, seconds - begun_).speed));
}

void Simulation::set_largest_step(double fastest, double acceleration) {
  largest_step_ =
      std::min(largest_time_step(fluid_.params(), fastest, acceleration, step_policy_.factor()),
               contact_step_);
}

// How fast a tracker moves its body in a frame is known only when the frame begins.
void Simulation::limit_step() {
  const double before = largest_step_;
  set_largest_step(std::max(stats_.speed, fastest_mover(seconds_)), stats_.acceleration);
  largest_step_ = std::min(largest_step_, before);
}

StepFault Simulation::examine(const Diagnosis& what, double dt) {
  sound_.recall(fluid_.device(), state());
  fluid_.note_recalled();
  planner_.forget();
  StepFault step_fault;
  step_fault.what = what;
  step_fault.step = totals_.steps + what.step;
  step_fault.seconds = seconds_ + what.step * dt;
  locate(step_fault, fluid_, bodies_, scene_, seconds_);
  return step_fault;
}

void Simulation::restore_start(double seconds) {
  felt_of_.clear();
  fluid_.restore(start_);
  bodies_.reset(seconds);
  cavity_watch_.forget();
}

void Simulation::restart() {
  for (PosedMotion* body : live_) {
    if (body != nullptr) body->restart(seconds_);
  }
  begun_ = seconds_;
  restore_start(seconds_);
  detector_.forget();
  planner_.forget();
  sound_.keep(fluid_.device(), state());
}

FrameResult Simulation::give_up(StepFault& step_fault, double frame) {
  if (step_fault.remedy == Remedy::reset) {
    restore_start(seconds_ + frame);
    ++totals_.resets;
  } else {
    calm(step_fault, fluid_, bodies_, recovery_.given_up(), seconds_);
    ++totals_.calmed;
  }
  sound_.keep(fluid_.device(), state());
  seconds_ += frame;
  bodies_.hold(seconds_, false);
  FrameResult result;
  result.seconds = seconds_;
  result.stats = stats_;
  result.step_fault = step_fault;
  return result;
}

PosedMotion* Simulation::live_body(int body) const noexcept {
  const bool known = body >= 0 && static_cast<std::size_t>(body) < live_.size();
  return known ? live_[static_cast<std::size_t>(body)] : nullptr;
}

}  // namespace splash::sim
