// SPDX-License-Identifier: MIT
#include "synth-server/receive/intake.hpp"

#include <numeric>
#include <string_view>
#include <utility>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/filling.hpp"
#include "synth-server/receive/oscpack_reader.hpp"

namespace splash::synth {
namespace {

/// The first pings follow each other quickly, so that an estimate is there soon [s].
constexpr int kQuickPings = 8;
constexpr double kQuickPingPeriod = 0.09;  // less than a heartbeat
constexpr double kPingPeriod = 1.0;

bool is_event(std::string_view address) noexcept {
  return address == "/impact" || address == "/bubble" || address == "/cavity";
}

/// Replies are never answered, lest two programs talk to each other for ever.
bool is_reply(const protocol::Message& message) noexcept {
  const auto* row = protocol::find_address(message.address);
  return row != nullptr && row->direction == protocol::Direction::reply;
}

/// The same, as long as its /pong.
protocol::Message answerable(const protocol::Message& ping) {
  static const std::size_t kSize = protocol::encoded_size(protocol::pong({}, {}, {}));
  return protocol::filled_up(ping, kSize);
}

/// Moment of an event after its bundle's [s].
double offset_seconds(const protocol::Event& event) noexcept {
  return std::visit([](const auto& e) { return 1e-3 * static_cast<double>(e.offset_ms); }, event);
}

}  // namespace

std::uint64_t refused(const IntakeCounters& counters) noexcept {
  return std::accumulate(counters.refusals.begin(), counters.refusals.end(), counters.out_of_table);
}

Intake::Intake(CommandQueue& queue, Control control, LocalTime time)
    : queue_(queue), control_(std::move(control)), time_(std::move(time)) {}

void Intake::datagram(protocol::Bytes bytes, const protocol::Endpoint& from, double arrival,
                      std::vector<Reply>& replies) {
  ++counters_.datagrams;
  const auto [refusal, packet] = read_packet(bytes);
  if (refusal != protocol::Refusal::none) {
    ++counters_.refusals[static_cast<std::size_t>(refusal)];
    return;
  }
  Visit visit{from, arrival, protocol::ReplyBudget(from, bytes.size()), replies};
  const auto timing = open_bundle(packet, visit);
  if (!timing) return;
  for (const auto& message : packet.messages) route(message, *timing, visit);
}

std::optional<Intake::Timing> Intake::open_bundle(const protocol::Packet& packet, Visit& visit) {
  const double arrival = visit.arrival;
  const bool tagged = packet.time && *packet.time != protocol::kImmediately;
  const auto frame =
      packet.messages.empty() ? std::nullopt : protocol::to_frame(packet.messages.front());
  if (!frame) {
    const double moment = tagged ? time_.monotonic_of(*packet.time) : arrival;
    return Timing{moment, arrival, !tagged};
  }
  Sender& sender = senders_.at(visit.from);
  const protocol::Arrival order = welcome(*frame, sender, arrival);
  if (order == protocol::Arrival::duplicate) return std::nullopt;
  if (arrival >= sender.next_ping) ask_clock(sender, visit);

  const double delay = 1e-3 * static_cast<double>(frame->delay_ms);
  const double by_arrival = arrival + delay;
  if (!tagged) return Timing{by_arrival, by_arrival, delay <= 0.0, frame->session};
  const double moment = time_.monotonic_of(*packet.time);
  if (order != protocol::Arrival::reordered &&
      sender.clock.observe(moment - delay, arrival, time_.unix_of(arrival))) {
    ++counters_.sender_steps;
    sender.pings = 0;
  }
  const double correction = sender.clock.correction(time_.unix_of(arrival));
  if (correction != 0.0) ++counters_.corrected;
  return Timing{moment + correction, by_arrival, false, frame->session};
}

protocol::Arrival Intake::welcome(const protocol::Frame& frame, Sender& sender, double arrival) {
  const protocol::Arrival kind = sender.sequence.observe(frame);
  if (kind == protocol::Arrival::duplicate) return kind;
  if (kind == protocol::Arrival::new_session) {
    sender.clock.restart();
    sender.pings = 0;
  }
  sender.present = true;
  sender.heard = arrival;
  return kind;
}

void Intake::route(const protocol::Message& message, const Timing& timing, Visit& visit) {
  if (message.address == "/leave") {
    leave(message, visit.from);
  } else if (is_event(message.address) || message.address == "/frame") {
    if (const auto event = protocol::to_event(message)) return play(*event, timing);
    if (protocol::violation(message)) ++counters_.out_of_table;
  } else if (is_reply(message)) {
    take_pong(message, visit.from, visit.arrival);
  } else if (control_.allows(visit.from)) {
    if (protocol::violation(message)) ++counters_.out_of_table;
    control_.handle(message,
                    {visit.from, visit.arrival, time_.unix_of(visit.arrival), visit.budget},
                    status(), visit.replies);
  } else {
    ++counters_.forbidden;
  }
}

void Intake::leave(const protocol::Message& message, const protocol::Endpoint& from) {
  Sender* sender = senders_.find(from);
  if (protocol::violation(message)) {
    ++counters_.out_of_table;
  } else if (sender != nullptr && sender->present) {
    sender->present = false;
    if (!senders_.anybody_present()) ++counters_.departures;
  }
}

void Intake::play(const protocol::Event& event, const Timing& timing) {
  const double offset = offset_seconds(event);
  const Command command{
      Command::Kind::play, event,  timing.moment + offset, timing.by_arrival + offset,
      timing.at_once,      offset, timing.session};
  const std::size_t kept = kKeptPlaces + (is_bubble(event) ? kKeptFromBubbles : 0);
  const bool taken = queue_.write_available() > kept && queue_.push(command);
  ++(taken ? counters_.events : counters_.queue_full);
  if (!taken) ++counters_.without_place.of(event);
}

// Only ever in answer to a frame, which is longer: a forged frame draws no more than was sent. To
// another host it is as long as the /pong that is wanted, unless the frame came alone, in 32 bytes.
void Intake::ask_clock(Sender& sender, Visit& visit) {
  const double now = visit.arrival;
  sender.next_ping = now + (sender.pings < kQuickPings ? kQuickPingPeriod : kPingPeriod);
  ++sender.pings;
  sender.asked = protocol::to_time_tag(time_.unix_of(now));
  const protocol::Message ping = protocol::ping(sender.asked);
  auto fitting = is_loopback(sender.endpoint) ? std::nullopt : visit.budget.take(answerable(ping));
  if (!fitting) fitting = visit.budget.take(ping);
  if (fitting) visit.replies.push_back({sender.endpoint, std::move(*fitting)});
}

void Intake::take_pong(const protocol::Message& message, const protocol::Endpoint& from,
                       double arrival) {
  Sender* sender = senders_.find(from);
  if (message.address != "/pong" || protocol::violation(message) || sender == nullptr) return;
  const auto stamp = [&](std::size_t i) {
    return std::get<protocol::TimeTag>(message.arguments[i]);
  };
  if (stamp(0) != sender->asked) return;  // not what was asked, or answered already
  sender->asked = protocol::kImmediately;
  sender->clock.pong(protocol::to_unix_seconds(stamp(0)), protocol::to_unix_seconds(stamp(1)),
                     protocol::to_unix_seconds(stamp(2)), time_.unix_of(arrival));
}

void Intake::tick(double now) {
  if (senders_.expire(now)) ++counters_.departures;
  if (time_.refresh()) ++counters_.clock_steps;
}

protocol::SynthStatus Intake::status() const {
  const IntakeCounters all = counters();
  protocol::SynthStatus status;
  status.events = all.events;
  status.lost = all.sequence.lost;
  status.duplicates = all.sequence.duplicates;
  status.refused = refused(all);
  status.dropped = all.queue_full;
  return status;
}

IntakeCounters Intake::counters() const {
  IntakeCounters counters = counters_;
  counters.withheld = control_.withheld();
  counters.sequence = senders_.totals();
  return counters;
}

}  // namespace splash::synth
