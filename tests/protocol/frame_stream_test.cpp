// SPDX-License-Identifier: MIT
#include "protocol/frame_stream.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "protocol/time_tag.hpp"

namespace splash::protocol::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kPatience = 5.0;  // [s]

bool eventually(const std::function<bool()>& condition) {
  const double end = monotonic_now() + kPatience;
  while (!condition()) {
    if (monotonic_now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

ViewFrame numbered(std::uint32_t number, std::size_t more = 0) {
  FrameWriter writer(kStateFrame, 0.5);
  writer.put(number);
  for (std::size_t i = 0; i < more; ++i) writer.put(std::uint8_t{7});
  return std::move(writer).take();
}

class Viewer {
 public:
  explicit Viewer(const Endpoint& where, int receive_buffer = 0)
      : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(where.address);
    address.sin_port = htons(where.port);
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~Viewer() { close(descriptor_); }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  void ask(std::size_t times = 1) const {
    const std::string bytes(times, '.');
    EXPECT_EQ(send(descriptor_, bytes.data(), times, MSG_NOSIGNAL), static_cast<ssize_t>(times));
  }
  [[nodiscard]] bool has_more(int milliseconds = 100) const {
    pollfd readable{descriptor_, POLLIN, 0};
    return poll(&readable, 1, milliseconds) > 0;
  }
  [[nodiscard]] ViewFrame read() const {
    ViewFrame frame(kFrameHead);
    take(frame.data(), frame.size());
    const auto size = frame_number<std::uint32_t>(&frame[4]);
    if (size < kFrameHead || size > (1U << 24U)) return {};
    frame.resize(size);
    take(frame.data() + kFrameHead, size - kFrameHead);
    return frame;
  }

 private:
  void take(std::byte* to, std::size_t size) const {
    std::size_t done = 0;
    while (done < size && has_more(5000)) {
      const ssize_t count = recv(descriptor_, to + done, size - done, 0);
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    EXPECT_EQ(done, size);
  }
  int descriptor_;
};

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
  const Viewer viewer(stream.local());
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
  const Viewer deaf(stream.local(), 4096);
  deaf.ask(1000);
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  stream.offer(numbered(1, kLarge));
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(stream.wanted()) << "a second frame would wait in memory";
    stream.offer(numbered(2, kLarge));
    deaf.ask();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const Viewer other(stream.local());
  EXPECT_EQ(other.read(), numbered(0));
  other.ask();
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  stream.offer(numbered(3));
  EXPECT_EQ(other.read(), numbered(3)) << "one that does not read holds up nobody";
}

TEST(FrameStream, AsksAreKeptThatComeBeforeTheGreetingIsRead) {
  FrameStream stream({}, numbered(0, 8U << 20U));
  const Viewer viewer(stream.local(), 4096);
  viewer.ask();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(stream.wanted());
  EXPECT_EQ(viewer.read(), numbered(0, 8U << 20U));
  ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
}

TEST(FrameStream, ViewersComeAndGo) {
  FrameStream stream({}, numbered(0));
  for (int i = 0; i < 20; ++i) {
    const Viewer viewer(stream.local());
    EXPECT_EQ(viewer.read(), numbered(0));
    viewer.ask();
    ASSERT_TRUE(eventually([&] { return stream.wanted(); }));
  }
  EXPECT_TRUE(eventually([&] { return stream.viewers() == 0 && !stream.wanted(); }));
}

TEST(FrameStream, NoMoreViewersThanTheLimit) {
  FrameStream stream({}, numbered(0));
  std::vector<std::unique_ptr<Viewer>> viewers;
  for (std::size_t i = 0; i < FrameStream::kViewersMax; ++i) {
    viewers.push_back(std::make_unique<Viewer>(stream.local()));
    EXPECT_EQ(viewers.back()->read(), numbered(0));
  }
  const Viewer late(stream.local());
  ASSERT_TRUE(late.has_more(5000)) << "it is closed";
  EXPECT_EQ(stream.viewers(), FrameStream::kViewersMax);
}

TEST(FrameStream, ATakenPortIsAnErrorThatHelps) {
  const FrameStream holder({}, numbered(0));
  try {
    const FrameStream second({.listen = holder.local(), .allowed = {}}, numbered(0));
    FAIL() << "two streams on one port";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("--show host:port"));
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(holder.local().port)));
  }
}

}  // namespace
}  // namespace splash::protocol::test
