// SPDX-License-Identifier: MIT
#include "tests/detection/run.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/detection/run_water.hpp"
#include "tests/detection/steps.hpp"
#include "tests/support/detections.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::detection {
namespace {

/// The surface of the particles is known to some tenths of this: skin that is farther from it is
/// out of the water [spacings].
constexpr double kOut = 0.5;

/// Where a free body was at the end of each frame; between them on straight lines.
struct Trace {
  std::vector<double> times;
  std::vector<sim::BodyState> states;

  [[nodiscard]] sim::BodyState at(double time) const {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return states.front();
    if (after == times.end()) return states.back();
    const auto k = static_cast<std::size_t>(after - times.begin());
    const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
    sim::BodyState state = states[share < 0.5 ? k - 1 : k];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      state.position[axis] =
          std::lerp(states[k - 1].position[axis], states[k].position[axis], share);
      state.velocity[axis] =
          std::lerp(states[k - 1].velocity[axis], states[k].velocity[axis], share);
    }
    return state;
  }
};

/// The paths of all bodies: those that the water moves as traces.
struct Paths {
  std::vector<std::shared_ptr<const sim::Motion>> motions;
  std::vector<std::shared_ptr<Trace>> traces;  ///< of free bodies, else null

  Paths(const sim::Scene& scene, const std::filesystem::path& tracker) {
    for (const sim::BodySettings& body : scene.bodies) {
      const bool free = sim::is_free(body);
      motions.push_back(free ? nullptr : sim::make_motion(body, tracker));
      traces.push_back(free ? std::make_shared<Trace>() : nullptr);
    }
  }
  void note(const sim::Simulation& simulation) const {
    for (std::size_t b = 0; b < traces.size(); ++b) {
      if (!traces[b]) continue;
      traces[b]->times.push_back(simulation.seconds());
      traces[b]->states.push_back(simulation.bodies().state(b, simulation.seconds()));
    }
  }
  [[nodiscard]] std::vector<Path> all() const {
    std::vector<Path> paths;
    for (std::size_t b = 0; b < motions.size(); ++b) {
      if (traces[b]) {
        paths.emplace_back([trace = traces[b]](double time) { return trace->at(time); });
      } else {
        paths.emplace_back([motion = motions[b]](double time) { return motion->at(time); });
      }
    }
    return paths;
  }
};

/// Contacts that force plates saw; the first, at 0 s, is of a foot that stands already.
std::vector<Entry> contacts_of(const std::filesystem::path& file, const sim::Scene& scene) {
  std::ifstream in(file);
  std::vector<Entry> entries;
  for (std::string line; std::getline(in, line);) {
    std::istringstream row(line);
    std::string foot;
    std::getline(row, foot, ',');
    Entry entry;
    entry.down = std::numeric_limits<double>::quiet_NaN();
    entry.wanted = true;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].name == "foot_" + foot) entry.body = b;
    }
    if (!(row >> entry.time) || entry.time <= 0.0) continue;
    entry.until = entry.time;
    entries.push_back(entry);
  }
  if (entries.empty()) throw std::runtime_error("no contacts in " + file.string());
  return entries;
}

Limits limits_of(const sim::Scene& scene) {
  Limits limits;
  limits.impact_speed = scene.detect.impact_speed;
  return limits;
}

/// The feet of a run, against the water that it has.
struct Feet {
  std::vector<Steps> steps;   ///< of skin that has surely left the water
  std::vector<Steps> slight;  ///< of skin that may have
  std::vector<Path> paths;
  double reach = 0.0;  ///< of a blow of the largest of them [m]

  Feet(const Case& item, const sim::Scene& scene, const Paths& known) : paths(known.all()) {
    if (!item.feet) return;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const sim::Shape& shape = scene.bodies[b].shape;
      steps.emplace_back(b, shape, limits_of(scene));
      slight.emplace_back(b, shape, limits_of(scene));
      const auto skin = sim::sample_skin(shape, 0, 0.01);
      reach = std::max(reach, sim::reach_of_blow(sim::faces_of(skin, 1).front()));
    }
  }
  void look(sim::Simulation& simulation) {
    if (steps.empty()) return;
    const RunWater there(simulation, reach);
    const auto spacing = static_cast<double>(simulation.fluid().params().spacing);
    const double release = simulation.scene().detect.impact_release;
    const Water sure = there.water(std::max(kOut * spacing, release));
    const Water unsure = there.water(release);
    const double time = simulation.seconds();
    for (std::size_t b = 0; b < steps.size(); ++b) {
      steps[b].look(time, paths[b](time), sure);
      slight[b].look(time, paths[b](time), unsure);
    }
  }
  [[nodiscard]] std::vector<Entry> entries(std::size_t body) const {
    return with_slight(steps[body].all(), slight[body].all());
  }
};

/// `feet`: what is known of them; without, they are held against still water.
std::vector<Entry> truth_of(const Case& item, const sim::Scene& scene,
                            const std::vector<Path>& paths, double level,
                            const Feet* feet = nullptr) {
  const Limits limits = limits_of(scene);
  std::vector<Entry> all;
  if (!item.truth.empty()) all = contacts_of(item.truth, scene);
  for (std::size_t b = 0; b < paths.size(); ++b) {
    if (!paths[b]) continue;
    const sim::Shape& shape = scene.bodies[b].shape;
    std::vector<Entry> mine =
        !item.feet        ? entries_of(b, shape, paths[b], level, item.seconds, limits)
        : feet == nullptr ? steps_of(b, shape, paths[b], level, item.seconds, limits)
                          : feet->entries(b);
    for (Entry& entry : mine) {
      entry.wanted = entry.wanted && item.truth.empty();
      entry.time -= item.pulled;
    }
    tests::append(all, mine);
  }
  return all;
}

sim::Scene scene_of(const Case& item) {
  return sim::parse_scene(item.scene, (tests::scene_folder() / (item.sweep + ".yaml")).string());
}

}  // namespace

std::vector<Entry> truth_of(const Case& item) {
  const sim::Scene scene = scene_of(item);
  const Paths known(scene, item.tracker);
  std::vector<Path> paths = known.all();
  for (std::size_t b = 0; b < paths.size(); ++b) {
    if (known.traces[b]) paths[b] = nullptr;
  }
  return truth_of(item, scene, paths, scene.water.front().upper[2]);
}

Outcome run_case(sim::Device& device, const Case& item, std::optional<sim::PressureKind> solver,
                 const std::function<void(double)>& progress) {
  const std::clock_t start = std::clock();
  sim::Scene scene = scene_of(item);
  if (solver) scene.fluid.solver = *solver;
  const Paths paths(scene, item.tracker);
  sim::Simulation simulation(device, scene, item.tracker);
  Heard heard;
  Feet feet(item, scene, paths);
  paths.note(simulation);
  feet.look(simulation);
  while (simulation.seconds() < item.seconds) {
    const sim::FrameResult frame = simulation.advance();
    paths.note(simulation);
    feet.look(simulation);
    for (const sim::DetectedImpact& impact : frame.found.impacts) {
      heard.momenta.push_back(impact.momentum);
    }
    tests::append_found(heard.found, frame.found);
    if (progress) progress(frame.seconds / item.seconds);
  }
  heard.paths = paths.all();
  Outcome outcome;
  outcome.item = item;
  outcome.item.wishes.level = scene.water.front().upper[2];
  const std::vector<Entry> truth =
      truth_of(item, scene, heard.paths, outcome.item.wishes.level, &feet);
  outcome.score = score(truth, heard, outcome.item.wishes);
  if (simulation.totals().resets > 0) outcome.score.faults.emplace_back("the water was begun anew");
  outcome.particles = simulation.particles();
  outcome.processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return outcome;
}

}  // namespace splash::detection
