// SPDX-License-Identifier: MIT
// sim-server on a machine with two devices, of which one passes for a GPU (opencl_shim.cpp), sound
// or broken in several ways.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/small_scene.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class DeviceChoice : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers want to be loaded first";
#endif
    fs::remove(remembered_);
  }

  /// The device "basic" of two, which goes wrong that `way`.
  [[nodiscard]] Ended simulate(const std::string& way, const Arguments& more = {},
                               const std::string& wish = "") const {
    ChildProcess::Environment environment{
        {"POCL_CACHE_DIR", cache_.string()},
        {"POCL_DEVICES", "basic pthread"},
        {"LD_PRELOAD", std::string(SPLASH_BINARY_DIR) + "/libopencl_shim.so"},
        {"SPLASH_SHIM_DEVICE", "basic"},
        {"SPLASH_SHIM", way}};
    if (!wish.empty()) environment.emplace_back("SPLASH_DEVICE", wish);
    return tests::simulate(scene_.path(), 0.1, more, environment);
  }
  [[nodiscard]] std::string remembered() const {
    return text_of(remembered_);
  }

  /// The grid's kernels, in the form for GPUs, take PoCL's compiler half a minute.
  SmallScene scene_{plunging(), 1, "weakly_compressible"};
  /// Kept for the next test: kernels take long to compile.
  fs::path cache_ = fs::path(SPLASH_BINARY_DIR).parent_path() / "device-choice-cache";
  fs::path remembered_ = cache_ / "splash-devices";
};

// One run on each, and how to ask for the other.
TEST_F(DeviceChoice, AGpuThatStandsItsTestIsTaken) {
  const auto [code, text] = simulate("sound");
  EXPECT_EQ(code, 0) << text;
  EXPECT_THAT(text, ContainsRegex("device  0: basic.*GPU.*: a GPU comes before others"));
  EXPECT_THAT(text, Not(HasSubstr("passed over")));
  const std::string once = remembered();
  EXPECT_THAT(once, HasSubstr("basic"));
  EXPECT_THAT(simulate("sound").text, HasSubstr("a GPU comes before others"));
  EXPECT_EQ(remembered(), once) << "it was tested again";
  EXPECT_THAT(simulate("sound", {"--device", "pthread"}).text,
              ContainsRegex("device  1: pthread.*CPU.*: asked for"));
  EXPECT_THAT(simulate("sound", {}, "cpu").text,
              ContainsRegex("device  1: pthread.*CPU.*: asked for"));
  EXPECT_THAT(simulate("sound", {"--device", "0"}, "cpu").text,
              ContainsRegex("device  0: basic.*: asked for"));
}

TEST_F(DeviceChoice, TheListIsOfThoseMeant) {
  const auto list = [this](const Arguments& more) {
    Arguments arguments{"--list-devices"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return simulate("sound", arguments).text;
  };
  EXPECT_THAT(list({}), AllOf(HasSubstr("0: basic"), HasSubstr("1: pthread")));
  EXPECT_THAT(list({"--device", "cpu"}), AllOf(Not(HasSubstr("basic")), HasSubstr("1: pthread")));
  EXPECT_THAT(list({"--device", "gpu"}), AllOf(HasSubstr("0: basic"), Not(HasSubstr("pthread"))));
}

struct Broken {
  const char* way;
  const char* said;
};

class BrokenDevice : public DeviceChoice, public testing::WithParamInterface<Broken> {};

TEST_P(BrokenDevice, IsNamedAndPassedOver) {
  const auto [code, text] = simulate(GetParam().way);
  EXPECT_EQ(code, 0) << text;
  EXPECT_THAT(text,
              ContainsRegex("device 0: basic.* is passed over: .*" + std::string(GetParam().said)));
  EXPECT_THAT(text, ContainsRegex("device  1: pthread.*CPU.*: no other is left"));
  EXPECT_THAT(text, HasSubstr("running"));
  EXPECT_EQ(remembered(), "");
}

INSTANTIATE_TEST_SUITE_P(Ways, BrokenDevice,
                         testing::Values(Broken{"build", "do not build on basic"},
                                         Broken{"wrong", "it computes wrongly"},
                                         Broken{"hang", "it hangs"},
                                         Broken{"crash", "its driver crashed"}),
                         [](const auto& way) { return way.param.way; });

TEST_F(DeviceChoice, OneThatDoesNotTellWhatItIsIsLeftOut) {
  const auto [code, text] = simulate("mute");
  EXPECT_EQ(code, 0) << text;
  EXPECT_THAT(text, AllOf(HasSubstr("does not tell what it is and is left out"),
                          ContainsRegex("device  0: pthread.*: the only device")));
}

// Whoever asks for a device gets that one or none.
TEST_F(DeviceChoice, ABrokenOneThatWasAskedForEndsTheProgram) {
  const auto [code, text] = simulate("build", {"--device", "basic"});
  EXPECT_EQ(code, 69);
  EXPECT_THAT(text, HasSubstr("do not build on basic"));
}

}  // namespace
}  // namespace splash::tests
