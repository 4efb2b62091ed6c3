// SPDX-License-Identifier: MIT
// A control server on a free port, with actions that note what they were asked.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/time_tag.hpp"
#include "sim-server/listen/control.hpp"
#include "tests/sim-server/send/peer.hpp"
#include "tests/support/waiting.hpp"

namespace splash::test {

struct TakenPose {
  protocol::BodyPose pose;
  sim::PoseMoment moment;
};

struct TrackedMessage {
  protocol::Message message;
  sim::PoseMoment moment;
};

class ControlFixture : public testing::Test {
 protected:
  void SetUp() override { start({.listen = {}}); }

  void start(const sim::ControlSettings& settings) {
    server_.reset();
    sim::ControlActions actions;
    actions.pose = [this](const protocol::BodyPose& pose, const sim::PoseMoment& moment) {
      const std::lock_guard lock(mutex_);
      poses_.push_back({pose, moment});
    };
    actions.track = [this](const protocol::Message& message, const sim::PoseMoment& moment) {
      const std::lock_guard lock(mutex_);
      if (message.address != "/tracker") return false;
      tracked_.push_back({message, moment});
      return true;
    };
    actions.status = [] {
      return protocol::SimStatus{.particles = 15000, .steps = 42, .refused = 1000};
    };
    actions.quit = [this] {
      const std::lock_guard lock(mutex_);
      ++quits_;
    };
    actions.print = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      lines_.push_back(line);
    };
    server_ = std::make_unique<sim::ControlServer>(settings, actions, targets_);
  }

  /// Sends and returns the next reply.
  protocol::Message ask(const protocol::Message& message) { return ask(*server_, message); }
  protocol::Message ask(const sim::ControlServer& server, const protocol::Message& message) {
    peer_.send(server.local(), message);
    return peer_.message();
  }
  /// A message or a datagram.
  void tell(const auto& what) { peer_.send(server_->local(), what); }
  /// All that was sent before is done: the server obeys in order.
  void settle() { ASSERT_EQ(ask({"/sync", {12345}}), (protocol::Message{"/synced", {12345}})); }
  /// For peers that get no replies: waits until the server has taken `packets` datagrams.
  void wait_for_packets(std::uint64_t packets) {
    ASSERT_TRUE(tests::eventually([&] { return server_->counts().packets >= packets; }, kTimeout));
  }
  std::vector<TakenPose> poses() {
    const std::lock_guard lock(mutex_);
    return poses_;
  }
  std::vector<TrackedMessage> tracked() {
    const std::lock_guard lock(mutex_);
    return tracked_;
  }
  std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }
  int quits() {
    const std::lock_guard lock(mutex_);
    return quits_;
  }

  sim::Targets targets_{{}};
  Peer peer_;
  std::unique_ptr<sim::ControlServer> server_;

 private:
  std::mutex mutex_;
  std::vector<TakenPose> poses_;
  std::vector<TrackedMessage> tracked_;
  std::vector<std::string> lines_;
  int quits_ = 0;
};

}  // namespace splash::test
