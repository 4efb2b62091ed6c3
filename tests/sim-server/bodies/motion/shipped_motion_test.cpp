// SPDX-License-Identifier: MIT
// The CSV motions that are shipped move as their remarks say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/bodies/motion/sole_calibration.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {
namespace {

struct Entry {
  double time;
  double speed;  ///< downward, of the lowest point [m/s]
};

/// Each time the lowest point of a body's underside goes below `level`.
std::vector<Entry> entries(const BodySettings& body, const Motion& motion, double level,
                           double until) {
  constexpr double kStep = 0.0005;
  std::vector<Entry> found;
  double before = 0.0;
  for (double t = 0.0; t < until; t += kStep) {
    const BodyState s = motion.at(t);
    const double height = sole_height(body.shape, {}, {s.rotation, s.position}) - level;
    if (before > 0.0 && height <= 0.0) found.push_back({t, (before - height) / kStep});
    before = height;
  }
  return found;
}

TEST(ShippedMotion, TheHandPlungesFourTimes) {
  const Scene scene = read_scene(tests::scene_file("basin"));
  const auto motion = make_motion(scene.bodies.at(0), {});
  const auto plunges = entries(scene.bodies[0], *motion, 0.5, 10.0);
  ASSERT_EQ(plunges.size(), 4U);
  const std::vector<double> peaks = {1.0, 1.5, 0.6, 1.7};
  double slowest = 9.0;
  double fastest = 0.0;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    double peak = 0.0;
    for (double t = plunges[i].time - 0.5; t < plunges[i].time + 0.5; t += 0.001) {
      peak = std::max(peak, -motion->at(t).velocity[2]);
    }
    EXPECT_NEAR(peak, peaks[i], 0.01);
    slowest = std::min(slowest, plunges[i].speed);
    fastest = std::max(fastest, plunges[i].speed);
  }
  EXPECT_GT(slowest, 0.5);
  EXPECT_GT(fastest, 1.5);
  EXPECT_GT(motion->at(0.0).position[2], 0.7) << "begins above the water";
}

TEST(ShippedMotion, FeetInThePoolStepInTurnAndStand) {
  const Scene scene = read_scene(tests::scene_file("pool"));
  std::vector<Entry> all;
  for (const auto& body : scene.bodies) {
    const auto motion = make_motion(body, {});
    const auto steps = entries(body, *motion, 0.2, 14.4);
    EXPECT_EQ(steps.size(), 8U) << body.name;
    all.insert(all.end(), steps.begin(), steps.end());
    double lowest = 1.0;
    for (double t = 0.0; t < 14.4; t += 0.005) {
      lowest = std::min(lowest, motion->at(t).position[2]);
    }
    EXPECT_NEAR(lowest - 0.5 * body.shape.size[2], 0.03, 1e-4) << "stands 3 cm above the floor";
  }
  std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GT(all[i].time - all[i - 1].time, 0.6);
  for (const Entry& step : all) {
    EXPECT_GT(step.speed, 0.9);
    EXPECT_LT(step.speed, 1.5);
  }
}

TEST(ShippedMotion, TheDiscMeetsTheLevelAtItsTimeAndSpeed) {
  const Scene scene = read_scene(tests::scene_file("plunge"));
  const auto motion = make_motion(scene.bodies.at(0), {});
  const auto plunges = entries(scene.bodies[0], *motion, 0.3, 5.0);
  ASSERT_EQ(plunges.size(), 1U);
  EXPECT_NEAR(plunges[0].time, 1.2, 0.001);
  EXPECT_NEAR(plunges[0].speed, 1.0, 1e-9);
}

}  // namespace
}  // namespace splash::sim
