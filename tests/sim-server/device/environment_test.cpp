// SPDX-License-Identifier: MIT
// What the surroundings can do to the first OpenCL call. Each case in a process of its own: the
// loader and PoCL read the environment once.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "sim-server/device/cache.hpp"
#include "sim-server/device/device.hpp"

namespace splash::sim {
namespace {

constexpr int kRefused = 7;
constexpr int kAccepted = 8;

[[noreturn]] void try_device() {
  try {
    const Device device;
    std::cerr << "runs on " << device.facts().name << '\n';
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    std::exit(kRefused);
  }
  std::exit(kAccepted);
}

class Environment : public ::testing::Test {
 protected:
  Environment() { ::testing::GTEST_FLAG(death_test_style) = "threadsafe"; }
};
using EnvironmentDeathTest = Environment;

TEST_F(EnvironmentDeathTest, AnUnwritableCacheIsNamed) {
  EXPECT_EXIT(
      {
        // Below a file there is no folder, not even for root.
        setenv("POCL_CACHE_DIR", "/dev/null/kernels", 1);
        try_device();
      },
      ::testing::ExitedWithCode(kRefused),
      "compiled kernels, /dev/null/kernels, cannot be written: Not a directory; .*POCL_CACHE_DIR");
}

TEST_F(EnvironmentDeathTest, NoPlatformNamesThePackage) {
  EXPECT_EXIT(
      {
        setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
        try_device();
      },
      ::testing::ExitedWithCode(kRefused),
      "no OpenCL platform found in /nonexistent.*apt install pocl-opencl-icd");
}

TEST_F(EnvironmentDeathTest, ASlowSettingIsSaidAndIgnored) {
  EXPECT_EXIT(
      {
        setenv("POCL_WORK_GROUP_METHOD", "loops", 1);
        refuse_slow_settings();
        std::exit(std::getenv("POCL_WORK_GROUP_METHOD") == nullptr ? kAccepted : kRefused);
      },
      ::testing::ExitedWithCode(kAccepted), "POCL_WORK_GROUP_METHOD is set and ignored");
}

TEST_F(EnvironmentDeathTest, TheCacheFollowsTheUsersFolders) {
  const auto base = std::filesystem::path(::testing::TempDir()) / "splash-cache-test";
  EXPECT_EXIT(
      {
        unsetenv("POCL_CACHE_DIR");
        setenv("XDG_CACHE_HOME", base.c_str(), 1);
        const auto folder = prepare_kernel_cache();
        const bool right = folder == base / "splash" && std::filesystem::is_directory(folder) &&
                           std::filesystem::exists(folder / "splash-lock") &&
                           std::getenv("POCL_CACHE_DIR") == folder.string();
        std::exit(right ? kAccepted : kRefused);
      },
      ::testing::ExitedWithCode(kAccepted), "");
  std::filesystem::remove_all(base);
}

}  // namespace
}  // namespace splash::sim
