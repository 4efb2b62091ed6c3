// SPDX-License-Identifier: MIT
// Every scene that is shipped can be read, filled and moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::sim {
namespace {

using tests::scene_file;
using tests::scene_names;

class SampleScene : public ::testing::TestWithParam<std::string> {
 protected:
  Scene scene_ = read_scene(scene_file(GetParam()));
  std::vector<std::unique_ptr<Motion>> motions_ = [this] {
    std::vector<std::unique_ptr<Motion>> motions;
    for (const auto& body : scene_.bodies) {
      motions.push_back(make_motion(body, tests::scene_folder() / "walk.trc"));
    }
    return motions;
  }();
};

TEST_P(SampleScene, IsNamedAfterItsFileAndDescribed) {
  EXPECT_EQ(scene_.name, GetParam());
  EXPECT_FALSE(scene_.description.empty());
}

TEST_P(SampleScene, HasABodyToGrab) {
  const auto can_be_held = [](const BodySettings& body) {
    return !is_free(body) && !is_felt(body);
  };
  EXPECT_TRUE(std::any_of(scene_.bodies.begin(), scene_.bodies.end(), can_be_held));
}

TEST_P(SampleScene, StartsWithTheParticlesItWants) {
  std::vector<Keyframe> poses;
  for (const auto& motion : motions_) {
    const BodyState state = motion->at(0.0);
    poses.push_back({0.0, state.position, state.rotation});
  }
  const double number = static_cast<double>(initial_particles(scene_, poses).size());
  EXPECT_NEAR(number, scene_.fluid.particles, 0.03 * scene_.fluid.particles);
}

TEST_P(SampleScene, BodiesAreSomewhereAtAnyTime) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double t : {-infinity, -1e300, -1.0, 0.0, 0.001, 1.0, 9.99, 1e6, 1e300, infinity,
                         std::numeric_limits<double>::quiet_NaN()}) {
    for (const auto& motion : motions_) {
      const BodyState s = motion->at(t);
      for (const auto& part : {s.position, s.velocity, s.spin}) {
        for (const double number : part) EXPECT_TRUE(std::isfinite(number)) << t;
      }
      const auto& q = s.rotation;
      EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-12) << t;
    }
  }
}

TEST_P(SampleScene, BodiesMoveAsFastAsPeopleDo) {
  for (const auto& motion : motions_) {
    for (double t = 0.0; t < 10.0; t += 0.002) {
      const BodyState s = motion->at(t);
      EXPECT_LT(std::hypot(s.velocity[0], s.velocity[1], s.velocity[2]), 6.0) << t;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SampleScene, ::testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(SampleScenes, ThePapersAreThere) {
  const auto all = scene_names();
  const std::set<std::string> names(all.begin(), all.end());
  const auto particles = [](const std::string& name) {
    return read_scene(scene_file(name)).fluid.particles;
  };
  for (const char* name : {"pool", "beach", "basin", "bucket", "walk", "plunge", "rest"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_EQ(particles("pool"), 15000);
  EXPECT_EQ(particles("beach"), 15000);
  EXPECT_EQ(particles("basin"), 7000);
}

}  // namespace
}  // namespace splash::sim
