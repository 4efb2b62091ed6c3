// SPDX-License-Identifier: MIT
#include "synth-server/receive/forces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/filling.hpp"

namespace splash::synth {
namespace {

/// As long as any answer: a /fail with its longest reason.
constexpr std::size_t kQuestion = 96;  // [bytes]

std::int32_t body_of(const protocol::Message& message) {
  return std::get<std::int32_t>(message.arguments.front());
}

/// Arguments behind the body: 1, 2 and 3.
std::array<double, 3> vector_of(const protocol::Message& message) {
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < vector.size(); ++i) {
    vector[i] = static_cast<double>(std::get<float>(message.arguments[i + 1]));
  }
  return vector;
}

std::optional<protocol::Vec3> place_of(const protocol::Packet& packet, std::int32_t body) {
  const auto at = std::find_if(packet.messages.begin(), packet.messages.end(), [&](const auto& m) {
    return m.address == "/body/at" && body_of(m) == body;
  });
  if (at == packet.messages.end()) return std::nullopt;
  return protocol::Vec3{std::get<float>(at->arguments[1]), std::get<float>(at->arguments[2]),
                        std::get<float>(at->arguments[3])};
}

protocol::Message notify(std::int32_t streams) {
  return protocol::filled_up({"/notify", {streams}}, kQuestion);
}

}  // namespace

bool tells_forces(const protocol::Packet& packet) noexcept {
  return std::any_of(packet.messages.begin(), packet.messages.end(),
                     [](const protocol::Message& message) { return message.address == "/force"; });
}

std::vector<Push> Forces::take(const protocol::Packet& packet, double time) {
  const auto frame = protocol::to_frame(packet.messages.front());
  const std::int32_t session = frame ? frame->session : 0;
  std::vector<Push> pushes;
  for (const protocol::Message& message : packet.messages) {
    if (message.address != "/force") continue;
    const std::int32_t body = body_of(message);
    Told& last = last_[static_cast<std::size_t>(body)];
    const double passed = time - last.time;
    const bool goes_on = last.session == session;
    if (goes_on && std::abs(passed) < kLeast) continue;
    const Told now = {session, time, vector_of(message)};
    const Told before = std::exchange(last, now);
    const auto place = place_of(packet, body);
    if (!goes_on || passed < 0.0 || passed > kGap || !place) continue;
    const double rate = std::hypot(now.force[0] - before.force[0], now.force[1] - before.force[1],
                                   now.force[2] - before.force[2]) /
                        passed;
    pushes.push_back({*place, body, std::min(rate, kMostRate)});
  }
  return pushes;
}

std::optional<protocol::Message> ForceQuestion::due(double now) {
  if (!source_.simulator) return std::nullopt;
  if (!source_.wanted()) return last();
  if (now < next_) return std::nullopt;
  next_ = now + kPeriod;
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
  if (reply.address == "/done") refused_.clear();
  if (reply.address != "/fail" || reply.arguments.size() != 2) return {};
  const auto* const reason = std::get_if<std::string>(&reply.arguments[1]);
  if (reason == nullptr || *reason == refused_) return {};
  refused_ = *reason;
  return "tells no forces: " + refused_ + "; what is under the foot follows impacts and bubbles";
}

}  // namespace splash::synth
