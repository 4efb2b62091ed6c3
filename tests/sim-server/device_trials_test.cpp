// SPDX-License-Identifier: MIT
// What is made of a device's test, however it ends; scripts stand in for the program that does it.
#include "sim-server/start/device_trials.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class DeviceTrial : public testing::Test {
 protected:
  /// By a program that does this. Each run of it leaves a dot in `runs`.
  [[nodiscard]] Trial test(const std::string& script, const TrialLimits& limits = {}) const {
    const fs::path program = folder_.write(
        "program", "#!/bin/sh\nprintf . >>" + (folder_ / "runs").string() + '\n' + script + '\n');
    fs::permissions(program, fs::perms::owner_all);
    return DeviceTrials(folder_.path(), program, limits)(device_);
  }
  [[nodiscard]] std::size_t runs() const {
    std::error_code none;
    const auto size = fs::file_size(folder_ / "runs", none);
    return none ? 0 : size;
  }

  tests::TemporaryFolder folder_;
  DeviceFacts device_ = [] {
    DeviceFacts facts;
    facts.index = 3;
    facts.name = "Abacus";
    facts.platform = "Wood";
    facts.driver = "1.5";
    return facts;
  }();
};

TEST_F(DeviceTrial, OfASoundDeviceSaysWhatAStepTakesAndIsRemembered) {
  const std::string script = "[ \"$*\" = '--check-device 3' ] && echo built && echo sound 0.0025";
  for (int k = 0; k < 2; ++k) {
    const Trial trial = test(script);
    EXPECT_THAT(trial.failure, IsEmpty());
    EXPECT_DOUBLE_EQ(trial.step, 0.0025);
  }
  EXPECT_EQ(runs(), 1U);
  device_.driver = "1.6";
  EXPECT_THAT(test(script).failure, IsEmpty());
  EXPECT_EQ(runs(), 2U) << "another driver may do otherwise";
}

TEST_F(DeviceTrial, OfABrokenOneSaysHowAndIsDoneAgain) {
  EXPECT_EQ(test("echo built; echo sim-server: it computes wrongly >&2; exit 69").failure,
            "it computes wrongly");
  EXPECT_EQ(test("echo 'sim-server: no kernels:'; echo line 7; exit 69").failure, "no kernels:");
  EXPECT_THAT(test("echo built; kill -SEGV $$").failure, HasSubstr("crashed (signal 11)"));
  EXPECT_THAT(test("echo built; echo sound 0.1; exit 3").failure, HasSubstr("sound 0.1"));
  EXPECT_THAT(test("exit 1").failure, HasSubstr("could not be run"));
  EXPECT_EQ(runs(), 5U);
}

// `exec`, or the script's own child holds the pipe open.
TEST_F(DeviceTrial, OfOneThatHangsEnds) {
  using std::chrono::milliseconds;
  const TrialLimits build = {.build = milliseconds(100)};
  EXPECT_THAT(test("exec sleep 1000", build).failure, HasSubstr("building a kernel did not end"));
  const TrialLimits steps = {.steps = milliseconds(100)};
  EXPECT_THAT(test("echo built; exec sleep 1000", steps).failure,
              HasSubstr("a small test did not end"));
}

TEST_F(DeviceTrial, WaitsAsLongAsKernelsGetReady) {
  const TrialLimits each = {.build = std::chrono::milliseconds(2000)};
  EXPECT_THAT(
      test("for k in 1 2 3 4; do sleep 0.7; echo $k; done; echo built; echo sound 1", each).failure,
      IsEmpty());
}

TEST_F(DeviceTrial, WithoutAProgramFails) {
  EXPECT_THAT(DeviceTrials(folder_.path(), folder_ / "none")(device_).failure,
              HasSubstr("could not be run"));
}

}  // namespace
}  // namespace splash::sim
