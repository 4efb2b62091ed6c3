// SPDX-License-Identifier: MIT
// What is done about faults, one after the other, and how it is told.
#include "sim-server/simulation/recovery/recovery.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace splash::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Recovery, HalvesTheStepThreeTimesThenGivesUp) {
  Recovery recovery;
  for (const double share : {0.5, 0.25, 0.125}) {
    EXPECT_EQ(recovery.failed(), Remedy::retry);
    EXPECT_EQ(recovery.step_share(), share);
  }
  EXPECT_EQ(recovery.failed(), Remedy::calm);
  EXPECT_EQ(recovery.step_share(), 0.125) << "no step is shorter";
  EXPECT_EQ(recovery.given_up(), 1);
}

TEST(Recovery, TheThirdFrameGivenUpInARowResets) {
  Recovery recovery;
  const auto give_up = [&] {
    for (int k = 0; k < Recovery::kTries; ++k) EXPECT_EQ(recovery.failed(), Remedy::retry);
    return recovery.failed();
  };
  EXPECT_EQ(give_up(), Remedy::calm);
  EXPECT_EQ(give_up(), Remedy::calm);
  recovery.succeeded();
  EXPECT_EQ(give_up(), Remedy::calm) << "a sound frame begins the count anew";
  EXPECT_EQ(give_up(), Remedy::calm);
  EXPECT_EQ(give_up(), Remedy::reset);
}

TEST(Recovery, StepsGrowBackToWhatTheyWere) {
  Recovery recovery;
  static_cast<void>(recovery.failed());
  int frames = 0;
  while (recovery.step_share() < 1.0 && frames < 1000) {
    recovery.succeeded();
    ++frames;
  }
  EXPECT_EQ(recovery.step_share(), 1.0);
  EXPECT_GE(frames, 5);
  EXPECT_LE(frames, 20);
}

TEST(StepFaults, AreToldWithParticlePlaceStepAndCause) {
  StepFault step_fault;
  step_fault.what = {Fault::not_finite, 1, 3, 4711};
  step_fault.step = 815;
  step_fault.seconds = 2.5;
  step_fault.place = {0.1, -0.2, 0.3};
  step_fault.body = "hand";
  step_fault.distance = 0.07;
  step_fault.tries = 1;
  const std::string text = describe(step_fault);
  for (const char* part : {"2.500 s", "step 815", "particle 4711", "(0.100, -0.200, 0.300)",
                           "'hand'", "0.07 m", "no number", "3 particles", "Likely cause"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  step_fault.remedy = Remedy::calm;
  step_fault.calmed = 0.28;
  EXPECT_THAT(describe(step_fault), HasSubstr("within 0.28 m"));
  step_fault.calmed = std::numeric_limits<double>::infinity();
  EXPECT_THAT(describe(step_fault), HasSubstr("all water was stopped"));
  step_fault.remedy = Remedy::reset;
  EXPECT_THAT(describe(step_fault), HasSubstr("begins anew"));
  step_fault.what = {Fault::step, 0, 0, -1};
  EXPECT_THAT(describe(step_fault), Not(HasSubstr("particle -1")));
}

}  // namespace
}  // namespace splash::sim
