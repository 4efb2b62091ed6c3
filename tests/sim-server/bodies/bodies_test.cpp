// SPDX-License-Identifier: MIT
// Where bodies are in a step: poses as given, boxes that hold every point and its reach.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kSupport = 0.04;

class Tumbling : public Motion {
 public:
  explicit Tumbling(double phase) : phase_(phase) {}
  [[nodiscard]] BodyState at(double seconds) const override {
    return {{phase_ + seconds, -0.5 * seconds, 0.3},
            from_turn({2.0 * seconds + phase_, 0.4, -seconds}),
            {1.0, -0.5, 0.0},
            {2.0, 0.0, -1.0}};
  }

 private:
  double phase_ = 0.0;
};

Bodies two() {
  BodySettings foot;
  foot.shape = {ShapeKind::box, {0.26, 0.1, 0.08}, 0.03, 0.4};
  BodySettings ball;
  ball.shape = {ShapeKind::sphere, {0.1, 0.1, 0.1}, 0.0, 0.0};
  std::vector<std::unique_ptr<Motion>> motions;
  motions.push_back(std::make_unique<Tumbling>(0.0));
  motions.push_back(std::make_unique<Tumbling>(0.7));
  return {sample_bodies({foot, ball}, 0.02, kSupport), std::move(motions), kSupport};
}

TEST(Bodies, NameTheOneWhoseCentreIsNearest) {
  const Bodies bodies = two();
  const Vector3 first = bodies.state(0, 0.25).position;
  const Vector3 second = bodies.state(1, 0.25).position;
  EXPECT_EQ(bodies.nearest(first, 0.25), 0);
  EXPECT_EQ(bodies.nearest(second, 0.25), 1);
  EXPECT_EQ(bodies.nearest(second, 0.95), 0) << "the first one is there by then";
  EXPECT_EQ(Bodies({}, {}, kSupport).nearest(first, 0.25), -1);
}

TEST(BodySteps, CarryTheMotionsState) {
  const Bodies bodies = two();
  const auto steps = bodies.at(0.25);
  ASSERT_EQ(steps.size(), 2U);
  for (std::size_t b = 0; b < 2; ++b) {
    const BodyState s = bodies.state(b, 0.25);
    const BodyStep& step = steps[b];
    EXPECT_FLOAT_EQ(step.px, static_cast<float>(s.position[0]));
    EXPECT_FLOAT_EQ(step.py, static_cast<float>(s.position[1]));
    EXPECT_FLOAT_EQ(step.pz, static_cast<float>(s.position[2]));
    EXPECT_FLOAT_EQ(step.qx, static_cast<float>(s.rotation[0]));
    EXPECT_FLOAT_EQ(step.qy, static_cast<float>(s.rotation[1]));
    EXPECT_FLOAT_EQ(step.qz, static_cast<float>(s.rotation[2]));
    EXPECT_FLOAT_EQ(step.qw, static_cast<float>(s.rotation[3]));
    EXPECT_FLOAT_EQ(step.vx, 1.0F);
    EXPECT_FLOAT_EQ(step.vy, -0.5F);
    EXPECT_FLOAT_EQ(step.vz, 0.0F);
    EXPECT_FLOAT_EQ(step.wx, 2.0F);
    EXPECT_FLOAT_EQ(step.wy, 0.0F);
    EXPECT_FLOAT_EQ(step.wz, -1.0F);
  }
}

TEST(BodySteps, BoxesHoldEveryPointAndItsReach) {
  const Bodies bodies = two();
  for (const double t : {0.0, 0.3, 1.1, 2.7}) {
    const auto steps = bodies.at(t);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto bounds = [&](std::size_t b) {
        const BodyStep& s = steps[b];
        const float lower[] = {s.lower_x, s.lower_y, s.lower_z};
        const float upper[] = {s.upper_x, s.upper_y, s.upper_z};
        return std::pair<double, double>{lower[axis], upper[axis]};
      };
      double least[] = {1.0e9, 1.0e9};
      double most[] = {-1.0e9, -1.0e9};
      for (const BodyPoint& point : bodies.points()) {
        const auto b = static_cast<std::size_t>(point.owner);
        const BodyState s = bodies.state(b, t);
        const double x = s.position[axis] + rotate(s.rotation, point.place)[axis];
        least[b] = std::min(least[b], x);
        most[b] = std::max(most[b], x);
      }
      for (std::size_t b = 0; b < 2; ++b) {
        // As tight as floats are: a larger box would be right, too, and slow.
        EXPECT_NEAR(bounds(b).first, least[b] - kSupport, 1.0e-6);
        EXPECT_NEAR(bounds(b).second, most[b] + kSupport, 1.0e-6);
      }
    }
  }
}

TEST(BodySteps, FastestBoundsEveryPoint) {
  const Bodies bodies = two();
  const double fastest = bodies.fastest(0.4);
  double found = 0.0;
  for (const BodyPoint& point : bodies.points()) {
    const BodyState s = bodies.state(static_cast<std::size_t>(point.owner), 0.4);
    found = std::max(found, length(s.velocity + cross(s.spin, rotate(s.rotation, point.place))));
  }
  EXPECT_GE(fastest, found);
  EXPECT_LT(fastest, 1.5 * found);
}

TEST(BodySteps, NoBodiesAreNoSteps) {
  const Bodies bodies({}, {}, kSupport);
  EXPECT_TRUE(bodies.at(0.0).empty());
  EXPECT_EQ(bodies.fastest(0.0), 0.0);
}

}  // namespace
}  // namespace splash::sim
