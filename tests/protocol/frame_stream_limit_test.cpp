// SPDX-License-Identifier: MIT
// A stream of frames while the process has no file descriptor left.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <optional>
#include <thread>
#include <vector>

#include "protocol/frame_stream.hpp"
#include "tests/support/frame_viewer.hpp"

namespace splash::protocol::test {
namespace {

using testing::HasSubstr;

/// User and system time of all threads so far [s].
double processor_time() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

/// All descriptors that the process may still open, but for `spare`.
class NoDescriptors {
 public:
  explicit NoDescriptors(std::size_t spare) {
    getrlimit(RLIMIT_NOFILE, &before_);
    rlimit few = before_;
    few.rlim_cur = 64;
    setrlimit(RLIMIT_NOFILE, &few);
    for (int one = open_one(); one >= 0; one = open_one()) taken_.push_back(one);
    for (; spare > 0; --spare) give_back_one();
  }
  ~NoDescriptors() {
    while (!taken_.empty()) give_back_one();
    setrlimit(RLIMIT_NOFILE, &before_);
  }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;

 private:
  static int open_one() { return open("/dev/null", O_RDONLY | O_CLOEXEC); }
  void give_back_one() {
    close(taken_.back());
    taken_.pop_back();
  }
  rlimit before_{};
  std::vector<int> taken_;
};

TEST(FrameStreamWithoutDescriptors, PausesSaysSoOnceAndLetsTheViewerInLater) {
  const ViewFrame greeting = FrameWriter(kStateFrame, 0.5).take();
  FrameStream stream({}, greeting);
  testing::internal::CaptureStderr();
  std::optional<NoDescriptors> none(1);
  const tests::FrameViewer viewer(stream.local());  // takes the last one
  const double before = processor_time();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_LT(processor_time() - before, 0.05) << "it asks the kernel without a pause";
  EXPECT_FALSE(viewer.has_more(0));
  EXPECT_EQ(stream.viewers(), 0U);
  none.reset();
  EXPECT_EQ(viewer.read(), greeting);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("LimitNOFILE"));
  EXPECT_EQ(said.find("a viewer waits"), said.rfind("a viewer waits")) << said;
}

}  // namespace
}  // namespace splash::protocol::test
