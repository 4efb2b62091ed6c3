// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/grabbed_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sim-server/bodies/motion/path_motion.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kFrame = 1.0 / 160.0;  // [s]
constexpr double kWall = 100.0;         // our clock at simulated second 0 [s]

/// Back and forth along x, a metre and two seconds either way.
std::unique_ptr<Motion> script() {
  const std::vector<Keyframe> keys = {
      {0.0, {0.0, 0.0, 0.0}}, {2.0, {1.0, 0.0, 0.0}}, {4.0, {0.0, 0.0, 0.0}}};
  return std::make_unique<PathMotion>(keys, Between::monotone, true);
}

/// Plays a motion frame by frame; poses of `hand` come 100 times a second.
class Play {
 public:
  explicit Play(GrabbedMotion& motion) : motion_(motion) {}

  void go(double until, const std::function<Vector3(double)>& hand = {}) {
    while (seconds_ < until) {
      for (; hand && next_pose_ <= seconds_; next_pose_ += 0.01) {
        last_ = motion_.push(hand(next_pose_), {0.0, 0.0, 0.0, 1.0}, {kWall + next_pose_, {}});
      }
      if (!hand) next_pose_ = seconds_;
      motion_.begin({seconds_, kWall + seconds_, kFrame});
      const BodyState start = motion_.at(seconds_);
      if (seconds_ > 0.0) step_ = std::max(step_, length(start.position - end_));
      check_velocity();
      end_ = motion_.at(seconds_ + kFrame).position;
      seconds_ += kFrame;
    }
  }
  [[nodiscard]] BodyState now() const { return motion_.at(seconds_); }
  [[nodiscard]] double seconds() const noexcept { return seconds_; }
  /// The farthest that the body was put from one frame's end to the next one's start [m].
  [[nodiscard]] double largest_step() const noexcept { return step_; }
  [[nodiscard]] double fastest() const noexcept { return fastest_; }
  void forget_speed() noexcept { fastest_ = 0.0; }
  [[nodiscard]] PoseRefusal last() const noexcept { return last_; }

 private:
  /// Told velocities are those of the places.
  void check_velocity() {
    constexpr double kStep = 1e-5;  // [s]
    const double middle = seconds_ + 0.4 * kFrame;
    const BodyState state = motion_.at(middle);
    const Vector3 change =
        motion_.at(middle + kStep).position - motion_.at(middle - kStep).position;
    const Vector3 velocity = 0.5 / kStep * change;
    fastest_ = std::max(fastest_, length(velocity));
    EXPECT_LT(length(velocity - state.velocity), 0.1 + 0.1 * length(velocity)) << seconds_;
  }

  GrabbedMotion& motion_;
  double seconds_ = 0.0;
  double next_pose_ = 0.0;
  double step_ = 0.0;
  double fastest_ = 0.0;
  Vector3 end_ = {};
  PoseRefusal last_ = PoseRefusal::none;
};

TEST(GrabbedMotion, UngrabbedIsItsOwnMotionBitForBit) {
  GrabbedMotion motion(script());
  const auto own = script();
  Play play(motion);
  play.go(3.0, [](double) { return Vector3{5.0, 5.0, 5.0}; });
  EXPECT_EQ(play.last(), PoseRefusal::not_tracked);
  for (double t = 3.0; t < 5.0; t += 0.01) {
    EXPECT_EQ(motion.at(t).position, own->at(t).position);
    EXPECT_EQ(motion.at(t).velocity, own->at(t).velocity);
  }
  EXPECT_EQ(motion.fastest(), own->fastest());
}

TEST(GrabbedMotion, AHandTakesItAndItGoesBackWithoutAJump) {
  GrabbedMotion motion(script());
  const auto own = script();
  Play play(motion);
  play.go(1.0);
  motion.grab(true);
  const auto hand = [](double t) { return Vector3{0.5, 0.3 * std::sin(3.0 * (t - 1.0)), 0.0}; };
  play.go(3.0, hand);
  EXPECT_TRUE(motion.is_held());
  EXPECT_LT(length(play.now().position - hand(play.seconds())), 0.03);
  motion.grab(false);
  play.go(3.2);
  EXPECT_FALSE(motion.is_held());
  EXPECT_GT(length(play.now().position - own->at(play.seconds()).position), 0.02) << "on its way";
  play.go(3.0 + 0.55);
  EXPECT_EQ(play.now().position, own->at(play.seconds()).position);
  EXPECT_LT(play.largest_step(), 0.005);
  EXPECT_LT(play.fastest(), 4.0);
}

TEST(GrabbedMotion, PosesThatStayOutForHalfASecondLetGo) {
  GrabbedMotion motion(script());
  const auto own = script();
  Play play(motion);
  motion.grab(true);
  const auto hand = [](double) { return Vector3{0.1, 0.1, 0.1}; };
  play.go(1.0, hand);
  play.go(1.4);
  EXPECT_TRUE(motion.is_held());
  EXPECT_LT(length(play.now().position - hand(1.0)), 0.01) << "stays where it was left";
  play.go(1.55);
  EXPECT_FALSE(motion.is_held());
  play.go(2.3);
  EXPECT_EQ(play.now().position, own->at(play.seconds()).position);
  play.go(3.0, hand);
  EXPECT_TRUE(motion.is_held()) << "it is still grabbed: new poses move it again";
}

TEST(GrabbedMotion, TheWayBackFromFarIsNoneOfASplash) {
  GrabbedMotion motion(script());
  Play play(motion);
  motion.grab(true);
  play.go(1.0, [](double t) { return Vector3{0.0, 0.0, 1.25 - 1.25 * std::cos(3.14159 * t)}; });
  motion.grab(false);
  play.forget_speed();
  play.go(4.0);
  EXPECT_LT(play.largest_step(), 0.02);
  EXPECT_LT(play.fastest(), 3.0) << "2 m/s more than its own way";
}

TEST(GrabbedMotion, GrabbedAnewItForgetsTheLastHand) {
  GrabbedMotion motion(script());
  Play play(motion);
  motion.grab(true);
  play.go(1.0, [](double) { return Vector3{0.0, 0.0, 1.0}; });
  motion.grab(false);
  play.go(3.0);
  motion.grab(true);
  play.go(3.3);
  EXPECT_FALSE(motion.is_held()) << "no pose of this hand has come";
  play.go(4.0, [](double) { return Vector3{0.5, 0.0, 0.0}; });
  EXPECT_LT(length(play.now().position - Vector3{0.5, 0.0, 0.0}), 0.01);
  EXPECT_LT(play.largest_step(), 0.005);
}

}  // namespace
}  // namespace splash::sim
