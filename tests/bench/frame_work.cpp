// SPDX-License-Identifier: MIT
#include "tests/bench/frame_work.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "sim-server/bodies/skin.hpp"
#include "sim-server/detect/bubble_state.h"

namespace splash::bench {
namespace {

using namespace splash::sim;

constexpr double kEddy = 0.06;  ///< its width, bubble_eddy [m]

/// Per particle: places, speeds, id, peak, and what spawning remembers [B].
constexpr double kState = 36.0;

// Operations of a pair that a detector looks at: where it is and the kernel (colour.h), what else
// it sums (body_touch.cl, bubble_state.cl, air_fold.cl). Of a particle in the statistics.
constexpr double kOfPair = 18.0, kOfTouch = 22.0, kOfCarried = 8.0, kOfEddy = 14.0, kOfMean = 3.0,
                 kOfSurvey = 60.0;
// Scalar instructions of the nine runs around a place, of a particle that is slow, of a cell that
// wakes others.
constexpr double kOfRuns = 9.0 * 25.0, kOfSlow = 10.0, kOfAwake = 30.0;

double count_fast(Fluid& fluid, double speed) {
  const auto stride = static_cast<std::size_t>(fluid.particles().stride);
  const auto count = static_cast<std::size_t>(fluid.params().count);
  const std::vector<float> v = fluid.particles().velocity.read(fluid.device(), 3 * stride);
  double fast = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = static_cast<double>(std::hypot(v[i], v[stride + i], v[2 * stride + i]));
    fast += u >= speed ? 1.0 : 0.0;
  }
  return fast;
}

/// Particles in any body's box, in which neighbours may be those of its skin.
double count_near(Fluid& fluid, const Step& step) {
  const auto stride = static_cast<std::size_t>(fluid.particles().stride);
  const auto count = static_cast<std::size_t>(fluid.params().count);
  const auto bodies = static_cast<std::size_t>(fluid.boundary().body_count());
  if (bodies == 0) return 0.0;
  const std::vector<float> x = fluid.particles().position.read(fluid.device(), 3 * stride);
  std::vector<BodyStep> steps(bodies);
  fluid.boundary().steps().read(fluid.device(), std::span<BodyStep>(steps),
                                static_cast<std::size_t>(step.first_body));
  double near = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    near += std::any_of(steps.begin(), steps.end(), [&](const BodyStep& b) {
      return x[i] > b.lower_x && x[i] < b.upper_x && x[stride + i] > b.lower_y &&
             x[stride + i] < b.upper_y && x[2 * stride + i] > b.lower_z &&
             x[2 * stride + i] < b.upper_z;
    });
  }
  return near;
}

/// Lanes that a search for one place visits, on average.
double lanes_of_a_search(const Places& p, int lanes) {
  const Met met = meet_all(p, 1);
  // Each of the nine runs fills its vectors, and the last one half.
  const double in_runs = met.visited / met.turns;
  return lanes == 1 ? in_runs : in_runs + 9.0 * 0.5 * (lanes - 1);
}

Work pairs_of(double places, double lanes, double operations, const Profile& profile) {
  Work work = {.groups = std::ceil(places / 64.0),
               .operations = places * lanes * operations,
               .runs = 9.0 * places};
  (profile.lanes > 1 ? work.scalar : work.operations) += places * kOfRuns;
  return work;
}

}  // namespace

FrameSeen see_frame(Simulation& simulation) {
  FrameSeen seen;
  const Scene& scene = simulation.scene();
  const RunTotals before = simulation.totals();
  seen.bubbles = static_cast<double>(before.bubbles_alive);
  simulation.set_hook([&](Fluid& fluid, Step& step, Moment moment) {
    if (moment != Moment::between) return;
    seen.places = places_of(fluid, step);
    seen.fast = count_fast(fluid, scene.detect.bubble_speed);
    seen.near = count_near(fluid, step);
  });
  const FrameResult frame = simulation.advance();
  simulation.set_hook({});
  const RunTotals& after = simulation.totals();
  seen.steps = static_cast<int>(after.steps - before.steps);
  if (seen.steps == 0 || frame.step_fault) throw std::runtime_error("the frame is no usual one");
  seen.places.watched = true;
  seen.sleeps = scene.skip.sleep && scene.fluid.solver == PressureKind::weakly_compressible;
  seen.looks = after.skipped.bubbles == before.skipped.bubbles;
  if (!seen.looks) seen.bubbles = seen.fast = 0.0;
  if (after.skipped.contacts == before.skipped.contacts) {
    seen.skin = static_cast<double>(
        sample_skins(scene.bodies, static_cast<double>(seen.places.params.spacing)).size());
  }
  return seen;
}

std::map<std::string, Work> frame_work(const FrameSeen& seen, const Profile& profile) {
  const Places& p = seen.places;
  const double n = p.params.count;
  std::map<std::string, Work> all;
  for (const auto& [name, work] : work_of(p, profile)) all[name] = work.times(seen.steps);
  all["reduce_stats"] = {
      .groups = static_cast<double>(profile.parts), .bytes = 44.0 * n, .operations = kOfSurvey * n};
  if (seen.sleeps) {
    const double rows = static_cast<double>(p.params.cells_y) * p.params.cells_z;
    const double cells = rows * p.params.cells_x;
    const double groups = profile.team > 1 ? rows : rows / static_cast<double>(profile.group);
    all["keep_awake"] = {.groups = groups, .bytes = 12.0 * n + 16.0 * cells, .operations = 6.0 * n};
    all["spread_activity"] = {.groups = groups, .bytes = 12.0 * cells};
    for (const char* name : {"keep_awake", "spread_activity"}) {
      Work& work = all[name];
      (profile.lanes > 1 ? work.scalar : work.operations) += kOfAwake * cells;
    }
  }
  const double lanes = seen.looks || seen.skin > 0.0 ? lanes_of_a_search(p, profile.lanes) : 0.0;
  if (seen.skin > 0.0) {
    all["touch_water"] = pairs_of(2.0 * seen.skin, lanes, kOfPair + 0.5 * kOfTouch, profile);
    all["touch_water"].bytes = 116.0 * seen.skin;
    Work means = pairs_of(seen.near, lanes, kOfPair + kOfMean, profile);
    means.groups = std::ceil(n / 64.0);
    means.bytes = 12.0 * n + 4.0 * seen.near;
    all["average_density"] = means;
  }
  if (seen.looks) {
    Work spawns = pairs_of(seen.fast, lanes, kOfPair, profile);
    spawns.groups = std::ceil(n / 64.0);
    spawns.bytes = 20.0 * n;
    (profile.lanes > 1 ? spawns.scalar : spawns.operations) += kOfSlow * n;
    all["spawn_bubbles"] = spawns;
    // One particle in so many looks within an eddy's width, as a search does within the support.
    const double wide = std::pow(kEddy / static_cast<double>(p.params.support), 3.0);
    const double few = std::ceil(n / SPLASH_FOLDS_APART);
    Work folds = pairs_of(few, std::max(1.0, wide) * lanes, kOfPair + kOfEddy, profile);
    folds.groups = std::ceil(few / 64.0);
    folds.bytes = 24.0 * few;
    all["fold_air"] = folds;
  }
  if (seen.bubbles == 0.0) return all;
  all["carry_bubbles"] = pairs_of(2.0 * seen.bubbles, lanes, kOfPair + kOfCarried, profile);
  all["carry_bubbles"].bytes = 40.0 * seen.bubbles;
  const auto cells = static_cast<double>(p.cell_start.size());
  const double chunks = std::min(1.0, static_cast<double>(profile.sort_chunks));
  // Their number changes from frame to frame: all cells are gone through (cell_count.cl).
  for (const auto& [name, work] :
       sort_work({seen.bubbles, cells, cells, chunks, seen.bubbles}, profile)) {
    all[name] += work;
  }
  return all;
}

Commands frame_commands(const FrameSeen& seen) {
  Commands commands;
  commands.writes = 1 + (seen.bubbles > 0.0 ? 3 : 0);  // the bodies' steps; the bubbles
  commands.fills = 1 + (seen.looks ? 2 : 0);  // records of health; the counts of spawns and folds
  commands.copies = 5;                        // of the state (kState)
  commands.reads = 2 + (seen.skin > 0.0 ? 1 : 0) +  // stats and health; contacts
                   (seen.looks ? 4 : 0) + (seen.bubbles > 0.0 ? 1 : 0);
  return commands;
}

double copied_bytes(const FrameSeen& seen) {
  return 2.0 * kState * seen.places.params.count;
}

}  // namespace splash::bench
