// SPDX-License-Identifier: MIT
// Which particles entrap air, against the brute-force double-precision reference, and how they
// remember it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim-server/detect/bubble_draw.hpp"
#include "sim-server/scene/rotation.hpp"
#include "tests/sim-server/detect/detect_reference.hpp"
#include "tests/sim-server/detect/detect_rig.hpp"
#include "tests/sim-server/fluid/situations.hpp"

namespace splash::sim {
namespace {

constexpr int kSeed = 5;
constexpr std::size_t kRoom = 2000;
constexpr double kFrame = 0.004;

DetectSettings settings() {
  return {.bubble_per_particle = true,
          .bubble_speed = 0.8,  // not its own square
          .bubble_gradient = 0.3,
          .bubbles_per_second = 1.0e6};
}

class SpawnBubbles : public ::testing::TestWithParam<int> {};

/// How near to a threshold float and double may disagree on its side.
constexpr double kMargin = 2.0e-5;

// Water of all kinds, with walls, slope, piston, bodies and bubbles around; velocities such that
// about half of the particles are fast enough.
TEST_P(SpawnBubbles, FromFastParticlesWithMostMatterAbove) {
  Device device(-1, false, GetParam());
  std::size_t spawned = 0;
  std::size_t doubtful = 0;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(1.1, 81);
    Bubbles bubbles(*water.fluid, detect_program(device), settings(), kSeed, kRoom);
    const auto places = as_floats(random_places(300, {0, 0, 0}, {0.4, 0.3, 0.3}, 82));
    fill_pool(bubbles, places);
    detect(water, bubbles, kFrame);
    const FluidState state = read_state(*water.fluid, water.piston.offset);
    std::set<int> found;
    for (const DetectedBubble& bubble : bubbles.collect(1.0, kFrame, 1)) {
      found.insert(bubble.particle);
    }
    for (std::size_t i = 0; i < state.id.size(); ++i) {
      const double speed = length(state.velocity[i]) / settings().bubble_speed;
      const ReferenceSum upward = reference_upward(state, places, state.position[i]);
      const double margin = kMargin * (1.0 + upward.scale);
      if (std::abs(upward.value - settings().bubble_gradient) < margin ||
          std::abs(speed - 1.0) < kMargin) {
        ++doubtful;
        continue;
      }
      const bool should = speed > 1.0 && upward.value > settings().bubble_gradient;
      ASSERT_EQ(found.count(state.id[i]) == 1, should)
          << "particle " << state.id[i] << " of speed " << speed << ", gradient " << upward.value;
      if (should) ++spawned;
    }
  }
  EXPECT_GT(spawned, 200U);
  EXPECT_LT(doubtful, 10U);
}

/// The gradient that the kernel keeps of a particle, seen by when its threshold was crossed: at
/// rest in between, from a place above all matter to one with matter above.
TEST_P(SpawnBubbles, AtTheMomentTheGradientCrossesTheThreshold) {
  Device device(-1, false, GetParam());
  int crossings = 0;
  double worst = 0.0;
  for (Water& water : situations()) {
    SCOPED_TRACE(water.name);
    water.start(device);
    water.stir(4.0, 83);
    DetectSettings always = settings();
    always.bubble_speed = 1.0e-3;
    Bubbles bubbles(*water.fluid, detect_program(device), always, kSeed, kRoom);
    detect(water, bubbles, kFrame);
    const FluidState before = read_state(*water.fluid, water.piston.offset);
    static_cast<void>(bubbles.collect(1.0, kFrame, 1));
    // The same particles change places with one another: each meets another gradient.
    Snapshot snapshot = water.fluid->snapshot();
    std::rotate(snapshot.id.begin(), snapshot.id.begin() + 7 % water.params.count,
                snapshot.id.end());
    water.fluid->restore(snapshot);
    detect(water, bubbles, kFrame);
    const FluidState after = read_state(*water.fluid, water.piston.offset);

    const auto upward_of = [](const FluidState& state) {
      std::map<int, double> upward;
      for (std::size_t i = 0; i < state.id.size(); ++i) {
        upward[state.id[i]] = reference_upward(state, {}, state.position[i]).value;
      }
      return upward;
    };
    std::map<int, double> last = upward_of(before);
    std::map<int, double> now = upward_of(after);
    for (const DetectedBubble& bubble : bubbles.collect(1.004, kFrame, 2)) {
      const double part = (always.bubble_gradient - last[bubble.particle]) /
                          (now[bubble.particle] - last[bubble.particle]);
      ASSERT_LT(last[bubble.particle], always.bubble_gradient + 1.0e-4);
      // Where the gradient hardly changes, the moment is not known well.
      const double known = 1.0e-4 / (now[bubble.particle] - last[bubble.particle]);
      ASSERT_NEAR(bubble.time, 1.004 - kFrame * (1.0 - part), kFrame * known);
      worst = std::max(worst, std::abs(bubble.time - 1.004 + kFrame * (1.0 - part)) / kFrame);
      ++crossings;
    }
  }
  std::printf("%d crossings, worst %.2e of a frame\n", crossings, worst);
  EXPECT_GT(crossings, 200);
}

INSTANTIATE_TEST_SUITE_P(Lanes, SpawnBubbles, kLaneCounts, lanes_name);

/// One particle led around a hanging block of water; the block itself is at rest.
class Memory : public ::testing::Test {
 protected:
  static constexpr Vector3 kBelow = {0.5, 0.5, kBlockBottom - 0.005};
  static constexpr Vector3 kSideways = {0.59, 0.5, 0.475};  // below the middle
  static constexpr Vector3 kAbove = {0.5, 0.5, kBlockTop + 0.005};
  static constexpr Vector3 kNowhere = {0.2, 0.2, 0.2};
  static constexpr Vector3 kFast = {1.0, 0.0, -2.0};
  static constexpr Vector3 kSlow = {0.1, 0.2, 0.0};

  Memory() : water_(hanging_block()), tracer_(static_cast<int>(water_.particles.size()) - 1) {
    water_.start(device_);
    bubbles_ =
        std::make_unique<Bubbles>(*water_.fluid, detect_program(device_), settings(), kSeed, kRoom);
  }

  /// Next frame, with the tracer there.
  std::vector<DetectedBubble> at(const Vector3& place, const Vector3& velocity) {
    change_particles(*water_.fluid, [&](int id, Vector3& x, Vector3& v) {
      if (id != tracer_) return;
      x = place;
      v = velocity;
    });
    detect(water_, *bubbles_, kFrame);
    ++step_;
    return bubbles_->collect(time(), kFrame, step_);
  }
  double time() const { return kFrame * step_; }

  /// Gradient at the tracer, as it is now.
  double upward() {
    const FluidState state = read_state(*water_.fluid);
    const auto found = std::find(state.id.begin(), state.id.end(), tracer_);
    const auto i = static_cast<std::size_t>(found - state.id.begin());
    return reference_upward(state, {}, state.position[i]).value;
  }

  /// In the next frame, where the line from the gradient `last` crosses the threshold.
  void expect_spawn_after(double last) {
    const auto found = at(kBelow, kFast);
    ASSERT_EQ(found.size(), 1U);
    const double part = (settings().bubble_gradient - last) / (upward() - last);
    EXPECT_NEAR(found[0].time, time() - kFrame * (1.0 - part), 1.0e-4 * kFrame);
  }

  Device device_;
  Water water_;
  int tracer_;
  std::unique_ptr<Bubbles> bubbles_;
  std::uint32_t step_ = 0;
};

TEST_F(Memory, SpawnsWhereTheParticleIsAsTheDrawsSay) {
  const auto found = at(kBelow, kFast);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].particle, tracer_);
  EXPECT_EQ(found[0].position, as_floats({kBelow}).front());
  const Draws draws = draw(kSeed, step_, static_cast<std::uint32_t>(tracer_));
  const DetectSettings s = settings();
  EXPECT_EQ(found[0].radius,
            power_law(draws.radius, s.radius_min, s.radius_max, s.radius_exponent));
  EXPECT_EQ(found[0].epsilon,
            power_law(draws.epsilon, s.epsilon_min, s.epsilon_max, s.epsilon_exponent));
}

// What is not known when it was first seen fast is spread over the frame, by a draw.
TEST_F(Memory, ComingFromSlownessTakesADrawnMoment) {
  EXPECT_TRUE(at(kBelow, kSlow).empty());
  const auto found = at(kBelow, kFast);
  ASSERT_EQ(found.size(), 1U);
  const double moment = draw(kSeed, step_, static_cast<std::uint32_t>(tracer_)).moment;
  EXPECT_DOUBLE_EQ(found[0].time, time() - kFrame * (1.0 - moment));
}

TEST_F(Memory, SpawnsOnce) {
  EXPECT_EQ(at(kBelow, kFast).size(), 1U);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(at(kBelow, kFast).empty());
}

TEST_F(Memory, AWeakerUpwardGradientDoesNotRearm) {
  EXPECT_EQ(at(kBelow, kFast).size(), 1U);
  EXPECT_TRUE(at(kSideways, kFast).empty());
  EXPECT_TRUE(at(kBelow, kFast).empty());
}

TEST_F(Memory, AnOppositeGradientRearms) {
  EXPECT_EQ(at(kBelow, kFast).size(), 1U);
  EXPECT_TRUE(at(kAbove, kFast).empty());
  expect_spawn_after(upward());
}

TEST_F(Memory, NoGradientAtAllRearms) {
  EXPECT_EQ(at(kBelow, kFast).size(), 1U);
  EXPECT_TRUE(at(kNowhere, kFast).empty());
  expect_spawn_after(0.0);
}

TEST_F(Memory, SlownessRearms) {
  EXPECT_EQ(at(kBelow, kFast).size(), 1U);
  EXPECT_TRUE(at(kBelow, kSlow).empty());
  EXPECT_EQ(at(kBelow, kFast).size(), 1U);
}

// One that never spawned and rises from a weak gradient crosses where the line between both does.
TEST_F(Memory, AWeakGradientIsRemembered) {
  EXPECT_TRUE(at(kSideways, kFast).empty());
  expect_spawn_after(upward());
}

}  // namespace
}  // namespace splash::sim
