// SPDX-License-Identifier: MIT
// Sends frames to viewers over TCP. A viewer gets a greeting, then one frame for each byte that it
// sends: a slow viewer asks rarely, and nothing is queued for it. The stream has a thread of its
// own.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "protocol/frame.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::protocol {

struct FrameStreamSettings {
  Endpoint listen;
  std::vector<std::uint32_t> allowed;  ///< hosts besides this one that may connect (IPv4)
  int most_asked = 1;                  ///< frames that a viewer may wait for at once
};

class FrameStream {
 public:
  static constexpr std::size_t kViewersMax = 8;

  /// Listens. Throws SocketError.
  FrameStream(const FrameStreamSettings& settings, ViewFrame greeting);
  /// `greet` makes the greeting of each viewer, on the stream's thread.
  FrameStream(const FrameStreamSettings& settings, std::function<ViewFrame()> greet);
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  // These may be called from any thread and never wait for a viewer.

  /// Whether a viewer has asked for a frame and not got it.
  [[nodiscard]] bool wanted() const noexcept { return wanted_.load(std::memory_order_acquire); }
  /// Sends the frame to all viewers that have asked for one.
  void offer(ViewFrame frame);
  [[nodiscard]] std::size_t viewers() const noexcept { return viewers_count_; }
  /// The endpoint that viewers connect to.
  [[nodiscard]] Endpoint local() const noexcept { return local_; }

 private:
  using Shared = std::shared_ptr<const ViewFrame>;
  struct Viewer {
    int descriptor = -1;
    int asked = 0;
    std::deque<Shared> waiting;  ///< the first may have been sent in part
    std::size_t sent = 0;        ///< of the first [bytes]
  };

  void run();
  void welcome();
  void pause();
  void hear(Viewer& viewer);
  void write(Viewer& viewer);
  void drop_gone();
  /// Whether the viewer has asked for a frame and has been sent all earlier ones.
  [[nodiscard]] bool is_open(const Viewer& viewer) const noexcept;
  void note_wanted();

  FrameStreamSettings settings_;
  std::function<Shared()> greet_;
  int listener_ = -1;
  int wake_ = -1;
  Endpoint local_;
  double paused_until_ = 0.0;     ///< no viewer is accepted before; monotonic [s]
  bool warned_of_pause_ = false;  ///< the warning is printed once
  std::atomic<bool> ending_{false};
  std::atomic<bool> wanted_{false};
  std::atomic<std::size_t> viewers_count_{0};
  std::mutex mutex_;
  std::vector<Viewer> viewers_;  ///< under mutex_
  std::thread thread_;
};

}  // namespace splash::protocol
