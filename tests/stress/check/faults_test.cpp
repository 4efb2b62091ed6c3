// SPDX-License-Identifier: MIT
// Tests S1 and S2: every fault is seen in its very step and nothing of it is told; each check of
// the guard misses its fault when it is switched off, so none is for show.
#include "tests/stress/faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace splash::stress {
namespace {

using sim::Fault;
using testing::HasSubstr;

/// Steps short enough that nothing jumps, however fast.
constexpr double kShort = 0.35;

class Faults : public testing::TestWithParam<sim::PressureKind> {
 protected:
  sim::Device device_;
  sim::Simulation simulation_{device_, still_scene(GetParam(), kShort), {}};
};

TEST_P(Faults, AreSeenInTheirVeryStepAndNeverTold) {
  constexpr int kPlaces = 10;
  const auto outcomes = run_faults(simulation_, injections(), kPlaces, 2026);
  ASSERT_EQ(outcomes.size(), static_cast<std::size_t>(kPlaces) * injections().size());
  for (const Outcome& outcome : outcomes) {
    EXPECT_TRUE(outcome.passes()) << outcome.fault << " at " << outcome.place << ": seen "
                                  << outcome.seen << ", told " << outcome.told << ", ill for "
                                  << outcome.ill_for << " s, finite " << outcome.finite << ": "
                                  << outcome.sentence;
  }
}

TEST_P(Faults, PassUnseenWhereTheirCheckIsOff) {
  const sim::Snapshot calm = simulation_.fluid().snapshot();
  for (const Single& single : single_faults()) {
    for (const bool looked_for : {true, false}) {
      simulation_.fluid().restore(calm);  // what went unseen has done its harm
      simulation_.fluid().health().set_checks(looked_for ? sim::kAllFaults
                                                         : sim::without(single.fault));
      for (const Outcome& outcome : run_faults(simulation_, {single.injection}, 3, 7)) {
        EXPECT_EQ(outcome.seen, looked_for) << outcome.fault << ' ' << outcome.sentence;
      }
    }
  }
}

/// The water with one of its particles above the tank and the grid, on its way to a wall.
sim::Snapshot with_a_drop(sim::Fluid& fluid) {
  sim::Snapshot water = fluid.snapshot();
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  const std::array<float, 3> place = {0.06F, 0.12F, 1.2F};    // [m]
  const std::array<float, 3> velocity = {-1.5F, 0.0F, 0.0F};  // [m/s]
  for (std::size_t axis = 0; axis < 3; ++axis) {
    water.position[axis * stride] = place.at(axis);
    water.velocity[axis * stride] = velocity.at(axis);
  }
  return water;
}

// Nothing but the walls keeps a drop in that is above the tank. What is lower, the faces of the
// grid keep in, too, where the solver has one.
TEST_P(Faults, WaterThatLeavesTheTankIsSeenByNothingElse) {
  const sim::FluidParams whole = simulation_.fluid().params();
  sim::FluidParams broken = whole;
  broken.wall_count = 0;
  const auto put = [&](const sim::FluidParams& params) {
    simulation_.fluid().device().queue().enqueueWriteBuffer(
        simulation_.fluid().params_buffer().memory(), CL_TRUE, 0, sizeof params, &params);
  };
  for (const bool looked_for : {true, false}) {
    if (!looked_for) simulation_.fluid().health().set_checks(sim::without(Fault::outside));
    simulation_.fluid().restore(with_a_drop(simulation_.fluid()));
    put(broken);
    std::optional<sim::StepFault> step_fault;
    for (int k = 0; k < 16 && !step_fault; ++k) step_fault = simulation_.advance().step_fault;
    EXPECT_EQ(step_fault.has_value(), looked_for);
    put(whole);
    if (!step_fault) continue;
    EXPECT_EQ(step_fault->what.fault, Fault::outside);
    EXPECT_THAT(describe(*step_fault), HasSubstr("beyond the tank"));
    for (int k = 0; k < 3; ++k) static_cast<void>(simulation_.advance());
    EXPECT_FALSE(simulation_.advance().step_fault) << "well again";
  }
}

TEST_P(Faults, ThatStayAreGivenUpOnAndEndWithAReset) {
  const Injection harm = injections().front();
  simulation_.set_hook([&](sim::Fluid& fluid, sim::Step& step, sim::Moment moment) {
    if (moment == harm.moment) harm.harm(fluid, step, 123);
  });
  std::vector<sim::Remedy> remedies;
  for (int k = 0; k < 6; ++k) {
    const sim::FrameResult frame = simulation_.advance();
    ASSERT_TRUE(frame.step_fault);
    EXPECT_TRUE(frame.found.impacts.empty() && frame.found.bubbles.empty());
    remedies.push_back(frame.step_fault->remedy);
    EXPECT_EQ(frame.step_fault->tries, 4);
  }
  using sim::Remedy;
  EXPECT_THAT(remedies, testing::ElementsAre(Remedy::calm, Remedy::calm, Remedy::reset,
                                             Remedy::calm, Remedy::calm, Remedy::reset));
  simulation_.set_hook({});
  EXPECT_FALSE(simulation_.advance().step_fault);
  EXPECT_EQ(simulation_.totals().resets, 2U);
  EXPECT_EQ(simulation_.totals().calmed, 4U);
}

/// Speeds along x of the particles nearer to a place than `reach`, and of the others [m/s].
struct Speeds {
  std::set<float> near;
  std::set<float> far;
};

Speeds speeds_around(const sim::Fluid& fluid, const sim::Snapshot& state, const sim::Vector3& place,
                     double reach) {
  Speeds speeds;
  const auto stride = static_cast<std::size_t>(fluid.params().capacity);
  for (std::size_t i = 0; i < state.id.size(); ++i) {
    const auto off = [&](std::size_t axis) {
      return static_cast<double>(state.position[axis * stride + i]) - place.at(axis);
    };
    const bool near = std::hypot(off(0), off(1), off(2)) <= reach;
    (near ? speeds.near : speeds.far).insert(state.velocity[i]);
  }
  return speeds;
}

TEST_P(Faults, ThatStayStopTheWaterAroundThemAndAtLastTakeItToItsBeginning) {
  sim::Scene scene = still_scene(GetParam(), kShort);
  scene.tank.upper[0] = scene.water.front().upper[0] = 1.2;
  sim::Simulation channel(device_, scene, {});
  const sim::Snapshot first = channel.fluid().snapshot();
  const std::size_t count = first.id.size();
  sim::Snapshot drifting = first;
  std::fill(drifting.velocity.begin(), drifting.velocity.end(), 0.0F);
  std::fill_n(drifting.velocity.begin(), count, 0.25F);
  channel.resume(drifting, 0.0);
  const std::vector<Single> all = single_faults();
  const auto stray = std::find_if(all.begin(), all.end(), [](const Single& one) {
    return one.fault == Fault::stray;  // of one particle alone
  });
  const Injection& harm = stray->injection;
  channel.set_hook([&](sim::Fluid& fluid, sim::Step& step, sim::Moment moment) {
    if (moment == harm.moment) harm.harm(fluid, step, 123);
  });
  const sim::FrameResult frame = channel.advance();
  ASSERT_TRUE(frame.step_fault);
  const Speeds speeds = speeds_around(channel.fluid(), channel.fluid().snapshot(),
                                      frame.step_fault->place, frame.step_fault->calmed);
  EXPECT_THAT(speeds.near, testing::ElementsAre(0.0F));
  EXPECT_THAT(speeds.far, testing::ElementsAre(0.25F)) << "what is far away goes on";
  for (int k = 0; k < 2; ++k) static_cast<void>(channel.advance());
  EXPECT_EQ(channel.totals().resets, 1U);
  const sim::Snapshot anew = channel.fluid().snapshot();
  EXPECT_EQ(anew.id, first.id);
  const auto of_water = [count](const std::vector<float>& numbers) {
    return std::vector<float>(numbers.begin(),
                              numbers.begin() + static_cast<std::ptrdiff_t>(count));
  };
  EXPECT_EQ(of_water(anew.position), of_water(first.position));
  EXPECT_EQ(of_water(anew.velocity), of_water(first.velocity));
}

INSTANTIATE_TEST_SUITE_P(Waters, Faults, testing::ValuesIn(kBothSolvers),
                         [](const auto& solver) { return sim::name_of(solver.param); });

}  // namespace
}  // namespace splash::stress
