// SPDX-License-Identifier: MIT
// Control commands, worded and answered like SuperCollider's server; only from allowed hosts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/status.hpp"
#include "protocol/udp_socket.hpp"
#include "synth-server/receive/reply_limit.hpp"

namespace splash::synth {

/// What a command may do to the program.
struct ControlActions {
  /// Completes what the receiving side knows with what the audio side does.
  std::function<protocol::SynthStatus(protocol::SynthStatus)> status;
  std::function<void()> clear_scheduled;
  std::function<void()> quit;
  std::function<void(bool)> mute;  ///< true: silent, false: heard

  struct Value {
    std::string name;
    double value = 0.0;
  };
  /// The first two give the reason why not, or nothing.
  std::function<std::string(const std::string&, double)> set = [](auto&&...) { return "no rows"; };
  std::function<std::string(const std::string&, double)> preset = set;
  std::function<std::optional<double>(const std::string&)> get = [](auto&&...) {
    return std::nullopt;
  };
  /// At most so many values that have changed since they were last asked for.
  std::function<std::vector<Value>(std::size_t)> changes = [](auto&&...) {
    return std::vector<Value>();
  };
  /// A test tone on a channel, from 1, or none; the reason why not, or nothing.
  std::function<std::string(int)> tone = [](int) { return "no channels"; };
};

/// Where and when a command came, and what its datagram may still draw.
struct Arrived {
  protocol::Endpoint from;
  double monotonic = 0.0;  ///< [s]
  double unix_time = 0.0;  ///< [s]
  protocol::ReplyBudget& budget;
};

struct Reply {
  protocol::Endpoint to;
  protocol::Message message;
};

class Control {
 public:
  /// Loopback is always allowed; `allowed`: further hosts (IPv4, host byte order).
  Control(ControlActions actions, std::vector<std::uint32_t> allowed);

  [[nodiscard]] bool allows(const protocol::Endpoint& from) const noexcept;
  /// Carries out a command from an allowed host; what is no command is answered with /fail.
  /// `status`: what the receiving side knows of it.
  void handle(const protocol::Message& message, const Arrived& arrived,
              const protocol::SynthStatus& status, std::vector<Reply>& replies);
  /// To all who asked with /notify: what has changed.
  void tell_changes(std::vector<Reply>& replies) const;
  /// To all who asked with /notify: the program ends.
  void say_goodbye(std::vector<Reply>& replies) const;

  [[nodiscard]] int dump_level() const noexcept { return dump_level_; }
  [[nodiscard]] bool reports_failures() const noexcept { return reports_failures_; }
  /// Replies withheld because a host asked too often, or in fewer bytes than the reply has.
  [[nodiscard]] std::uint64_t withheld() const noexcept { return withheld_; }
  /// A line for people on the last question that was too short, once; empty: none was.
  [[nodiscard]] std::string take_complaint() { return std::exchange(complaint_, {}); }

 private:
  /// The reply to a message that the address table accepts.
  [[nodiscard]] protocol::Message carry_out(const protocol::Message& message,
                                            const Arrived& arrived,
                                            const protocol::SynthStatus& status);
  [[nodiscard]] protocol::Message notify(const protocol::Message& message, const Arrived& arrived);
  [[nodiscard]] protocol::Message change(const protocol::Message& message);
  [[nodiscard]] protocol::Message quit(const protocol::Endpoint& from);

  /// Sends `reply` if the question is as long and `limit` lets it.
  void answer(const std::string& command, const protocol::Message& reply, const Arrived& arrived,
              ReplyLimit& limit, std::vector<Reply>& replies);

  ControlActions actions_;
  std::vector<std::uint32_t> allowed_;
  std::vector<protocol::Endpoint> clients_;
  ReplyLimit limit_;
  ReplyLimit pongs_{100.0};  ///< no larger than four stamps; clocks are measured in bursts
  int dump_level_ = 0;
  bool reports_failures_ = true;
  std::uint64_t withheld_ = 0;
  std::string complaint_;
};

}  // namespace splash::synth
