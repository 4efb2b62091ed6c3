// SPDX-License-Identifier: MIT
// The control port of a program: it answers the commands of the address table, and it limits who is
// heard, how often a host is answered and in how many bytes. It knows neither sockets nor threads.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/text.hpp"
#include "protocol/address.hpp"
#include "protocol/gate.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::protocol {

/// A datagram that has arrived, and what it may still draw in replies.
struct Visit {
  Endpoint from;
  double arrival = 0.0;              ///< monotonic [s]
  double unix_time = 0.0;            ///< the same moment as Unix time [s]
  std::optional<TimeTag> sent = {};  ///< time tag of its bundle; empty: it is a bare message
  ReplyBudget budget;
};

struct Reply {
  Endpoint to;
  Message message;
};

/// What became of a command: a reply, or the reason why it was refused. With neither of them the
/// command was carried out and has no reply.
struct Outcome {
  std::optional<Message> reply = {};
  std::string refused = {};
};

/// /done to the command unless there is a reason why it was refused.
[[nodiscard]] Outcome done_unless(const std::string& refused, const Message& command);

struct ControlCounts {
  /// Datagrams that the gate refused, by reason.
  std::array<std::uint64_t, static_cast<std::size_t>(Refusal::count_)> refused = {};
  std::uint64_t not_allowed = 0;   ///< times that a host was not heard; such a host gets no reply
  std::uint64_t out_of_table = 0;  ///< messages of unknown address, wrong types or out of range
  std::uint64_t failed = 0;        ///< commands that were refused, those out of the table included
  std::uint64_t unasked = 0;       ///< replies and events that the program has no use for
  std::uint64_t replies = 0;       ///< replies handed over to be sent
  std::uint64_t withheld = 0;      ///< replies over the rate limit or longer than their request
};

/// What every program does alike is built in: /version, /sync, /ping, /dumpOSC, /error and who may
/// /quit. The program adds the other commands.
class ControlPort {
 public:
  using Print = std::function<void(const std::string& line)>;
  /// Carries out a command that conforms to its row of the address table. An exception that it
  /// throws is answered with /fail.
  using Command = std::function<Outcome(const Message& message, Visit& visit)>;
  /// Takes a message whose address is not in the table; false: it is nothing for the program.
  using Others = std::function<bool(const Message& message, const Visit& visit)>;

  struct Settings {
    std::string program;                      ///< kSimProgram or kSynthProgram
    std::vector<std::uint32_t> allowed = {};  ///< hosts besides this one, in host byte order
    Print print = {};                         ///< gets /dumpOSC's and /error's lines
  };

  /// `quit`: called when this host sends /quit; empty: /quit is refused.
  ControlPort(Settings settings, std::function<void()> quit);
  ControlPort(const ControlPort&) = delete;
  ControlPort& operator=(const ControlPort&) = delete;

  /// Adds a command. Throws std::logic_error when `address` is not in the table.
  void on(const std::string& address, Command command);
  void on_others(Others take) { others_ = std::move(take); }
  /// The commands of the table for this program that have not been added.
  [[nodiscard]] std::vector<std::string> missing() const;

  /// Returns whether commands of this host are carried out: those of 127.0.0.0/8 and of the hosts
  /// in Settings::allowed.
  [[nodiscard]] bool allows(const Endpoint& from) const noexcept;
  /// Counts and reports a host that is not allowed.
  void turn_away(const Endpoint& from, double now);
  /// Prints a datagram where /dumpOSC asks for that, and counts and reports it when the gate has
  /// refused it. Returns whether the gate accepted it. `now`: monotonic [s].
  [[nodiscard]] bool inspect(Bytes bytes, const DecodeResult& read, const Endpoint& from,
                             double now);
  /// Carries out a message of an allowed host. The reply, if it may be sent, is appended.
  void take(const Message& message, Visit& visit, std::vector<Reply>& replies);
  /// Reports a failure, unless /error 0 was sent or the host was reported too often.
  void report(const Endpoint& from, const std::string& failure, double now);

  [[nodiscard]] const ControlCounts& counts() const noexcept { return counts_; }
  /// The number of messages of a command that had wrong types or were out of range.
  [[nodiscard]] std::uint64_t violations(const std::string& address) const;

 private:
  struct Entry {
    Command run;
    std::uint64_t violations = 0;
  };

  [[nodiscard]] Outcome carry_out(const Message& message, Visit& visit);
  [[nodiscard]] std::string unknown(const std::string& address) const;
  void answer(const std::string& command, const Message& reply, Visit& visit,
              std::vector<Reply>& replies);
  void dump(Bytes bytes, const DecodeResult& read, const Endpoint& from, double now);

  Settings settings_;
  std::map<std::string, Entry> commands_;
  Others others_;
  ControlCounts counts_;
  RateLimit replies_{kReplyRate, kReplyBurst};
  RateLimit pongs_{kPongRate, kPongBurst};
  RateLimit reports_{kReportRate, kReportBurst};
  program::TextLimit dumped_;
  unsigned dump_level_ = 0;       ///< of /dumpOSC, as scsynth counts: bit 1 text, bit 2 hexadecimal
  bool reports_failures_ = true;  ///< /error 1
};

// Packets as text for people: what /dumpOSC prints.

/// "/bubble ,iifff 1 0 0.004 ...": floats with all their digits. The time tag of its bundle stands
/// in front, as seconds and fraction in hexadecimal digits.
[[nodiscard]] std::string to_text(const Message& message, const std::optional<TimeTag>& time = {});
/// "2f 62 75 ...", one line.
[[nodiscard]] std::string to_hexadecimal(Bytes bytes);

}  // namespace splash::protocol
