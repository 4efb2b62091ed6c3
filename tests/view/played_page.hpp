// SPDX-License-Identifier: MIT
// The page in a real browser before a simulator that the test plays: still water, and one disc that
// goes where /body/pose says. Nothing in it depends on how fast the machine is. All tests of a
// program share one browser, which takes far longer to start than to load a page.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "protocol/frame.hpp"
#include "protocol/frame_stream.hpp"
#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/view/picture.hpp"
#include "view-server/server.hpp"

namespace splash::tests {

/// A pose that the page sent.
struct SentPose {
  double made = 0.0;  ///< by the page's clock, Unix time [s]
  protocol::BodyPose pose;
};

class PlayedPage {
 public:
  static constexpr double kHalf = 0.2;   ///< of the tank's edges along x and y [m]
  static constexpr float kRest = 0.35F;  ///< height of the disc's centre where nobody holds it [m]

  /// The program's only one.
  static PlayedPage& shared();
  PlayedPage();
  ~PlayedPage();
  PlayedPage(const PlayedPage&) = delete;
  PlayedPage& operator=(const PlayedPage&) = delete;

  [[nodiscard]] Chromium& browser() { return *browser_; }
  /// Nothing but the page's modules for a script to import.
  void load_modules();
  /// The page with water of this depth [m], in a picture of so many pixels.
  void load(const std::string& query, int width, int height, double level = 0.2);
  /// The water's surface [m], from the next state on.
  void fill(double level) { level_ = level; }
  /// Whether the newest state's disc comes to a place for which `condition` of x, y and z holds.
  bool disc_comes(const std::string& condition);
  /// The first so many poses of a body since the last call, or those that come in time.
  std::vector<SentPose> poses(std::int32_t body, std::size_t count);

 private:
  void play();
  void hear(const protocol::Packet& packet);
  [[nodiscard]] protocol::ViewFrame state() const;

  protocol::FrameStream water_;
  protocol::FrameStream sound_;
  protocol::UdpSocket sim_;
  protocol::UdpSocket synth_;
  view::Server server_;
  std::unique_ptr<Chromium> browser_;
  std::atomic<double> level_ = 0.2;
  std::mutex mutex_;
  std::vector<SentPose> poses_;  ///< under mutex_
  double told_ = 0.0;            ///< simulated time of the last state [s]
  protocol::BodyPose disc_;
  bool held_ = false;
  std::jthread serves_;
  std::jthread plays_;
};

}  // namespace splash::tests
