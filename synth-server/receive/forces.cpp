// SPDX-License-Identifier: MIT
#include "synth-server/receive/forces.hpp"

#include <utility>

#include "protocol/reply_budget.hpp"

namespace splash::synth {
namespace {

/// As long as any answer: a /fail with its longest reason.
constexpr std::size_t kQuestion = 96;  // [bytes]

protocol::Message notify(std::int32_t streams) {
  return protocol::filled_up({"/notify", {streams}}, kQuestion);
}

}  // namespace

std::optional<protocol::Message> ForceQuestion::due(double now) {
  if (!source_.simulator) return std::nullopt;
  if (!source_.wanted()) return last();
  if (now < next_) return std::nullopt;
  asked_at_ = now;
  next_ = now + kEager;
  asked_ = true;
  return notify(2);
}

std::optional<protocol::Message> ForceQuestion::last() {
  next_ = 0.0;
  if (!std::exchange(asked_, false)) return std::nullopt;
  return notify(0);
}

std::string ForceQuestion::refusal(const protocol::Message& reply, const protocol::Endpoint& from) {
  if (!source_.simulator || !(from == *source_.simulator)) return {};
  const bool answers = reply.address == "/done" || reply.address == "/fail";
  if (asked_ && answers) next_ = asked_at_ + kPeriod;
  if (reply.address == "/done") refused_.clear();
  if (reply.address != "/fail" || reply.arguments.size() != 2) return {};
  const auto* const reason = std::get_if<std::string>(&reply.arguments[1]);
  if (reason == nullptr || *reason == refused_) return {};
  refused_ = *reason;
  return "tells no forces: " + refused_ + "; what is under the foot follows impacts and bubbles";
}

}  // namespace splash::synth
