// SPDX-License-Identifier: MIT
// Two programs that send poses of one body at once, over UDP: one of them moves it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <deque>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "protocol/limits.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"

namespace splash::tests {
namespace {

/// A tracker that holds the disc at `x` [m], far above the water.
class Sender {
 public:
  explicit Sender(float x) : x_(x), socket_({INADDR_LOOPBACK, 0}) {}

  void say(const protocol::Endpoint& to, const protocol::Message& message) {
    socket_.send_to(to, protocol::encode(message));
  }
  void pose(const protocol::Endpoint& to) {
    say(to, protocol::to_message(protocol::BodyPose{0, {x_, 0.0F, 0.40F}, 0.0F, 0.0F, 0.0F, 1.0F}));
  }
  [[nodiscard]] std::string name() const { return to_string(socket_.local()); }

 private:
  float x_;
  protocol::UdpSocket socket_;
};

/// Hears where the disc is, and what viewers are told.
class Watcher {
 public:
  explicit Watcher(const protocol::Endpoint& program) : socket_({INADDR_LOOPBACK, 0}) {
    socket_.send_to(program, protocol::encode({"/notify", {3}}));
  }
  void listen() {
    std::array<std::byte, protocol::kMaxDatagram> buffer{};
    while (const auto received = socket_.receive(buffer.data(), buffer.size(), 0.0)) {
      const auto read = protocol::decode(protocol::Bytes(buffer).first(received->size));
      for (const auto& message : read.packet.messages) {
        if (message.address == "/body/at") xs.push_back(std::get<float>(message.arguments[1]));
        if (message.address == "/fail") told.push_back(std::get<std::string>(message.arguments[1]));
      }
    }
  }
  std::vector<float> xs = {};          ///< of the disc in each frame [m]
  std::vector<std::string> told = {};  ///< of poses

 private:
  protocol::UdpSocket socket_;
};

class TwoSenders : public testing::Test {
 protected:
  /// Those send a hundred poses a second each, one after the other, for so long [s]; one at least.
  void send(const std::vector<Sender*>& senders, double seconds) {
    const double end = protocol::monotonic_now() + seconds;
    do {
      for (Sender* sender : senders) sender->pose(simulator_.endpoint());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      watcher_.listen();
    } while (protocol::monotonic_now() < end);
  }
  /// Until the disc is at `x` [m], however slow the machine is.
  void settle(const std::vector<Sender*>& senders, float x) {
    const double limit = protocol::monotonic_now() + 20.0;
    do {
      send(senders, 0.1);
    } while ((watcher_.xs.empty() || std::abs(watcher_.xs.back() - x) > 0.0002F) &&
             protocol::monotonic_now() < limit);
  }
  /// Where the disc was in the frames of the next `seconds` [m].
  std::vector<float> places(const std::vector<Sender*>& senders, double seconds) {
    watcher_.xs.clear();
    send(senders, seconds);
    return watcher_.xs;
  }
  long lines() {
    long count = 0;
    const std::string text = simulator_.process().output();
    const std::string words = "both send poses of body 'disc'";
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
      ++count;
    return count;
  }

  SmallScene scene_{tracked()};
  Simulator simulator_{{"--scene", scene_.path()}};
  Watcher watcher_{simulator_.endpoint()};
  Sender first_{-0.01F};
  Sender last_{0.01F};
};

TEST_F(TwoSenders, TheOneThatBeganLastMovesTheBodyUntilItIsSilent) {
  using testing::Each;
  using testing::FloatNear;
  settle({&first_}, -0.01F);
  settle({&first_, &last_}, 0.01F);
  EXPECT_THAT(places({&first_, &last_}, 0.6), Each(FloatNear(0.01F, 0.0005F)));
  const std::string both =
      first_.name() + " and " + last_.name() + " both send poses of body 'disc'";
  EXPECT_TRUE(simulator_.process().wait_for_text(both + ": it follows " + last_.name()));
  EXPECT_EQ(lines(), 1) << simulator_.process().output();
  EXPECT_THAT(watcher_.told,
              testing::ElementsAre(first_.name() + " yields to " + last_.name() + " on 'disc'"));
  settle({&first_}, -0.01F);
  EXPECT_THAT(places({&first_}, 0.5), Each(FloatNear(-0.01F, 0.0005F)));
  EXPECT_EQ(lines(), 1) << "the same two";
}

// As a page does, which takes the body from a tracker and gives it back.
TEST_F(TwoSenders, WhoGrabsTakesTheBodyAndLetsGoAtOnce) {
  using testing::Each;
  using testing::FloatNear;
  settle({&last_, &first_}, -0.01F);
  last_.say(simulator_.endpoint(), {"/body/grab", {0, 1}});
  settle({&last_, &first_}, 0.01F);
  EXPECT_THAT(places({&last_, &first_}, 0.5), Each(FloatNear(0.01F, 0.0005F)));
  last_.say(simulator_.endpoint(), {"/body/grab", {0, 0}});
  send({&first_}, 0.3);
  EXPECT_LT(watcher_.xs.back(), 0.009F) << "sooner than by silence";
  settle({&first_}, -0.01F);
  EXPECT_NEAR(watcher_.xs.back(), -0.01F, 0.0005F);
}

// A program that opens a socket for each pose is one sender to those who run it. The sockets stay
// open, or the system may give a port a second time within half a second.
TEST_F(TwoSenders, PosesEachFromAnotherPortAllMoveTheBody) {
  std::deque<Sender> senders;
  for (int k = 0; k < 150; ++k)
    send({&senders.emplace_back(0.00025F * static_cast<float>(std::min(k, 60)))}, 0.0);
  EXPECT_NEAR(watcher_.xs.back(), 0.015F, 0.002F);
  EXPECT_EQ(lines(), 0) << simulator_.process().output();
}

// What cannot be a pose takes the body from nobody.
TEST_F(TwoSenders, ASenderOfWrongUnitsKeepsNobodyOut) {
  Sender wrong(500.0F);  // millimetres
  settle({&first_}, -0.01F);
  EXPECT_THAT(places({&first_, &wrong}, 0.5), testing::Each(testing::FloatNear(-0.01F, 0.0005F)));
  EXPECT_EQ(lines(), 0) << simulator_.process().output();
}

}  // namespace
}  // namespace splash::tests
