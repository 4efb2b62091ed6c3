// SPDX-License-Identifier: MIT
#include "tests/bench/skips_equality.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim-server/gauge/gauges.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/bench/fluid_block.hpp"
#include "tests/support/source_folder.hpp"

namespace splash::bench {
namespace {

using namespace splash::sim;

constexpr double kShorter = 0.999;

std::filesystem::path source(const char* file) {
  return tests::source_folder() / file;
}

GaugeSettings probe(const char* name, GaugeKind kind, const Vector3& place) {
  GaugeSettings settings;
  settings.name = name;
  settings.kind = kind;
  settings.place = place;  // of pressures
  settings.x = place[0];   // of heights
  settings.y = place[1];
  return settings;
}

SkipScene plunge() {
  Scene scene = read_scene(source("configs/scenes/plunge.yaml"));
  scene.gauges.rate = 50.0;
  scene.gauges.probes = {probe("near", GaugeKind::height, {0.15, 0.05, 0.0}),
                         probe("corner", GaugeKind::height, {0.25, -0.25, 0.0}),
                         probe("floor", GaugeKind::pressure, {0.0, 0.0, 0.0}),
                         probe("side", GaugeKind::pressure, {0.3, 0.1, 0.1})};
  return {"plunge", scene, 4.0};
}

SkipScene spheric2() {
  Scene scene = read_scene(source("tests/validation/scenes/spheric2.yaml"));
  scene.fluid.spacing = 0.04;
  return {"spheric2", scene, 6.0};
}

/// All numbers of all events, one after the other.
std::vector<double> numbers_of(const Detections& found) {
  std::vector<double> all;
  const auto add = [&](std::initializer_list<double> some, const Vector3& place) {
    all.insert(all.end(), some);
    all.insert(all.end(), place.begin(), place.end());
  };
  for (const DetectedImpact& e : found.impacts) {
    add({e.time, static_cast<double>(e.body), e.speed, e.approach}, e.position);
  }
  for (const DetectedBubble& e : found.bubbles) {
    add({e.time, static_cast<double>(e.particle), e.radius, e.epsilon}, e.position);
  }
  for (const DetectedCavity& e : found.cavities) {
    add({e.time, static_cast<double>(e.bubbles), e.radius}, e.position);
  }
  return all;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

/// Sums over what two gauges say at the same times.
struct Apart {
  double most = 0.0;
  double squares = 0.0;
  double size = 0.0;
  double count = 0.0;

  void add(const validation::Series& a, const validation::Series& b, const std::string& name) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double value = a[name][k];
      const double off = value - validation::interpolate(b["time"], b[name], a["time"][k]);
      most = std::max(most, std::abs(off));
      squares += off * off;
      size += value * value;
      ++count;
    }
  }
};

}  // namespace

std::vector<SkipScene> skip_scenes() {
  return {plunge(), spheric2()};
}

std::vector<SkipVariant> skip_variants() {
  SkipSettings none;
  none.sleep = none.idle = none.contacts = none.bubbles = none.cavities = none.kernels = false;
  std::vector<SkipVariant> all = {{"all skips on", {}}};
  const std::vector<std::pair<std::string, bool SkipSettings::*>> switches = {
      {"sleep off", &SkipSettings::sleep},       {"idle off", &SkipSettings::idle},
      {"contacts off", &SkipSettings::contacts}, {"bubbles off", &SkipSettings::bubbles},
      {"cavities off", &SkipSettings::cavities}, {"kernels off", &SkipSettings::kernels}};
  for (const auto& [name, member] : switches) {
    SkipSettings skip;
    skip.*member = false;
    all.push_back({name, skip});
  }
  all.push_back({"all off", none});
  all.push_back({"noise", none, kShorter});
  return all;
}

SkipRun run_with(Device& device, const SkipScene& item, const SkipVariant& variant) {
  SkipRun run;
  Scene scene = item.scene;
  scene.skip = variant.skip;
  scene.fluid.time_step_factor *= variant.time_step_factor;
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  run.gauges = validation::Series(gauges.columns());
  while (simulation.seconds() < item.seconds) {
    if (gauges.is_due(simulation.seconds())) {
      run.gauges.add(gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies()));
    }
    const double before = processor_time();
    const FrameResult frame = simulation.advance();
    run.processor += processor_time() - before;
    append(run.found.impacts, frame.found.impacts);
    append(run.found.bubbles, frame.found.bubbles);
    append(run.found.cavities, frame.found.cavities);
  }
  run.totals = simulation.totals();
  return run;
}

SkipDifference difference(const SkipRun& a, const SkipRun& b) {
  Apart heights;
  Apart pressures;
  for (const std::string& name : a.gauges.names()) {
    if (name.ends_with("_height")) heights.add(a.gauges, b.gauges, name);
    if (name.ends_with("_pressure")) pressures.add(a.gauges, b.gauges, name);
  }
  return {heights.most, std::sqrt(heights.squares / heights.count),
          std::sqrt(pressures.squares / pressures.count),
          std::sqrt(pressures.size / pressures.count), numbers_of(a.found) == numbers_of(b.found)};
}

}  // namespace splash::bench
