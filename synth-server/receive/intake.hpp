// SPDX-License-Identifier: MIT
// What becomes of a datagram: gate, oscpack, then events with their moments to the audio thread,
// commands to the control port. It knows no socket and no thread, so that tests bring their own
// time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/force_changes.hpp"
#include "protocol/gate.hpp"
#include "protocol/udp_socket.hpp"
#include "synth-server/play/command_queue.hpp"
#include "synth-server/receive/control.hpp"
#include "synth-server/receive/forces.hpp"
#include "synth-server/receive/local_time.hpp"
#include "synth-server/receive/sender.hpp"

namespace splash::synth {

struct IntakeCounters {
  std::uint64_t datagrams = 0;
  std::uint64_t events = 0;      ///< handed to the audio thread
  std::uint64_t queue_full = 0;  ///< events dropped because the audio thread did not take them
  protocol::ByKind<std::uint64_t> without_place{};  ///< same by kind
  std::uint64_t out_of_table = 0;                   ///< messages the address table refuses
  std::uint64_t forbidden = 0;                      ///< commands from hosts that are not allowed
  std::uint64_t withheld = 0;    ///< replies over the limit or longer than their request
  std::uint64_t corrected = 0;   ///< bundles whose sender's clock was off
  std::uint64_t departures = 0;  ///< times the last sender went silent or took its leave
  std::array<std::uint64_t, static_cast<std::size_t>(protocol::Refusal::count_)> refusals{};
  SequenceTotals sequence;  ///< lost, duplicates, reordered: bundles
};
/// Datagrams the gate stopped and messages the address table refused.
[[nodiscard]] std::uint64_t refused(const IntakeCounters& counters) noexcept;

class Intake {
 public:
  /// `allowed`: hosts whose commands are obeyed besides this one's, in host byte order.
  explicit Intake(CommandQueue& queue, ControlActions actions = {},
                  std::vector<std::uint32_t> allowed = {}, LocalTime time = LocalTime{},
                  ForceSource forces = ForceSource{});
  Intake(const Intake&) = delete;
  Intake& operator=(const Intake&) = delete;

  /// `arrival`: when it came [s, monotonic]. Replies and pings are appended to `replies`.
  void datagram(protocol::Bytes bytes, const protocol::Endpoint& from, double arrival,
                std::vector<Reply>& replies);
  /// To be called often, with the socket drained: leases and this host's clock. `now`: monotonic
  /// [s].
  void tick(double now);
  /// The question for forces, when it is due at `now` [s, monotonic].
  void ask_for_forces(double now, std::vector<Reply>& replies);
  /// To all clients and to who tells forces, at the end.
  void say_goodbye(std::vector<Reply>& replies);
  /// To its clients: what has changed.
  void tell_changes(std::vector<Reply>& replies) const { control_.tell_changes(replies); }

  [[nodiscard]] IntakeCounters counters() const;
  [[nodiscard]] const protocol::ControlPort& port() const noexcept { return control_.port(); }
  [[nodiscard]] bool sender_present() const noexcept { return senders_.anybody_present(); }
  /// When tick() next has a lease to end [s, monotonic]; infinity: no sender is present.
  [[nodiscard]] double next_expiry() const noexcept { return senders_.next_expiry(); }

 private:
  /// What a bundle says about the time of its events.
  struct Timing {
    double moment = 0.0;       ///< the bundle's [s, monotonic]
    double by_arrival = 0.0;   ///< arrival + announced delay [s, monotonic]
    bool at_once = false;      ///< OSC's "immediately", and no delay announced
    std::int32_t session = 0;  ///< of the sender, 0: there was no /frame
  };
  using Visit = protocol::Visit;
  using Replies = std::vector<Reply>;

  /// nullopt: a bundle that was heard before.
  [[nodiscard]] std::optional<Timing> open_bundle(const protocol::Packet& packet, Visit& visit,
                                                  Replies& replies);
  protocol::Arrival welcome(const protocol::Frame& frame, Sender& sender, double arrival);
  void route(const protocol::Message& message, const Timing& timing, Visit& visit,
             Replies& replies);
  /// Counts and reports a message that the address table refuses.
  void refuse(const protocol::Message& message, const std::string& reason, const Visit& visit);
  void play(const protocol::Event& event, const Timing& timing);
  void leave(const Visit& visit);
  void press(const Push& push, const Timing& timing);
  void push(const protocol::Packet& packet, const protocol::Endpoint& from, double arrival);
  void take_reply(const protocol::Message& message, const protocol::Endpoint& from, double arrival);
  void ask_clock(Sender& sender, Visit& visit, Replies& replies);
  [[nodiscard]] protocol::SynthStatus status() const;

  CommandQueue& queue_;
  LocalTime time_;
  SenderTable senders_;
  protocol::ForceChanges forces_;
  ForceQuestion force_question_;
  IntakeCounters counters_;  ///< but for those of the control port
  Control control_;
};

}  // namespace splash::synth
