// SPDX-License-Identifier: MIT
// Frames to viewers: as many as they ask for, however slow they are, and while the process has no
// file descriptor left.
#include "protocol/frame_stream.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "protocol/time_tag.hpp"
#include "tests/support/frame_viewer.hpp"
#include "tests/support/waiting.hpp"

namespace splash::protocol::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::eventually;
using tests::FrameViewer;

ViewFrame numbered(std::uint32_t number, std::size_t more = 0) {
  FrameWriter writer(kStateFrame, 0.5);
  writer.put(number);
  for (std::size_t i = 0; i < more; ++i) writer.put(std::uint8_t{7});
  return std::move(writer).take();
}

TEST(FrameWriter, WritesLittleEndianWhateverTheMachine) {
  FrameWriter writer("ABCD", 1.5);
  writer.put(std::uint16_t{0x0102});
  writer.put(-2.0F);
  writer.put(std::uint8_t{9});
  const ViewFrame frame = std::move(writer).take();
  std::vector<int> bytes;
  for (const std::byte b : frame) bytes.push_back(std::to_integer<int>(b));
  EXPECT_THAT(bytes, ElementsAre('A', 'B', 'C', 'D', 23, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f, 2,
                                 1, 0, 0, 0, 0xc0, 9));
  EXPECT_EQ(frame_number<double>(&frame[8]), 1.5);
  EXPECT_EQ(frame_number<float>(&frame[18]), -2.0F);
  EXPECT_EQ(frame_kind(frame.data()), "ABCD");
}

TEST(FrameStream, ShowsAFrameForEachThatWasAskedFor) {
  FrameStream stream({}, numbered(0));
  EXPECT_FALSE(stream.wanted());
  stream.offer(numbered(1));  // nobody is there
  const FrameViewer viewer(stream.local());
  EXPECT_EQ(viewer.read(), numbered(0));
  EXPECT_FALSE(stream.wanted());
  viewer.ask();
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  stream.offer(numbered(2));
  EXPECT_FALSE(stream.wanted());
  stream.offer(numbered(3));  // was not asked for
  EXPECT_EQ(viewer.read(), numbered(2));
  EXPECT_FALSE(viewer.has_more());
  viewer.ask();
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  stream.offer(numbered(4));
  EXPECT_EQ(viewer.read(), numbered(4));
}

TEST(FrameStream, AViewerThatNeverReadsGetsOneFrameAtATime) {
  constexpr std::size_t kLarge = 4U << 20U;
  FrameStream stream({}, numbered(0));
  const FrameViewer deaf(stream.local(), 4096);
  deaf.ask(1000);
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  stream.offer(numbered(1, kLarge));
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(stream.wanted()) << "a second frame would wait in memory";
    stream.offer(numbered(2, kLarge));
    deaf.ask();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const FrameViewer other(stream.local());
  EXPECT_EQ(other.read(), numbered(0));
  other.ask();
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  stream.offer(numbered(3));
  EXPECT_EQ(other.read(), numbered(3)) << "one that does not read holds up nobody";
}

TEST(FrameStream, AsksAreKeptThatComeBeforeTheGreetingIsRead) {
  FrameStream stream({}, numbered(0, 8U << 20U));
  const FrameViewer viewer(stream.local(), 4096);
  viewer.ask();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(stream.wanted());
  EXPECT_EQ(viewer.read(), numbered(0, 8U << 20U));
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
}

TEST(FrameStream, ViewersComeAndGo) {
  FrameStream stream({}, numbered(0));
  for (int i = 0; i < 20; ++i) {
    const FrameViewer viewer(stream.local());
    EXPECT_EQ(viewer.read(), numbered(0));
    viewer.ask();
    ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  }
  EXPECT_TRUE(eventually([&] { return stream.viewers() == 0 && !stream.wanted(); }));
}

TEST(FrameStream, NoMoreViewersThanTheLimit) {
  FrameStream stream({}, numbered(0));
  std::vector<std::unique_ptr<FrameViewer>> viewers;
  for (std::size_t i = 0; i < FrameStream::kViewersMax; ++i) {
    viewers.push_back(std::make_unique<FrameViewer>(stream.local()));
    EXPECT_EQ(viewers.back()->read(), numbered(0));
  }
  const FrameViewer late(stream.local());
  ASSERT_TRUE(late.has_more(5000)) << "it is closed";
  EXPECT_EQ(stream.viewers(), FrameStream::kViewersMax);
}

TEST(FrameStream, ATakenPortIsAnErrorThatHelps) {
  const FrameStream holder({}, numbered(0));
  EXPECT_THAT(
      [&] { const FrameStream second({.listen = holder.local(), .allowed = {}}, numbered(0)); },
      testing::ThrowsMessage<std::runtime_error>(testing::AllOf(
          HasSubstr("--show host:port"), HasSubstr(std::to_string(holder.local().port)))));
}

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
