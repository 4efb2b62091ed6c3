// SPDX-License-Identifier: MIT
// OpenCL's numbers in words, and what is said when it ends the program.
#include "sim-server/device/device_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <memory>

#include "sim-server/device/device.hpp"
#include "sim-server/device/last_words.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(OpenClErrors, AreToldInWords) {
  EXPECT_THAT([] { naming_opencl_errors([] { throw cl::Error(-4, "clFinish"); }); },
              ThrowsMessage<DeviceError>(
                  AllOf(HasSubstr("clFinish failed: CL_MEM_OBJECT_ALLOCATION_FAILURE (-4)"),
                        HasSubstr("lower the scene's particles"), HasSubstr("--list-devices"))));
  EXPECT_THAT(opencl_error_text("clCreateKernel", -46), HasSubstr("start again"));
  EXPECT_THAT(opencl_error_text("clSetKernelArg", -51), HasSubstr("a fault of sim-server"));
  EXPECT_THAT(opencl_error_text("clFinish", -36), HasSubstr("the device was lost"));
  EXPECT_THAT(opencl_error_text("clFinish", -12345), HasSubstr("error (-12345); the device"));
}

// NVIDIA says so of every kernel that reads beyond its memory or is stopped by a watchdog.
TEST(OpenClErrors, OutOfResourcesMeansMemoryOnlyWhereMemoryIsAskedFor) {
  for (const char* call : {"clCreateBuffer", "clCreateCommandQueue", "clEnqueueFillBuffer"}) {
    EXPECT_THAT(opencl_error_text(call, -5), HasSubstr("lower the scene's particles")) << call;
  }
  for (const char* call : {"clFinish", "clEnqueueNDRangeKernel", "clEnqueueReadBuffer"}) {
    EXPECT_THAT(opencl_error_text(call, -5), HasSubstr("the device was lost")) << call;
  }
}

TEST(OpenClErrors, NameWhatIsOurOwnFault) {
  for (const int error : {-30, -52, -54, -55, -63}) {
    EXPECT_THAT(opencl_error_text("clEnqueueNDRangeKernel", error),
                AllOf(HasSubstr("CL_INVALID_"), HasSubstr("a fault of sim-server")));
  }
}

TEST(OpenClErrors, LeaveOthersAlone) {
  EXPECT_EQ(naming_opencl_errors([] { return 7; }), 7);
  EXPECT_THROW(naming_opencl_errors([] { throw std::invalid_argument("x"); }),
               std::invalid_argument);
}

class LastWordsDeathTest : public ::testing::Test {
 protected:
  LastWordsDeathTest() { ::testing::GTEST_FLAG(death_test_style) = "threadsafe"; }
};

constexpr const char* kSaid = "OpenCL ended the program.*/tmp.*POCL_CACHE_DIR.*--list-devices";

TEST_F(LastWordsDeathTest, AreSaidWhenACompilerExits) {
  EXPECT_EXIT(
      {
        LastWords words("/tmp", 69);
        words.built();
        std::exit(1);
      },
      ::testing::ExitedWithCode(69), kSaid);
}

TEST_F(LastWordsDeathTest, AreNotSaidAfterwards) {
  EXPECT_EXIT(
      {
        std::make_unique<LastWords>("/tmp", 69).reset();
        std::exit(3);
      },
      ::testing::ExitedWithCode(3), "^$");
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitizerTakesCrashes = true;
#else
constexpr bool kSanitizerTakesCrashes = false;
#endif

TEST_F(LastWordsDeathTest, AreSaidWhenACompilerCrashes) {
  if (kSanitizerTakesCrashes) GTEST_SKIP() << "a crash is the sanitizer's to report here";
  for (const int crash : {SIGSEGV, SIGABRT, SIGBUS}) {
    EXPECT_EXIT(
        {
          const LastWords words("/tmp", 69);
          std::raise(crash);
        },
        ::testing::ExitedWithCode(69), kSaid);
  }
}

TEST_F(LastWordsDeathTest, LeaveLaterCrashesAsTheyAre) {
  if (kSanitizerTakesCrashes) GTEST_SKIP() << "a crash is the sanitizer's to report here";
  EXPECT_EXIT(
      {
        LastWords words("/tmp", 69);
        words.built();
        std::raise(SIGSEGV);
      },
      ::testing::KilledBySignal(SIGSEGV), "");
}

}  // namespace
}  // namespace splash::sim
