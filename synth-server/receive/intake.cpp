// SPDX-License-Identifier: MIT
#include "synth-server/receive/intake.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/reply_budget.hpp"
#include "synth-server/receive/oscpack_reader.hpp"

namespace splash::synth {
namespace {

/// The first pings follow each other quickly, so that an estimate is there soon [s].
constexpr int kQuickPings = 8;
constexpr double kQuickPingPeriod = 0.09;  // less than a heartbeat
constexpr double kPingPeriod = 1.0;

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

Intake::Intake(CommandQueue& queue, ControlActions actions, std::vector<std::uint32_t> allowed,
               LocalTime time, ForceSource forces)
    : queue_(queue),
      time_(std::move(time)),
      force_question_(std::move(forces)),
      control_(std::move(actions), std::move(allowed), [this] { return status(); }) {}

void Intake::ask_for_forces(double now, std::vector<Reply>& replies) {
  if (const auto question = force_question_.due(now)) {
    replies.push_back({force_question_.simulator(), *question});
  }
}

void Intake::say_goodbye(std::vector<Reply>& replies) {
  control_.say_goodbye(replies);
  if (const auto last = force_question_.last()) {
    replies.push_back({force_question_.simulator(), *last});
  }
}

void Intake::datagram(protocol::Bytes bytes, const protocol::Endpoint& from, double arrival,
                      std::vector<Reply>& replies) {
  ++counters_.datagrams;
  const protocol::DecodeResult read = read_packet(bytes);
  if (!control_.port().inspect(bytes, read, from, arrival)) return;
  if (protocol::tells_forces(read.packet.messages)) return push(read.packet, from, arrival);
  control_.renew(from, arrival);
  Visit visit{from, arrival, time_.unix_of(arrival), read.packet.time, {from, bytes.size()}};
  const auto timing = open_bundle(read.packet, visit, replies);
  if (!timing) return;
  for (const auto& message : read.packet.messages) route(message, *timing, visit, replies);
}

std::optional<Intake::Timing> Intake::open_bundle(const protocol::Packet& packet, Visit& visit,
                                                  Replies& replies) {
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
  if (arrival >= sender.next_ping) ask_clock(sender, visit, replies);

  const double delay = 1e-3 * static_cast<double>(frame->delay_ms);
  const double by_arrival = arrival + delay;
  if (!tagged) return Timing{by_arrival, by_arrival, delay <= 0.0, frame->session};
  const double moment = time_.monotonic_of(*packet.time);
  if (order != protocol::Arrival::reordered &&
      sender.clock.observe(moment - delay, arrival, time_.unix_of(arrival))) {
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

void Intake::route(const protocol::Message& message, const Timing& timing, Visit& visit,
                   Replies& replies) {
  const auto* row = protocol::find_address(message.address);
  if (row != nullptr && row->direction == protocol::Direction::to_synth) {
    if (const auto event = protocol::to_event(message)) return play(*event, timing);
    if (const auto push = protocol::to_push(message)) return press(*push, timing);
    if (const auto reason = protocol::violation(message)) return refuse(message, *reason, visit);
    if (message.address == "/leave") leave(visit);
  } else if (is_reply(message)) {
    take_reply(message, visit.from, visit.arrival);
  } else if (control_.port().allows(visit.from)) {
    control_.port().take(message, visit, replies);
  } else {
    control_.port().turn_away(visit.from, visit.arrival);
  }
}

void Intake::refuse(const protocol::Message& message, const std::string& reason,
                    const Visit& visit) {
  ++counters_.out_of_table;
  control_.port().report(visit.from, message.address + ": " + reason, visit.arrival);
}

void Intake::leave(const Visit& visit) {
  Sender* sender = senders_.find(visit.from);
  if (sender == nullptr || !sender->present) return;
  sender->present = false;
  if (!senders_.anybody_present()) ++counters_.departures;
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

void Intake::press(const Push& push, const Timing& timing) {
  Command command;
  command.kind = Command::Kind::push;
  command.moment = timing.moment;
  command.by_arrival = timing.by_arrival;
  command.push = push;
  if (queue_.write_available() > kKeptPlaces + kKeptFromBubbles) (void)queue_.push(command);
}

// These bundles count on their own: what of them is lost is no loss, for the next one comes soon.
// They tell of the time in which the bodies move, by the clock of their sender.
void Intake::push(const protocol::Packet& packet, const protocol::Endpoint& from, double arrival) {
  const bool is_sound =
      std::none_of(packet.messages.begin(), packet.messages.end(),
                   [](const auto& message) { return protocol::violation(message).has_value(); });
  if (!is_sound || !packet.time || *packet.time == protocol::kImmediately) {
    ++counters_.out_of_table;
    return;
  }
  const Sender* const sender = senders_.find(from);
  const double correction =
      sender == nullptr ? 0.0 : sender->clock.correction(time_.unix_of(arrival));
  const double moment = time_.monotonic_of(*packet.time) + correction;
  for (const Push& found : forces_.take(packet.messages, protocol::to_unix_seconds(*packet.time))) {
    press(found, {moment, arrival});
  }
}

// Only ever in answer to a frame, which is longer: a forged frame draws no more than was sent. To
// another host it is as long as the /pong that is wanted, unless the frame came alone, in 32 bytes.
void Intake::ask_clock(Sender& sender, Visit& visit, Replies& replies) {
  const double now = visit.arrival;
  sender.next_ping = now + (sender.pings < kQuickPings ? kQuickPingPeriod : kPingPeriod);
  ++sender.pings;
  sender.asked = protocol::to_time_tag(time_.unix_of(now));
  const protocol::Message ping = protocol::ping(sender.asked);
  auto fitting = is_loopback(sender.endpoint) ? std::nullopt : visit.budget.take(answerable(ping));
  if (!fitting) fitting = visit.budget.take(ping);
  if (fitting) replies.push_back({sender.endpoint, std::move(*fitting)});
}

void Intake::take_reply(const protocol::Message& message, const protocol::Endpoint& from,
                        double arrival) {
  if (const std::string line = force_question_.refusal(message, from); !line.empty()) {
    control_.port().report(from, line, arrival);
  }
  Sender* sender = senders_.find(from);
  if (message.address != "/pong" || sender == nullptr || protocol::violation(message)) return;
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
  time_.refresh();
  control_.expire(now);
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
  const protocol::ControlCounts& port = control_.port().counts();
  IntakeCounters counters = counters_;
  counters.refusals = port.refused;
  counters.out_of_table += port.out_of_table;
  counters.forbidden = port.not_allowed;
  counters.withheld = port.withheld;
  counters.sequence = senders_.totals();
  return counters;
}

}  // namespace splash::synth
