// SPDX-License-Identifier: MIT
#include "tests/sim-server/detect/scene_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sim-server/scene/scene_reader.hpp"

namespace splash::sim {
namespace {

/// Under the disc, off its rim [m].
constexpr double kGaugeRadius = 0.085;

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

std::string scene_text(const std::string& name) {
  std::ifstream file(std::string(SPLASH_SOURCE_DIR) + "/configs/scenes/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error("no scene " + name);
  return text.str();
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
    throw std::runtime_error("not once in the scene: " + from);
  }
  return text.replace(at, from.size(), to);
}

double water_level(Simulation& simulation, double radius) {
  Fluid& fluid = simulation.fluid();
  const double spacing = static_cast<double>(fluid.params().spacing);
  const Snapshot snapshot = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  std::map<std::pair<int, int>, double> highest;
  for (std::size_t i = 0; i < snapshot.id.size(); ++i) {
    const double x = static_cast<double>(snapshot.position[i]);
    const double y = static_cast<double>(snapshot.position[stride + i]);
    const double z = static_cast<double>(snapshot.position[2 * stride + i]);
    if (std::hypot(x, y) > radius) continue;
    const std::pair<int, int> square = {static_cast<int>(std::floor(x / spacing)),
                                        static_cast<int>(std::floor(y / spacing))};
    double& top = highest.try_emplace(square, z).first->second;
    top = std::max(top, z);
  }
  // A square that no particle of the top layer happens to be in shows the layer below.
  std::vector<double> tops;
  for (const auto& [square, top] : highest) tops.push_back(top);
  std::nth_element(tops.begin(), tops.begin() + std::ssize(tops) / 2, tops.end());
  const double middle = tops[tops.size() / 2];
  double sum = 0.0;
  int count = 0;
  for (const double top : tops) {
    if (std::abs(top - middle) > spacing / 2.0) continue;
    sum += top;
    ++count;
  }
  return sum / count + spacing / 2.0;
}

SceneRun run_scene(const std::string& text, double seconds) {
  Device device;
  const Scene scene = parse_scene(text, "test scene");
  Simulation simulation(device, scene, {});
  SceneRun run;
  while (simulation.seconds() < seconds) {
    const std::int64_t steps = simulation.totals().steps;
    const double before = simulation.seconds();
    const FrameResult frame = simulation.advance();
    const double count = static_cast<double>(simulation.totals().steps - steps);
    run.frame = std::max(run.frame, frame.seconds - before);
    run.time_step = std::max(run.time_step, (frame.seconds - before) / count);
    append(run.found.impacts, frame.found.impacts);
    append(run.found.bubbles, frame.found.bubbles);
    append(run.found.cavities, frame.found.cavities);
    const bool over = !run.found.impacts.empty() &&
                      frame.seconds > run.found.impacts.front().time + 2.0 * run.frame;
    if (!scene.bodies.empty() && !over) {
      run.gauges.push_back({frame.seconds, water_level(simulation, kGaugeRadius),
                            simulation.bodies().state(0, frame.seconds).position[2]});
    }
  }
  run.totals = simulation.totals();
  return run;
}

}  // namespace splash::sim
