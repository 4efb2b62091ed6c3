// SPDX-License-Identifier: MIT
// Tests S1 and S2: every fault is seen in its very step and nothing of it is told; each check of
// the guard misses its fault when it is switched off, so none is for show.
#include "tests/stress/faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace splash::stress {
namespace {

using sim::Fault;
using testing::HasSubstr;

/// Steps short enough that nothing jumps, however fast.
constexpr double kShort = 0.35;

class Faults : public testing::TestWithParam<Water> {
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

// Nothing but the walls keeps water in: without them it falls, slowly at first.
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
    put(broken);
    std::optional<sim::Mishap> mishap;
    for (int k = 0; k < 16 && !mishap; ++k) mishap = simulation_.advance().mishap;
    EXPECT_EQ(mishap.has_value(), looked_for);
    put(whole);
    if (!mishap) continue;
    EXPECT_EQ(mishap->what.fault, Fault::outside);
    EXPECT_THAT(describe(*mishap), HasSubstr("beyond the tank"));
    for (int k = 0; k < 3; ++k) static_cast<void>(simulation_.advance());
    EXPECT_FALSE(simulation_.advance().mishap) << "well again";
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
    ASSERT_TRUE(frame.mishap);
    EXPECT_TRUE(frame.found.impacts.empty() && frame.found.bubbles.empty());
    remedies.push_back(frame.mishap->remedy);
    EXPECT_EQ(frame.mishap->tries, 4);
  }
  using sim::Remedy;
  EXPECT_THAT(remedies, testing::ElementsAre(Remedy::calm, Remedy::calm, Remedy::reset,
                                             Remedy::calm, Remedy::calm, Remedy::reset));
  simulation_.set_hook({});
  EXPECT_FALSE(simulation_.advance().mishap);
  EXPECT_EQ(simulation_.totals().resets, 2U);
  EXPECT_EQ(simulation_.totals().calmed, 4U);
}

INSTANTIATE_TEST_SUITE_P(Waters, Faults, testing::ValuesIn(all_waters()),
                         [](const auto& water) { return name_of(water.param); });

}  // namespace
}  // namespace splash::stress
