// SPDX-License-Identifier: MIT
// What the synth's own commands do, and who is told of changes. protocol::ControlPort carries out
// the commands that both programs have alike.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/control_port.hpp"
#include "protocol/status.hpp"

namespace splash::synth {

using protocol::Reply;

/// What a command may do to the program. A command whose action is empty is refused with /fail.
struct ControlActions {
  /// Completes what the receiving side knows with what the audio side does.
  std::function<protocol::SynthStatus(protocol::SynthStatus)> status = {};
  std::function<void()> clear_scheduled = {};
  std::function<void()> quit = {};
  std::function<void(bool)> mute = {};  ///< true: silent, false: heard

  struct Value {
    std::string name;
    double value = 0.0;
  };
  /// Both return the reason why they did not; empty: they did.
  std::function<std::string(const std::string&, double)> set = {};
  std::function<std::string(const std::string&, double)> preset = {};
  std::function<std::optional<double>(const std::string&)> get = {};
  /// Returns at most so many values that have changed since they were last asked for.
  std::function<std::vector<Value>(std::size_t)> changes = {};
  /// Plays a test tone on a channel, from 1, or none for 0. Returns the reason why it did not.
  std::function<std::string(int)> tone = {};
  /// Goes over to a rig (empty: the one that it has) and to the middle of a scene [m], if one is
  /// told. Returns the reason why it did not.
  std::function<std::string(const std::string&, const std::optional<std::array<double, 3>>&)> rig =
      {};
  std::function<void(const std::string& line)> print =
      {};  ///< for the lines of /dumpOSC and /error
};

class Control {
 public:
  /// `allowed`: hosts whose commands are obeyed besides this one's, in host byte order.
  /// `heard`: returns what the receiving side knows of the status.
  Control(ControlActions actions, std::vector<std::uint32_t> allowed,
          std::function<protocol::SynthStatus()> heard);
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  [[nodiscard]] protocol::ControlPort& port() noexcept { return port_; }
  [[nodiscard]] const protocol::ControlPort& port() const noexcept { return port_; }

  /// Renews the subscription of a host that said something at `now` (monotonic [s]).
  void renew(const protocol::Endpoint& from, double now);
  /// Ends the subscriptions that have run out by `now` (monotonic [s]).
  void expire(double now);
  /// To all subscribers: what has changed.
  void tell_changes(std::vector<Reply>& replies) const;
  /// To all subscribers: the program ends.
  void say_goodbye(std::vector<Reply>& replies) const;

 private:
  struct Subscriber {
    protocol::Endpoint endpoint;
    double expires = 0.0;  ///< monotonic [s]
  };

  void add_commands();
  [[nodiscard]] protocol::Outcome notify(const protocol::Message& message, protocol::Visit& visit);
  [[nodiscard]] protocol::Outcome rig(const protocol::Message& message) const;
  [[nodiscard]] protocol::Outcome value_of(const protocol::Message& message) const;

  ControlActions actions_;
  std::function<protocol::SynthStatus()> heard_;
  std::vector<Subscriber> subscribers_;
  protocol::ControlPort port_;
};

}  // namespace splash::synth
