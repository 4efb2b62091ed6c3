// SPDX-License-Identifier: MIT
// A disc that falls flat into still water: one impact at the right moment and speed, bubbles, a
// cavity; and the same once more. configs/scenes/plunge.yaml as it ships, and at other speeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tests/sim-server/detect/scene_run.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

constexpr double kHalfDisc = 0.02;   ///< its underside is that far below its centre [m]
constexpr double kFall = 0.40;       ///< how far it falls [m]
constexpr double kStarts = 1.0;      ///< when [s]
constexpr double kSpacing = 0.0238;  ///< of the scene's particles [m]

/// The scene with its keyframe `from` at another time [s].
std::string with_key(const std::string& text, const std::string& from, double to) {
  return changed(text, "{time: " + from + ",", "{time: " + std::to_string(to) + ",");
}

/// The scene with the fall at `speed`; it stays down for 0.6 s and rises at half a metre a second.
std::string plunge_at(double speed) {
  const double down = kStarts + kFall / speed;
  const std::string text = scene_text("plunge.yaml");
  if (speed == 1.0) return text;
  return with_key(with_key(with_key(text, "1.4", down), "2.0", down + 0.6), "2.8", down + 1.4);
}

/// When and where the underside reaches the water's surface, as the particles' volume has it.
struct Meeting {
  double time = 0.0;   ///< [s]
  double level = 0.0;  ///< [m]
};

Meeting meeting_of(const std::vector<Gauge>& gauges) {
  for (std::size_t k = 1; k < gauges.size(); ++k) {
    const double before = gauges[k - 1].height - kHalfDisc - gauges[k - 1].level;
    const double after = gauges[k].height - kHalfDisc - gauges[k].level;
    if (after > 0.0) continue;
    const double part = before / (before - after);
    return {gauges[k - 1].time + part * (gauges[k].time - gauges[k - 1].time),
            gauges[k - 1].level + part * (gauges[k].level - gauges[k - 1].level)};
  }
  throw std::runtime_error("the disc never reached the water");
}

/// The scene with the fall begun that late, when the water has gone to sleep.
constexpr double kAsleep = 3.5;  // [s]
std::string plunge_after(double rest) {
  std::string text = scene_text("plunge.yaml");
  for (const char* time : {"1.0", "1.4", "2.0", "2.8"}) {
    text = with_key(text, time, std::stod(time) - kStarts + rest);
  }
  return text;
}

class Plunge : public ::testing::TestWithParam<double> {};

TEST_P(Plunge, IsHeardAsOneAndEntrapsAir) {
  const double speed = GetParam();
  const SceneRun run = run_scene(plunge_at(speed), kStarts + kFall / speed + 1.6);
  ASSERT_EQ(run.found.impacts.size(), 1U);
  const DetectedImpact& impact = run.found.impacts.front();
  const Meeting meeting = meeting_of(run.gauges);
  std::printf(
      "%.1f m/s: meets %.4f m at %.4f s; impact at %.4f s (%+.2f ms, step %.2f ms) at %.3f m/s, "
      "approach %.3f m/s; %zu bubbles, %zu cavities\n",
      speed, meeting.level, meeting.time, impact.time, 1e3 * (impact.time - meeting.time),
      1e3 * run.time_step, impact.speed, impact.approach, run.found.bubbles.size(),
      run.found.cavities.size());
  // To one step; a slow body takes longer than that over the roughness of the particle surface, a
  // tenth of a spacing.
  const double roughness = 0.1 * kSpacing / speed;
  EXPECT_NEAR(impact.time, meeting.time, std::max(run.time_step, roughness));
  EXPECT_NEAR(impact.speed, speed, 0.05 * speed);
  // The water breathes at up to a tenth of a metre per second.
  EXPECT_NEAR(impact.approach, speed, 0.05 * speed + 0.1);
  EXPECT_EQ(impact.body, 0);
  // Under the disc; and where the surfaces meet.
  EXPECT_LT(std::hypot(impact.position[0], impact.position[1]), 0.1 + 1.0e-6);
  EXPECT_NEAR(impact.position[2], meeting.level, 0.005);
  EXPECT_EQ(run.totals.resets, 0U);

  ASSERT_FALSE(run.found.bubbles.empty());
  const double first =
      std::min_element(run.found.bubbles.begin(), run.found.bubbles.end(),
                       [](const auto& a, const auto& b) { return a.time < b.time; })
          ->time;
  std::printf("%.1f m/s: first bubble %.3f s after the impact, %zu in all; %zu cavities\n", speed,
              first - impact.time, run.found.bubbles.size(), run.found.cavities.size());
  // A bubble's moment is drawn within its frame where nothing tells it.
  EXPECT_GT(first, impact.time - run.frame);
  EXPECT_LT(first, impact.time + 1.0);
  // A slower disc (v^2 / (g R) = 0.26) draws no deep cavity. A faster one stops 0.1 s after it went
  // in, long before its hollow closes (0.23 s), which then is shut first where the water is
  // deepest, at the disc.
  EXPECT_EQ(run.found.cavities.size(), speed == 1.0 ? 1U : 0U);
  EXPECT_EQ(run.totals.bubbles_dropped, 0U);
}

// Every skip off, every skip on: the same impact, bubbles and cavities as many as from one run of a
// splash to the next.
TEST(PlungeSkips, DoNotChangeWhatIsHeard) {
  const std::string lazy = plunge_after(kAsleep);
  const std::string busy = lazy +
                           "\nskip: {sleep: false, idle: false, contacts: false, bubbles: false, "
                           "cavities: false}\n";
  const SceneRun some = run_scene(lazy, kAsleep + 2.0);
  const SceneRun all = run_scene(busy, kAsleep + 2.0);
  std::printf(
      "skips on / off: impact %.4f / %.4f s, %zu / %zu bubbles, %zu / %zu cavities; asleep "
      "%.2f of the water\n",
      some.found.impacts.at(0).time, all.found.impacts.at(0).time, some.found.bubbles.size(),
      all.found.bubbles.size(), some.found.cavities.size(), all.found.cavities.size(),
      some.totals.skipped.asleep_sum / static_cast<double>(some.totals.frames));
  ASSERT_EQ(some.found.impacts.size(), all.found.impacts.size());
  EXPECT_NEAR(some.found.impacts.front().time, all.found.impacts.front().time, 0.002);
  EXPECT_NEAR(some.found.impacts.front().speed, all.found.impacts.front().speed, 1.0e-3);
  const auto bubbles = static_cast<double>(all.found.bubbles.size());
  EXPECT_NEAR(static_cast<double>(some.found.bubbles.size()), bubbles, 0.2 * bubbles);
  EXPECT_GT(some.totals.skipped.contacts, 50U);
  EXPECT_GT(some.totals.skipped.bubbles, 50U);
  EXPECT_GT(some.totals.skipped.asleep_sum, 20.0);
  EXPECT_EQ(all.totals.skipped.idle + all.totals.skipped.contacts + all.totals.skipped.bubbles, 0U);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Plunge, ::testing::Values(0.5, 1.0, 2.0), [](const auto& speed) {
  return std::to_string(static_cast<int>(10.0 * speed.param)) + "_dm_per_s";
});

/// All numbers of all events, in the order in which they were found.
struct EventNumbers {
  std::vector<double> impacts;
  std::vector<double> places;  ///< and times, of bubbles and cavities
  std::vector<double> sizes;   ///< of bubbles
};

EventNumbers numbers_of(const Detections& found) {
  EventNumbers all;
  for (const DetectedImpact& e : found.impacts) {
    for (const double x : {e.time, static_cast<double>(e.body), e.speed, e.approach, e.position[0],
                           e.position[1], e.position[2]}) {
      all.impacts.push_back(x);
    }
  }
  for (const DetectedBubble& e : found.bubbles) {
    for (const double x :
         {static_cast<double>(e.particle), e.position[0], e.position[1], e.position[2]}) {
      all.places.push_back(x);
    }
    for (const double x : {e.radius, e.epsilon, e.time}) all.sizes.push_back(x);
  }
  for (const DetectedCavity& e : found.cavities) {
    for (const double x : {e.time, static_cast<double>(e.bubbles), e.radius, e.position[0],
                           e.position[1], e.position[2]}) {
      all.places.push_back(x);
    }
  }
  return all;
}

// The seed is the bubbles' alone: what happens in the water is the same.
TEST(Repetition, WithAnotherSeedHasOtherBubbleSizes) {
  const std::string text =
      scene_text("plunge.yaml") + "\ndetect: {bubble_per_particle: true, cavity_by_count: true}\n";
  const EventNumbers first = numbers_of(run_scene(text, 1.8).found);
  const EventNumbers second = numbers_of(run_scene("seed: 77\n" + text, 1.8).found);
  EXPECT_FALSE(first.impacts.empty());
  EXPECT_EQ(first.impacts, second.impacts);
  EXPECT_EQ(first.places, second.places);
  ASSERT_EQ(first.sizes.size(), second.sizes.size());
  ASSERT_GT(first.sizes.size(), 30U);
  for (std::size_t k = 0; k < first.sizes.size(); k += 3) {
    EXPECT_NE(first.sizes[k], second.sizes[k]);
  }
}

/// The scene with another body.
std::string plunge_of(const std::string& shape) {
  std::string text = scene_text("plunge.yaml");
  const std::size_t from = text.find("    shape:");
  return text.replace(from, text.find("    motion:") - from, "    shape: {" + shape + "}\n");
}

// Whether it is a sphere or a mesh of one.
TEST(MeshPlunge, IsHeardWhenTheSpheresIs) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("ball.obj", obj_text(sphere_mesh(0.1, 3)));
  const SceneRun sphere = run_scene(plunge_of("kind: sphere, size: [0.2, 0.2, 0.2]"), 2.2);
  const SceneRun mesh = run_scene(plunge_of("mesh: " + file.string()), 2.2);
  ASSERT_EQ(sphere.found.impacts.size(), 1U);
  ASSERT_EQ(mesh.found.impacts.size(), 1U);
  const DetectedImpact& one = sphere.found.impacts.front();
  const DetectedImpact& other = mesh.found.impacts.front();
  std::printf(
      "sphere %.4f s, mesh %.4f s (step %.2f ms); approach %.3f, %.3f m/s; %zu, %zu bubbles; "
      "%zu, %zu cavities\n",
      one.time, other.time, 1e3 * mesh.time_step, one.approach, other.approach,
      sphere.found.bubbles.size(), mesh.found.bubbles.size(), sphere.found.cavities.size(),
      mesh.found.cavities.size());
  // To a step, or the roughness of the particle surface: what the sphere is told to.
  EXPECT_NEAR(other.time, one.time, std::max(mesh.time_step, 0.1 * kSpacing));
  EXPECT_NEAR(other.speed, one.speed, 1.0e-3);
  EXPECT_NEAR(other.approach, one.approach, 0.1);
  EXPECT_NEAR(other.position[2], one.position[2], 0.1 * kSpacing);
  const auto bubbles = static_cast<double>(sphere.found.bubbles.size());
  EXPECT_NEAR(static_cast<double>(mesh.found.bubbles.size()), bubbles, 0.25 * bubbles);
  EXPECT_EQ(mesh.totals.resets, 0U);
}

}  // namespace
}  // namespace splash::sim
