// SPDX-License-Identifier: MIT
// The simulator's voice: the events of one frame become one bundle on the wire, and the same
// bundle, timed by simulated seconds alone, in the log.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "protocol/event.hpp"
#include "protocol/event_log.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "sim-server/send/split.hpp"
#include "sim-server/send/targets.hpp"

namespace splash::sim {

struct EventSenderSettings {
  int seed = 1;       ///< the scene's: the log's session number follows from it
  double lead = 0.0;  ///< bundles are stamped up to this long after their frame [s]: the time the
                      ///< scene promises between a frame and its earliest sound
  std::function<double()> clock = protocol::unix_now;  ///< Unix time [s]
};

/// When a frame is, on both clocks.
struct FrameTime {
  std::int64_t step = 0;     ///< simulation step
  double seconds = 0.0;      ///< simulated time of the frame [s], never smaller than the last
  double unix_origin = 0.0;  ///< Unix time at which simulated second 0 sounds [s]; see Pacer
};

struct SendCounts {
  std::uint64_t bundles = 0;  ///< with events; a frame may take several
  std::uint64_t heartbeats = 0;
  protocol::ByKind<std::uint64_t> events;
  std::uint64_t invalid = 0;  ///< events outside the address table's ranges, not sent
  std::uint64_t overdue = 0;  ///< events whose moment had passed when they were sent
  double most_overdue = 0.0;  ///< the longest such delay [s]
};

/// A bundle is stamped T = max(last T, now, min(earliest moment, frame + lead)). So no tag is
/// smaller than the one before, no offset is negative, and no event waits for a tag that an
/// earlier frame had set into the future for a later event.
class EventSender {
 public:
  /// `log` may be null. All references outlive the sender.
  EventSender(Targets& targets, protocol::UdpSocket& socket, protocol::LogWriter* log,
              EventSenderSettings settings = {});

  /// Sends and logs one frame's events; without events as idle(). Sending never throws; the log
  /// throws std::runtime_error when the disk refuses.
  void send_step(const FrameTime& frame, std::vector<TimedEvent> events);
  /// Logs forces on bodies at the end of a frame, before send_step() of that frame: a bundle of
  /// `messages` behind a /frame of the log's. What is logged of earlier frames waits for its time
  /// from then on, so that the log stays in order.
  void log_forces(const FrameTime& frame, const std::vector<protocol::Message>& messages);
  /// Says /frame when nothing was said for kHeartbeatPeriod. The log has no heartbeats: they
  /// depend on the wall clock.
  void idle();
  /// The last bundle: receivers play what they have instead of falling silent when no more comes.
  void leave();
  /// Ends the log with a /frame at `end_seconds` or at the last event's moment, the later one.
  void close(double end_seconds);
  /// The log takes nothing more.
  void stop_logging() noexcept { log_ = nullptr; }

  /// Of the wire: drawn from the system's entropy, in [1, 2^24).
  [[nodiscard]] std::int32_t session() const noexcept { return wire_.session; }
  [[nodiscard]] const SendCounts& counts() const noexcept { return counts_; }

 private:
  /// One of the two streams of bundles: the wire's or the log's.
  struct Stream {
    std::int32_t session = 1;
    std::int32_t sequence = 0;
    double last_time = 0.0;  ///< of the newest bundle: Unix time or simulated time [s]
  };

  double read_clock();
  void drop_invalid(double frame_seconds, std::vector<TimedEvent>& events);
  void count(const std::vector<TimedEvent>& events);
  void send_bundles(const FrameTime& frame, std::vector<EventBundle>& bundles);
  void log_bundles(const FrameTime& frame, std::vector<EventBundle>& bundles);
  /// Writes what waits of the log up to this simulated time [s].
  void write_log_until(double seconds);
  void say_frame(double now);
  void transmit(double time, const std::vector<protocol::Message>& messages);
  /// The stream's next /frame.
  [[nodiscard]] protocol::Message next_frame(Stream& stream, double delay_seconds) const;
  /// Fills in the bundle's /frame and its events' offsets. `play_origin`: the bundle's time in
  /// simulated seconds.
  void stamp_bundle(Stream& stream, EventBundle& bundle, double delay_seconds,
                    double play_origin) const;

  Targets& targets_;
  protocol::UdpSocket& socket_;
  protocol::LogWriter* log_;
  EventSenderSettings settings_;
  Stream wire_;
  Stream logged_;
  Stream logged_forces_;                  ///< numbered separately
  bool has_forces_ = false;               ///< the log has some
  std::deque<protocol::LogEntry> ahead_;  ///< bundles of the log that lie ahead of their frame
  std::int32_t step_ = 0;
  std::optional<double> last_now_;   ///< [s], Unix time
  std::optional<double> last_sent_;  ///< [s], Unix time
  double last_moment_ = 0.0;         ///< latest moment of any event [s], simulated time
  SendCounts counts_;
};

}  // namespace splash::sim
