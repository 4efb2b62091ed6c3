// SPDX-License-Identifier: MIT
// What the surroundings can do to the first OpenCL call. Each case in a process of its own: the
// loader and PoCL read the environment once.
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

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

/// Whether all threads of this process may run on `core` and on no other.
bool all_keep_to(int core) {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    cpu_set_t allowed;
    const int thread = std::stoi(task.path().filename());
    if (sched_getaffinity(thread, sizeof allowed, &allowed) != 0) return false;
    if (CPU_COUNT(&allowed) != 1 || !CPU_ISSET(core, &allowed)) return false;
  }
  return true;
}

TEST_F(EnvironmentDeathTest, WorkersKeepToTheCoresThatTheProcessWasGiven) {
  const int last = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)) - 1;
  if (last < 1) GTEST_SKIP() << "one core only";
  EXPECT_EXIT(
      {
        unsetenv("POCL_AFFINITY");
        cpu_set_t given;
        CPU_ZERO(&given);
        CPU_SET(last, &given);
        sched_setaffinity(0, sizeof given, &given);
        const Device device;
        std::exit(all_keep_to(last) ? kAccepted : kRefused);
      },
      ::testing::ExitedWithCode(kAccepted), "");
}

}  // namespace
}  // namespace splash::sim
