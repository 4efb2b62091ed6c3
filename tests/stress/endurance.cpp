// SPDX-License-Identifier: MIT
#include "tests/stress/endurance.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "protocol/time_tag.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/bench/tables.hpp"
#include "tests/support/detections.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::stress {
namespace {

constexpr double kLinePeriod = 10.0;  ///< between two lines of progress [s]
constexpr double kKeepPeriod = 60.0;  ///< between two pieces that are kept [s]
constexpr double kGrowth = 1.0;       ///< of memory that is allowed per hour [MiB/h]
constexpr double kPages = 0.5;        ///< and whatever the time: the allocator's grain [MiB]
constexpr double kWarm = 30.0;        ///< after which memory is compared, or a tenth [s]

/// Resident memory [MiB].
double resident() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t size = 0;
  std::int64_t pages = 0;
  statm >> size >> pages;
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

int descriptors() {
  const auto all = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<int>(std::distance(begin(all), end(all)));
}

std::string variant_of(const Endurance& wanted) {
  return sim::name_of(wanted.solver) + "-" +
         std::to_string(static_cast<int>(100.0 * wanted.coarser + 0.5));
}

int lost_of(const sim::Snapshot& water, int particles) {
  std::vector<int> ids = water.id;
  std::sort(ids.begin(), ids.end());
  const auto last = std::unique(ids.begin(), ids.end());
  return particles - static_cast<int>(last - ids.begin());
}

/// One scene in the course of this call.
class Run {
 public:
  Run(sim::Device& device, const std::string& name, const Endurance& wanted,
      std::filesystem::path file)
      : name_(name),
        wanted_(wanted.steps),
        file_(std::move(file)),
        simulation_(device, built_in_scene(name, wanted), {}) {
    if (read_piece(file_, before_)) simulation_.resume(before_.water, before_.simulated);
  }

  /// Until all steps are taken or it is `end` o'clock.
  const Piece& go_on(double end) {
    start_ = line_ = kept_ = protocol::monotonic_now();
    const std::int64_t tenth = (wanted_ - before_.steps) / 10;
    while (before_.steps + simulation_.totals().steps < wanted_) {
      const sim::FrameResult frame = simulation_.advance();
      events_ += static_cast<std::int64_t>(tests::count_of(frame.found));
      const double now = protocol::monotonic_now();
      if (warm_ == 0.0 && (now > start_ + kWarm || simulation_.totals().steps > tenth)) {
        warm_ = now;
        memory_ = resident();
        files_ = descriptors();
      }
      if (frame.step_fault) std::printf("\n%s\n", describe(*frame.step_fault).c_str());
      if (now > line_) tell(now);
      if (now > kept_) keep(now);
      if (end > 0.0 && now > end) break;
    }
    keep(protocol::monotonic_now());
    return now_;
  }
  [[nodiscard]] int particles() const { return simulation_.particles(); }

 private:
  void tell(double now) {
    line_ = now + kLinePeriod;
    std::printf("\r%-8s %9lld of %lld steps  %.1f MiB", name_.c_str(),
                static_cast<long long>(before_.steps + simulation_.totals().steps),
                static_cast<long long>(wanted_), resident());
    std::fflush(stdout);
  }

  void keep(double now) {
    kept_ = now + kKeepPeriod;
    const sim::RunTotals& totals = simulation_.totals();
    now_ = before_;
    now_.steps += totals.steps;
    now_.simulated = simulation_.seconds();
    now_.wall += now - start_;
    now_.again += static_cast<std::int64_t>(totals.retried);
    now_.given_up += static_cast<std::int64_t>(totals.calmed);
    now_.resets += static_cast<std::int64_t>(totals.resets);
    now_.events += events_;
    if (warm_ > 0.0) {
      now_.growth = std::max(before_.growth, resident() - memory_);
      now_.hours = std::max(before_.hours, (now - warm_) / 3600.0);
      now_.opened = std::max<std::int64_t>(before_.opened, descriptors() - files_);
    }
    now_.water = simulation_.fluid().snapshot();
    now_.lost = lost_of(now_.water, simulation_.particles());
    write_piece(file_, now_);
  }

  std::string name_;
  std::int64_t wanted_;
  std::filesystem::path file_;
  sim::Simulation simulation_;
  Piece before_;
  Piece now_;
  std::int64_t events_ = 0;
  double start_ = 0.0;
  double line_ = 0.0;
  double kept_ = 0.0;
  double warm_ = 0.0;
  double memory_ = 0.0;
  int files_ = 0;
};

bool sound(const Piece& p) {
  return p.again + p.given_up + p.resets == 0 && p.lost == 0 && p.opened <= 0 &&
         p.growth <= kPages + kGrowth * p.hours;
}

}  // namespace

std::vector<std::string> built_in_scenes() {
  return tests::scene_names();
}

sim::Scene built_in_scene(const std::string& name, const Endurance& wanted) {
  sim::Scene scene = sim::read_scene(tests::scene_file(name));
  scene.fluid.spacing = wanted.coarser * sim::particle_spacing(scene);
  scene.fluid.particles = 0;
  scene.fluid.solver = wanted.solver;
  scene.skip.idle = false;  // or no step would be computed while all sleeps
  for (sim::BodySettings& body : scene.bodies) {
    const sim::MotionKind kind = body.motion.kind;
    // A walk ends elsewhere than it begins.
    body.motion.repeat = kind == sim::MotionKind::script || kind == sim::MotionKind::csv;
    if (kind == sim::MotionKind::trc && body.motion.file.empty()) {
      body.motion.file = tests::scene_folder() / "walk.trc";
    }
  }
  return scene;
}

int endure(sim::Device& device, const Endurance& wanted, const std::filesystem::path& out) {
  const std::filesystem::path folder = out / "endurance";
  std::filesystem::create_directories(folder);
  const std::string variant = variant_of(wanted);
  bench::Table table({"scene", "particles", "steps", "simulated [s]", "wall [s]", "events", "again",
                      "given up", "resets", "lost", "memory [MiB]", "files opened", "verdict"},
                     out / ("endurance-" + variant + ".csv"));
  const double end = wanted.minutes > 0.0 ? protocol::monotonic_now() + 60.0 * wanted.minutes : 0.0;
  int failed = 0;
  for (const std::string& name : wanted.scenes.empty() ? built_in_scenes() : wanted.scenes) {
    Run run(device, name, wanted, folder / (name + "-" + variant));
    const Piece& p = run.go_on(end);
    failed += !sound(p);
    const char* const so_far = p.steps >= wanted.steps ? "passed" : "sound so far";
    std::printf("\r");
    table.add({name, std::to_string(run.particles()), std::to_string(p.steps),
               bench::number(p.simulated), bench::number(p.wall), std::to_string(p.events),
               std::to_string(p.again), std::to_string(p.given_up), std::to_string(p.resets),
               std::to_string(p.lost), bench::number(p.growth), std::to_string(p.opened),
               sound(p) ? so_far : "FAILED"});
  }
  return failed;
}

namespace {

template <class Stream, class P>
void numbers(Stream&& each, P& p) {
  each(p.steps);
  each(p.simulated);
  each(p.wall);
  each(p.growth);
  each(p.hours);
  each(p.opened);
  each(p.lost);
  each(p.again);
  each(p.given_up);
  each(p.resets);
  each(p.events);
}

template <class T>
void write_array(std::ofstream& out, const std::vector<T>& array) {
  const std::uint64_t size = array.size();
  out.write(reinterpret_cast<const char*>(&size), sizeof size);
  out.write(reinterpret_cast<const char*>(array.data()),
            static_cast<std::streamsize>(size * sizeof(T)));
}

template <class T>
void read_array(std::ifstream& in, std::vector<T>& array) {
  std::uint64_t size = 0;
  in.read(reinterpret_cast<char*>(&size), sizeof size);
  if (!in || size > 1U << 30U) throw std::runtime_error("a kept piece is cut short");
  array.resize(size);
  in.read(reinterpret_cast<char*>(array.data()), static_cast<std::streamsize>(size * sizeof(T)));
}

}  // namespace

bool read_piece(const std::filesystem::path& file, Piece& piece) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return false;
  numbers([&](auto& value) { in.read(reinterpret_cast<char*>(&value), sizeof value); }, piece);
  read_array(in, piece.water.position);
  read_array(in, piece.water.velocity);
  read_array(in, piece.water.id);
  read_array(in, piece.water.peak_density);
  if (!in) throw std::runtime_error(file.string() + " is cut short: delete it to begin anew");
  return true;
}

void write_piece(const std::filesystem::path& file, const Piece& piece) {
  const std::filesystem::path part = file.string() + ".part";
  std::ofstream out(part, std::ios::binary);
  numbers(
      [&](const auto& value) { out.write(reinterpret_cast<const char*>(&value), sizeof value); },
      piece);
  write_array(out, piece.water.position);
  write_array(out, piece.water.velocity);
  write_array(out, piece.water.id);
  write_array(out, piece.water.peak_density);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + part.string());
  std::filesystem::rename(part, file);
}

}  // namespace splash::stress
