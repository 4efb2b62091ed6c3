// SPDX-License-Identifier: MIT
#include "sim-server/serve/server.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>

#include "program/config_file.hpp"
#include "program/failure.hpp"
#include "program/files.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/solver_choice.hpp"

namespace splash::sim {
namespace {

constexpr double kLinePeriod = 2.0;   ///< between two lines on the state [s]
constexpr double kFaultPeriod = 1.0;  ///< between two lines on what went wrong [s]
constexpr double kSlipLimit = 0.100;  ///< time slips when behind by more, while frames keep up [s]
constexpr double kLeanGauges = 1.0;   ///< between two readings of the gauges under load [s]
constexpr auto kPauseStep = std::chrono::milliseconds(20);
constexpr double kAnswerTimeout = 0.2;  ///< targets that say nothing for this long are silent [s]

/// A file or a folder of files that the run writes; none where no path names it.
template <class Written, class... More>
std::optional<Written> opened(const std::filesystem::path& path, const More&... more) {
  if (path.empty()) return std::nullopt;
  return std::optional<Written>(std::in_place, path, more...);
}

void print_line(const std::string& line) {
  std::fprintf(stderr, "%s\n", line.c_str());
}

std::vector<ShownBody> shown_bodies(const Simulation& simulation, double seconds) {
  std::vector<ShownBody> shown;
  for (std::size_t b = 0; b < simulation.bodies().count(); ++b) {
    std::uint32_t flags = 0;
    if (simulation.bodies().is_free(b)) flags |= kBodyFree;
    if (const PosedMotion* posed = simulation.live_body(static_cast<int>(b))) {
      if (posed->is_tracked()) flags |= kBodyTracked;
      if (posed->is_held()) flags |= kBodyGrabbed;
    }
    shown.push_back({simulation.bodies().state(b, seconds), flags});
  }
  return shown;
}

/// Why nobody can feel the water of this scene; empty: one can.
std::string no_forces(const Simulation& simulation) {
  return simulation.can_feel() ? "" : "poses move no body of this scene";
}

int next(int& id) {
  const int now = id;
  id = (id + 1) % protocol::kCounterWrap;
  return now;
}

/// Turns detections into events of the wire: assigns ids, the nearest body and the moment to sound.
/// Impacts sound when the surfaces meet; bubbles and cavities sound `latency` seconds after they
/// happened, which hides the time that their detection takes.
std::vector<TimedEvent> number_events(const Detections& found, const Simulation& simulation,
                                      double latency, EventIds& ids) {
  std::vector<TimedEvent> events;
  found.each([&](const auto& all) {
    for (const auto& detected : all) {
      constexpr bool kIsForeseen = std::remove_cvref_t<decltype(detected)>::kIsForeseen;
      auto event = detected.event();
      event.id = next(ids.of<decltype(event)>());
      if (event.body < 0) event.body = simulation.nearest_body(detected.position);
      events.push_back({event, detected.time + (kIsForeseen ? 0.0 : latency)});
    }
  });
  return events;
}

}  // namespace

Server::Server(const Options& options, Simulation& simulation, const std::string& device)
    : options_(options),
      simulation_(simulation),
      device_(device),
      targets_(options.targets),
      socket_(sending_endpoint(options.targets, options.listen)),
      log_(opened<protocol::LogWriter>(options.record)),
      gauges_(opened<GaugeFile>(options.gauges, simulation.scene())),
      vtk_(opened<VtkFiles>(options.vtk)),
      sender_(
          targets_, socket_, log_ ? &*log_ : nullptr,
          {.seed = simulation.scene().seed, .lead = 1e-3 * simulation.scene().serve.latency_ms}),
      forces_(targets_, socket_, sender_.session()),
      pacer_({.real_time = options.real_time, .slip_limit = kSlipLimit}),
      overload_({.has_gauges = gauges_.has_value(),
                 .largest_stretch = simulation_.step_policy().largest_stretch()}),
      target_status_(options.targets, protocol::monotonic_now,
                     [](const std::string& line) { print_line("sim-server: " + line); }),
      rows_(simulation.scene().detect),
      poses_(simulation,
             [this](const std::string& reason) {
               targets_.tell(socket_, protocol::encode(protocol::fail("/body/pose", reason)));
             }),
      line_pace_(kLinePeriod),
      clock_answers_(socket_, targets_, print_line),
      control_({.listen = options_.listen, .allowed = options_.allow}, actions(), targets_) {
  if (const std::string reason = no_forces(simulation); options_.record_forces && !reason.empty()) {
    throw program::Failure(program::kExitUsage, "--record-forces: " + reason);
  }
  if (gauges_) simulation_.measure_forces();
  if (!options_.show) return;
  show_.emplace(protocol::FrameStreamSettings{.listen = *options_.show, .allowed = options_.allow},
                simulation_.scene(), simulation_.fluid(), [this] { return rows_.rows(); });
}

ControlActions Server::actions() {
  return {.pose = [this](const protocol::BodyPose& pose,
                         const PoseMoment& moment) { poses_.take(pose, moment); },
          .track = [this](const protocol::Message& message,
                          const PoseMoment& moment) { return poses_.track(message, moment); },
          .grab = [this](int body, bool on,
                         const protocol::Endpoint& from) { return poses_.grab(body, on, from); },
          .pause = [this](bool on) { paused_ = on; },
          .reset = [this] { restarts_ = true; },
          .set = [this](const std::string& name, double value) { return rows_.set(name, value); },
          .get = [this](const std::string& name) { return rows_.get(name); },
          .scene = [this](const std::string& name) { return go_over_to(name); },
          .no_forces = [this] { return no_forces(simulation_); },
          .status =
              [this] {
                const std::lock_guard lock(status_mutex_);
                status_.refused = poses_.refused();
                return status_;
              },
          .quit = [this] { quit_ = true; },
          .print = print_line};
}

// What a run writes, and its length, belong to one scene.
std::string Server::go_over_to(const std::string& scene) {
  const bool writes =
      !(options_.record.empty() && options_.report.empty() && options_.gauges.empty() &&
        options_.vtk.empty() && options_.settled.empty());
  if (writes) return "this run writes a file: it keeps its scene";
  if (!options_.tracker.empty()) return "this run has --tracker: it keeps its scene";
  if (options_.duration > 0.0) return "this run has --duration: it keeps its scene";
  const auto file = program::named_config("scenes", scene);
  if (!file) return "no scene is called so";
  static_cast<void>(read_scene(*file));
  {
    const std::lock_guard lock(status_mutex_);
    next_scene_ = *file;
  }
  quit_ = true;
  return {};
}

std::filesystem::path Server::next_scene() const {
  const std::lock_guard lock(status_mutex_);
  return next_scene_;
}

bool Server::is_over() const {
  return quit_ || (options_.duration > 0.0 && simulation_.seconds() >= options_.duration - 1e-9);
}

void Server::run(const std::function<bool()>& ended) {
  target_status_.begin(kAnswerTimeout);
  pacer_.start(simulation_.seconds());
  const Stopwatch stopwatch;
  started_ = protocol::monotonic_now();
  next_line_ = started_ + kLinePeriod;
  note_gauges();
  note_vtk();
  while (!ended() && !is_over()) {
    if (restarts_.exchange(false)) simulation_.restart();
    take_rows();
    if (paused_) {
      pause_step();
      continue;
    }
    const double before = simulation_.seconds();
    const double begin = protocol::monotonic_now();
    simulation_.set_origin(pacer_.origin());
    simulation_.feel(targets_.wants(kForceStream) || options_.record_forces);
    const FrameResult frame = simulation_.advance();
    const double computed = protocol::monotonic_now();
    send_forces(frame);
    pacer_.wait_until(frame.seconds);
    const double due = protocol::monotonic_now();
    send(frame);
    show(frame);
    note_gauges();
    note_vtk();
    note_status(frame);
    target_status_.poll();
    const double end = protocol::monotonic_now();
    if (!options_.quiet && end >= next_line_) print_progress();
    note_load(frame.seconds - before, computed - begin + end - due);
  }
  run_cost_ = stopwatch.passed();
}

void Server::take_rows() {
  const auto change = rows_.take();
  if (!change) return;
  simulation_.set_detection(change->detect);
  for (const LiveRow& row : change->rows) {
    targets_.tell(socket_, protocol::encode(protocol::value_of(row.name, row.value)));
  }
}

void Server::pause_step() {
  FrameResult still;
  still.seconds = simulation_.seconds();
  std::this_thread::sleep_for(kPauseStep);
  pacer_.start(still.seconds);  // simulated time is now, however long that goes on
  send(still);
  show(still);
  pace_.note(protocol::monotonic_now(), still.seconds, simulation_.totals().steps);
  const std::uint64_t unsent_now = unsent();
  {
    const std::lock_guard lock(status_mutex_);
    status_.unsent = unsent_now;
    status_.real_time_factor = static_cast<float>(pace_.real_time_factor());
    status_.steps_per_second = static_cast<float>(pace_.steps_per_second());
  }
  target_status_.poll();
}

void Server::note_load(double seconds, double spent) {
  if (!options_.real_time || !overload_.note(seconds, spent)) return;
  const Load level = overload_.level();
  simulation_.step_policy().set_stretch(overload_.stretch());
  // Under a lasting load the backlog is given up frame by frame: what is told is told at once.
  const double frame = 1.0 / simulation_.scene().serve.frame_rate;
  pacer_.set_slip_limit(level == Load::slow ? frame : kSlipLimit);
  std::fprintf(stderr, "sim-server: %s\n",
               describe(overload_, simulation_.step_policy().scene_may_ask_for_more()).c_str());
}

void Server::report(const StepFault& step_fault) {
  const double now = protocol::monotonic_now();
  if (now < next_fault_) {
    ++unreported_;
    return;
  }
  next_fault_ = now + kFaultPeriod;
  std::fprintf(stderr, "sim-server: %s\n", describe(step_fault).c_str());
  if (unreported_ > 0) std::fprintf(stderr, "sim-server: and %d more before that\n", unreported_);
  unreported_ = 0;
}

void Server::send(const FrameResult& frame) {
  if (frame.step_fault) report(*frame.step_fault);
  const FrameTime time = {simulation_.totals().steps, frame.seconds, pacer_.unix_origin()};
  const double latency = 1e-3 * simulation_.scene().serve.latency_ms;
  auto events = number_events(frame.found, simulation_, latency, ids_);
  keep_going([&] { sender_.send_step(time, std::move(events)); },
             [this] { sender_.stop_logging(); });
}

/// Sent and logged at once: a control loop that is closed over the forces wants no delay.
void Server::send_forces(const FrameResult& frame) {
  if (frame.pushes.empty()) return;
  std::vector<ForceReading> readings;
  for (const BodyPush& push : frame.pushes) {
    const BodyState state =
        simulation_.bodies().state(static_cast<std::size_t>(push.body), frame.seconds);
    const Quaternion& q = state.rotation;
    const BodySettings& body = simulation_.scene().bodies[static_cast<std::size_t>(push.body)];
    const Vector3 x = state.position - rotate(q, body.centre);
    const auto six = [](const Vector3& a, const Vector3& b) {
      return std::array<double, 6>{a[0], a[1], a[2], b[0], b[1], b[2]};
    };
    readings.push_back({.body = push.body,
                        .at = {x[0], x[1], x[2], q[0], q[1], q[2], q[3]},
                        .twist = six(push.velocity, push.spin),
                        .force = six(push.force, push.torque),
                        .rate = six(push.by_speed, push.by_spin)});
  }
  const auto bundles = force_bundles(readings);
  const FrameTime time = {simulation_.totals().steps, frame.seconds, pacer_.unix_origin()};
  forces_.send(time.step, time.unix_origin + time.seconds, bundles);
  if (!options_.record_forces) return;
  keep_going(
      [&] {
        for (const auto& messages : bundles) sender_.log_forces(time, messages);
      },
      [this] { sender_.stop_logging(); });
}

void Server::show(const FrameResult& frame) {
  if (!show_) return;
  show_->frame(protocol::monotonic_now(), frame.seconds, simulation_.fluid(), [&] {
    const double latency = 1e-3 * simulation_.scene().serve.latency_ms;
    return ShownState{.moment = pacer_.unix_origin() + frame.seconds + latency,
                      .seconds = frame.seconds,
                      .steps = simulation_.totals().steps,
                      .bodies = shown_bodies(simulation_, frame.seconds),
                      .bubbles = simulation_.bubble_places()};
  });
}

void Server::keep_going(const std::function<void()>& write, const std::function<void()>& forget) {
  try {
    write();
  } catch (const program::WriteError& error) {
    if (!options_.real_time) throw;
    forget();
    unwritten_ = error.what();
    std::fprintf(stderr, "sim-server: %s. The run goes on without it\n", error.what());
  }
}

bool Server::listens() {
  const std::uint64_t turns = control_.turns();
  return std::exchange(turns_seen_, turns) != turns;
}

void Server::reopen() {
  const auto moved = [](const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return true;
    std::fprintf(stderr, "sim-server: %s is still there: move it away, then send SIGHUP\n",
                 path.c_str());
    return false;
  };
  const auto began = [](const std::filesystem::path& path) {
    std::printf("began %s anew\n", path.c_str());
    std::fflush(stdout);
  };
  if (log_ && moved(options_.record)) {
    keep_going(
        [&] {
          sender_.close(simulation_.seconds());
          log_.emplace(options_.record, simulation_.seconds());
          began(options_.record);
        },
        [this] { sender_.stop_logging(); });
  }
  if (gauges_ && moved(options_.gauges)) {
    keep_going(
        [&] {
          gauges_->reopen();
          began(options_.gauges);
        },
        [this] { gauges_.reset(); });
  }
}

void Server::note_status(const FrameResult& frame) {
  const RunTotals& totals = simulation_.totals();
  const SkipTotals& skipped = totals.skipped;
  const double now = protocol::monotonic_now();
  pace_.note(now, frame.seconds, totals.steps);
  line_pace_.note(now, frame.seconds, totals.steps);
  const std::uint64_t unsent_now = unsent();
  const std::lock_guard lock(status_mutex_);
  status_.particles = static_cast<std::uint64_t>(simulation_.particles());
  status_.steps = static_cast<std::uint64_t>(totals.steps);
  status_.events = sender_.counts().events;
  status_.late = pacer_.counts().behind;
  status_.unsent = unsent_now;
  status_.resets = totals.retried + totals.calmed + totals.resets;
  status_.skipped = skipped.idle + skipped.contacts + skipped.bubbles + skipped.cavities;
  status_.real_time_factor = static_cast<float>(pace_.real_time_factor());
  status_.steps_per_second = static_cast<float>(pace_.steps_per_second());
  status_.density_error = static_cast<float>(frame.stats.mean_excess);
  status_.bubble_particles = totals.bubbles_alive;
  status_.thinned = totals.air.thinned;
}

std::uint64_t Server::unsent() const {
  std::uint64_t sum = 0;
  for (const Target& target : targets_.list()) sum += target.failed;
  return sum;
}

void Server::note_gauges() {
  if (!gauges_ || simulation_.seconds() < next_gauges_) return;
  next_gauges_ = overload_.level() == Load::easy ? 0.0 : simulation_.seconds() + kLeanGauges;
  keep_going(
      [this] { gauges_->note(simulation_.seconds(), simulation_.fluid(), simulation_.bodies()); },
      [this] { gauges_.reset(); });
}

void Server::note_vtk() {
  if (!vtk_) return;
  keep_going([this] { vtk_->note(simulation_.seconds(), simulation_.fluid()); },
             [this] { vtk_.reset(); });
}

void Server::print_progress() {
  const double now = protocol::monotonic_now();
  next_line_ = now + kLinePeriod;
  std::printf("%7.1f s  %6.0f steps/s  real time x %.2f", simulation_.seconds(),
              line_pace_.steps_per_second(), line_pace_.real_time_factor());
  sender_.counts().events.each([](const char* kind, std::uint64_t count) {
    std::printf("  %s %llu", kind, static_cast<unsigned long long>(count));
  });
  std::printf("\n");
  std::fflush(stdout);
}

RunReport Server::finish() {
  sender_.leave();
  keep_going([this] { sender_.close(simulation_.seconds()); }, [this] { sender_.stop_logging(); });
  target_status_.finish(kAnswerTimeout);
  const Scene& scene = simulation_.scene();
  RunReport report;
  report.device = device_;
  report.scene = scene.name;
  report.solver = name_of(scene.fluid.solver);
  report.solver_notice = solver_notice(scene);
  report.particles = simulation_.particles();
  report.simulated_seconds = simulation_.seconds();
  report.run = run_cost_;
  report.totals = simulation_.totals();
  report.solve = simulation_.solver_work();
  report.sent = sender_.counts();
  report.paced = pacer_.counts();
  report.lean_seconds = overload_.spent_at(Load::lean);
  report.coarse_seconds = overload_.spent_at(Load::coarse);
  report.slow_seconds = overload_.spent_at(Load::slow);
  report.send_failures = unsent();
  report.late = target_status_.late();
  report.lost = target_status_.lost();
  report.shown = show_ ? show_->shown() : 0;
  const ControlCounts wire = control_.counts();
  report.refused_poses = poses_.refusals(wire);
  report.refused_messages = wire.out_of_table - wire.malformed_poses;
  for (std::size_t i = 1; i < wire.refused.size(); ++i) {
    const auto reason = static_cast<protocol::Refusal>(i);
    if (wire.refused[i] == 0) continue;
    report.refused_datagrams.emplace_back(protocol::describe(reason), wire.refused[i]);
  }
  return report;
}

void Server::leave(const RunReport& report) const {
  if (!options_.report.empty()) {
    write_report(options_.report, report);
  }
  if (!unwritten_.empty()) throw program::Failure(program::kExitIo, unwritten_);
}

}  // namespace splash::sim
