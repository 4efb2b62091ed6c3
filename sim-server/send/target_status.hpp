// SPDX-License-Identifier: MIT
// Asks the receivers of the events how they fare, for the run's report. Answers may never come.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::sim {

/// A receiver's counters, of this run: what it had counted before is taken off.
struct TargetAnswer {
  protocol::Endpoint target;
  std::optional<protocol::SynthStatus> last = {};  ///< as it was told; empty: never answered
  std::uint64_t late = 0;                          ///< events it got after their moment
  std::uint64_t lost = 0;                          ///< bundles it missed
  std::uint64_t answers = 0;
  bool awaited = false;  ///< asked and not yet answered
  int missed = 0;        ///< requests in a row without an answer
};

class TargetStatus {
 public:
  static constexpr double kPeriod = 1.0;  ///< between questions [s]

  /// A target is reported as silent after this many requests in a row without an answer.
  static constexpr int kMissed = 2;

  /// `clock`: monotonic [s]. `say`: gets one line when a target falls silent, and when it answers
  /// again.
  explicit TargetStatus(
      const std::vector<protocol::Endpoint>& targets,
      std::function<double()> clock = protocol::monotonic_now,
      std::function<void(const std::string&)> say = [](const std::string&) {});

  /// Before the first event: what the targets count now is not this run's. Waits for their
  /// answers up to `timeout` [s]; who is silent is taken to start from zero later.
  void begin(double timeout);
  /// Once a frame; never waits. Asks every kPeriod.
  void poll();
  /// After the last event. Asks once more and waits for the answers up to `timeout` [s].
  void finish(double timeout);

  [[nodiscard]] const std::vector<TargetAnswer>& answers() const noexcept { return answers_; }
  /// Sums over the targets that answered; empty when none did.
  [[nodiscard]] std::optional<std::uint64_t> late() const;
  [[nodiscard]] std::optional<std::uint64_t> lost() const;

 private:
  void ask();
  void ask_and_wait(double timeout);
  void drain(double timeout);
  void take(protocol::Bytes packet, const protocol::Endpoint& from);
  [[nodiscard]] bool all_answered() const;
  [[nodiscard]] std::optional<std::uint64_t> sum(std::uint64_t TargetAnswer::*counter) const;

  std::function<double()> clock_;
  std::function<void(const std::string&)> say_;
  protocol::UdpSocket socket_;
  std::vector<TargetAnswer> answers_;
  double next_question_ = 0.0;  ///< monotonic [s]
  bool beginning_ = false;      ///< answers set the start of counting
};

}  // namespace splash::sim
