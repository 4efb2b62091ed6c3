// SPDX-License-Identifier: MIT
// Stamps, numbers and sends. The wire and the log differ in their clock and session alone.
#include "sim-server/send/event_sender.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <utility>
#include <variant>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "sim-server/send/lo_packet.hpp"

namespace splash::sim {
namespace {

constexpr double kClockJump = 0.1;  // a clock set back by more is no longer waited for [s]

/// Into [1, 2^24), the range of session numbers.
std::int32_t to_session(std::uint64_t number) {
  constexpr auto kRange = static_cast<std::uint64_t>(protocol::kCounterWrap) - 1;
  return static_cast<std::int32_t>(number % kRange) + 1;
}

std::int32_t random_session() {
  std::random_device entropy;
  return to_session(entropy());
}

/// SplitMix64 (Steele, Lea & Flood 2014), one step: neighbouring seeds, unrelated sessions.
std::int32_t session_of_seed(int seed) {
  std::uint64_t z = static_cast<std::uint64_t>(seed) + 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return to_session(z ^ (z >> 31));
}

std::int32_t wrap(std::int64_t number) {
  return static_cast<std::int32_t>(number % protocol::kCounterWrap);
}

float to_ms(double seconds) {
  return static_cast<float>(seconds * 1000.0);
}

}  // namespace

EventSender::EventSender(Targets& targets, protocol::UdpSocket& socket, protocol::LogWriter* log,
                         EventSenderSettings settings)
    : targets_(targets), socket_(socket), log_(log), settings_(std::move(settings)) {
  wire_.session = random_session();
  logged_.session = logged_forces_.session = session_of_seed(settings_.seed);
}

void EventSender::send_step(const FrameTime& frame, std::vector<TimedEvent> events) {
  step_ = wrap(frame.step);
  drop_invalid(frame.seconds, events);
  if (events.empty()) {
    idle();
    return;
  }
  sort_events(events);
  count(events);
  last_moment_ = std::max(last_moment_, events.back().play_seconds);
  std::vector<EventBundle> bundles = bundle_events(events);
  send_bundles(frame, bundles);
  if (log_ != nullptr) log_bundles(frame, bundles);
}

void EventSender::send_bundles(const FrameTime& frame, std::vector<EventBundle>& bundles) {
  const double now = read_clock();
  const double earliest = frame.unix_origin + bundles.front().play_seconds.front();
  const double stamp = frame.unix_origin + frame.seconds + settings_.lead;
  const double time = std::max({wire_.last_time, now, std::min(earliest, stamp)});
  for (EventBundle& bundle : bundles) {
    for (const double play_seconds : bundle.play_seconds) {
      const double overdue = time - (frame.unix_origin + play_seconds);
      if (overdue > 0.0) ++counts_.overdue;
      counts_.most_overdue = std::max(counts_.most_overdue, overdue);
    }
    stamp_bundle(wire_, bundle, time - now, time - frame.unix_origin);
    transmit(time, bundle.messages);
    ++counts_.bundles;
  }
  last_sent_ = now;
}

void EventSender::log_bundles(const FrameTime& frame, std::vector<EventBundle>& bundles) {
  const double earliest = bundles.front().play_seconds.front();
  const double stamp = frame.seconds + settings_.lead;
  const double time = std::max(logged_.last_time, std::min(earliest, stamp));
  logged_.last_time = time;
  const double delay = std::max(0.0, time - frame.seconds);
  for (EventBundle& bundle : bundles) {
    stamp_bundle(logged_, bundle, delay, time);
    if (has_forces_) {
      ahead_.push_back({time, std::move(bundle.messages)});
    } else {
      log_->append(time, bundle.messages);
    }
  }
}

void EventSender::log_forces(const FrameTime& frame,
                             const std::vector<protocol::Message>& messages) {
  if (log_ == nullptr) return;
  has_forces_ = true;
  step_ = wrap(frame.step);
  write_log_until(frame.seconds);
  std::vector<protocol::Message> bundle = {next_frame(logged_forces_, 0.0)};
  bundle.insert(bundle.end(), messages.begin(), messages.end());
  log_->append(frame.seconds, bundle);
}

void EventSender::write_log_until(double seconds) {
  for (; !ahead_.empty() && ahead_.front().seconds <= seconds; ahead_.pop_front()) {
    log_->append(ahead_.front().seconds, ahead_.front().messages);
  }
}

void EventSender::idle() {
  const double now = read_clock();
  if (last_sent_ && now - *last_sent_ < protocol::kHeartbeatPeriod) return;
  say_frame(now);
}

void EventSender::leave() {
  const double now = read_clock();
  const double time = std::max(wire_.last_time, now);
  transmit(time, {next_frame(wire_, time - now), {"/leave", {}}});
  ++counts_.heartbeats;
}

void EventSender::close(double end_seconds) {
  if (log_ == nullptr) return;
  const double end = std::max({end_seconds, last_moment_, logged_.last_time});
  write_log_until(end);
  log_->append(end, {next_frame(logged_, 0.0)});
}

void EventSender::say_frame(double now) {
  const double time = std::max(wire_.last_time, now);
  transmit(time, {next_frame(wire_, time - now)});
  last_sent_ = now;
  ++counts_.heartbeats;
}

/// The system clock, which a person or a time daemon may set back. Tags then start anew instead of
/// staying in a future that is far away; smaller steps are bridged by the last tag.
double EventSender::read_clock() {
  const double now = settings_.clock();
  if (last_now_ && now < *last_now_ - kClockJump) {
    wire_.last_time = 0.0;
    last_sent_.reset();
  }
  last_now_ = now;
  return now;
}

/// What a receiver's table would refuse is not sent: it would take its whole bundle along.
void EventSender::drop_invalid(double frame_seconds, std::vector<TimedEvent>& events) {
  counts_.invalid += std::erase_if(events, [=](TimedEvent& timed) {
    if (!std::isfinite(timed.play_seconds)) return true;
    const float offset_ms = to_ms(std::max(0.0, timed.play_seconds - frame_seconds));
    std::visit([=](auto& event) { event.offset_ms = offset_ms; }, timed.event);
    return !protocol::conforms(timed.event);
  });
}

void EventSender::count(const std::vector<TimedEvent>& events) {
  for (const auto& timed : events) ++counts_.events.of(timed.event);
}

void EventSender::transmit(double time, const std::vector<protocol::Message>& messages) {
  wire_.last_time = time;
  targets_.send(socket_, build_bundle(protocol::to_time_tag(time), messages));
}

protocol::Message EventSender::next_frame(Stream& stream, double delay_seconds) const {
  const protocol::Frame frame{.session = stream.session,
                              .sequence = stream.sequence,
                              .step = step_,
                              .delay_ms = to_ms(delay_seconds)};
  stream.sequence = wrap(std::int64_t{stream.sequence} + 1);
  return protocol::to_message(frame);
}

void EventSender::stamp_bundle(Stream& stream, EventBundle& bundle, double delay_seconds,
                               double play_origin) const {
  bundle.messages.front() = next_frame(stream, delay_seconds);
  for (std::size_t i = 0; i < bundle.play_seconds.size(); ++i) {
    const double offset = std::max(0.0, bundle.play_seconds[i] - play_origin);
    protocol::set_offset(bundle.messages[i + 1], to_ms(offset));
  }
}

}  // namespace splash::sim
