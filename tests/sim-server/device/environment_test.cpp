// SPDX-License-Identifier: MIT
// What the surroundings can do to the first OpenCL call. Each case in a process of its own: the
// loader and PoCL read the environment once.
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
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

// It is installed: to install it again would not help.
TEST_F(EnvironmentDeathTest, APlatformThatCannotBeLoadedIsNamedWithTheReason) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "splash-vendors-test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "torn.icd") << "libsplash-torn.so.9\n";
  EXPECT_EXIT(
      {
        setenv("OCL_ICD_VENDORS", folder.c_str(), 1);
        try_device();
      },
      ::testing::ExitedWithCode(kRefused),
      "no OpenCL platform found: .*torn.icd names a platform that cannot be loaded: "
      ".*libsplash-torn.so.9");
  std::filesystem::remove_all(folder);
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

/// Without a home: a folder among everybody's.
class TemporaryCacheDeathTest : public Environment {
 protected:
  TemporaryCacheDeathTest() { std::filesystem::create_directories(base_); }
  ~TemporaryCacheDeathTest() override { std::filesystem::remove_all(base_); }

  [[noreturn]] void prepare() const {
    for (const char* name : {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "HOME"}) unsetenv(name);
    setenv("TMPDIR", base_.c_str(), 1);
    try {
      const auto folder = prepare_kernel_cache();
      const auto mode = std::filesystem::status(folder).permissions();
      std::exit(folder == folder_ && mode == std::filesystem::perms::owner_all ? kAccepted : 1);
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
      std::exit(kRefused);
    }
  }

  // Of each test its own: they may run beside each other.
  std::filesystem::path base_ = std::filesystem::path(::testing::TempDir()) /
                                (std::string("splash-no-home-") +
                                 ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::filesystem::path folder_ = base_ / ("splash-cache-" + std::to_string(geteuid()));
};

TEST_F(TemporaryCacheDeathTest, IsThisUsersOwn) {
  EXPECT_EXIT(prepare(), ::testing::ExitedWithCode(kAccepted), "");
}

// What is loaded from there runs as this user.
TEST_F(TemporaryCacheDeathTest, IsRefusedWhereOthersMayWrite) {
  const std::string words = "is not a folder that this user alone may write to.*POCL_CACHE_DIR";
  std::filesystem::create_directory(folder_);
  std::filesystem::permissions(folder_, std::filesystem::perms::all);
  EXPECT_EXIT(prepare(), ::testing::ExitedWithCode(kRefused), words);
  std::filesystem::remove(folder_);
  std::filesystem::create_directory(base_ / "elsewhere");
  std::filesystem::create_directory_symlink(base_ / "elsewhere", folder_);
  EXPECT_EXIT(prepare(), ::testing::ExitedWithCode(kRefused), words);
}

TEST_F(TemporaryCacheDeathTest, IsRefusedWhereItIsAnothersFolder) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  std::filesystem::create_directory(folder_);
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
  ASSERT_EQ(chown(folder_.c_str(), 65534, 65534), 0);
  EXPECT_EXIT(prepare(), ::testing::ExitedWithCode(kRefused), "this user alone may write to");
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
