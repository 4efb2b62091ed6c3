// SPDX-License-Identifier: MIT
// Counters are added up answer by answer, so that a receiver that is restarted on the way, and
// counts from zero again, loses nothing of what it had told.
#include "sim-server/send/target_status.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/reply_budget.hpp"
#include "sim-server/send/lo_packet.hpp"
#include "sim-server/send/targets.hpp"

namespace splash::sim {
namespace {

constexpr int kMostPerDrain = 64;  // a flood of answers must not hold up the simulation

/// How far a counter moved. A smaller value than before means that its owner was restarted.
std::uint64_t moved(std::uint64_t before, std::uint64_t now) {
  return now >= before ? now - before : now;
}

std::string nobody_at(const protocol::Endpoint& target) {
  const std::string where = protocol::to_string(target);
  return "no answer from " + where +
         (is_loopback(target)
              ? ": start synth-server or a Pd patch there" +
                    (target.port == protocol::kSynthPort
                         ? std::string()
                         : "; unless told otherwise both listen on port " +
                               std::to_string(protocol::kSynthPort))
              : ": a synth-server there needs --listen 0.0.0.0:" + std::to_string(target.port) +
                    " and --allow with this host, "
                    "and no firewall before that UDP port");
}

}  // namespace

TargetStatus::TargetStatus(const std::vector<protocol::Endpoint>& targets,
                           std::function<double()> clock,
                           std::function<void(const std::string&)> say)
    : clock_(std::move(clock)), say_(std::move(say)), socket_(sending_endpoint(targets)) {
  for (const auto& target : targets) {
    const bool known = std::any_of(answers_.begin(), answers_.end(),
                                   [&](const auto& answer) { return answer.target == target; });
    if (!known) answers_.push_back({.target = target});
  }
}

void TargetStatus::begin(double timeout) {
  beginning_ = true;
  ask_and_wait(timeout);
  beginning_ = false;
}

void TargetStatus::poll() {
  if (clock_() >= next_question_) ask();
  drain(0.0);
}

void TargetStatus::finish(double timeout) {
  ask_and_wait(timeout);
}

void TargetStatus::ask() {
  const protocol::Message question{"/status", {}};
  const auto here = build_message(question);
  const auto afar = build_message(protocol::filled_up(question, protocol::kFilledQuestion));
  for (auto& answer : answers_) {
    if (answer.awaited && ++answer.missed == kMissed) say_(nobody_at(answer.target));
    answer.awaited = true;
    // Refused by the kernel or lost on the way: both show as a missing answer.
    static_cast<void>(socket_.send_to(answer.target, is_loopback(answer.target) ? here : afar));
  }
  next_question_ = clock_() + kPeriod;
}

void TargetStatus::ask_and_wait(double timeout) {
  drain(0.0);  // answers to older questions are not what is waited for
  ask();
  const double end = clock_() + timeout;
  double left = timeout;
  while (left > 0.0 && !all_answered()) {
    drain(left);
    left = end - clock_();
  }
}

void TargetStatus::drain(double timeout) {
  std::array<std::byte, protocol::kMaxDatagram + 4> buffer{};
  for (int i = 0; i < kMostPerDrain; ++i) {
    const auto received = socket_.receive(buffer.data(), buffer.size(), i == 0 ? timeout : 0.0);
    if (!received) return;
    take(protocol::Bytes(buffer).first(std::min(received->size, buffer.size())), received->from);
  }
}

void TargetStatus::take(protocol::Bytes packet, const protocol::Endpoint& from) {
  const auto decoded = protocol::decode(packet);
  if (decoded.packet.messages.empty()) return;  // refused, or nothing said
  const auto status = protocol::to_synth_status(decoded.packet.messages.front());
  if (!status) return;
  const auto answer = std::find_if(answers_.begin(), answers_.end(),
                                   [&](const auto& known) { return known.target == from; });
  if (answer ==
      answers_.end()) {  // Pd replies from another port: it runs, but its counters are not used
    for (auto& known : answers_) {
      if (known.target.address == from.address) known.missed = 0;
    }
    return;
  }
  if (!beginning_) {
    const auto before = answer->last.value_or(protocol::SynthStatus{});
    answer->late += moved(before.late, status->late);
    answer->lost += moved(before.lost, status->lost);
  }
  if (answer->missed >= kMissed) say_(protocol::to_string(answer->target) + " answers");
  answer->missed = 0;
  answer->last = *status;
  answer->awaited = false;
  ++answer->answers;
}

bool TargetStatus::all_answered() const {
  return std::none_of(answers_.begin(), answers_.end(),
                      [](const auto& answer) { return answer.awaited; });
}

std::optional<std::uint64_t> TargetStatus::late() const {
  return sum(&TargetAnswer::late);
}

std::optional<std::uint64_t> TargetStatus::lost() const {
  return sum(&TargetAnswer::lost);
}

std::optional<std::uint64_t> TargetStatus::sum(std::uint64_t TargetAnswer::*counter) const {
  std::optional<std::uint64_t> total;
  for (const auto& answer : answers_) {
    if (answer.last) total = total.value_or(0) + answer.*counter;
  }
  return total;
}

}  // namespace splash::sim
