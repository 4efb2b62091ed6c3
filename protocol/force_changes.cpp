// SPDX-License-Identifier: MIT
#include "protocol/force_changes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "protocol/address.hpp"

namespace splash::protocol {
namespace {

std::int32_t body_of(const Message& message) {
  return std::get<std::int32_t>(message.arguments.front());
}

/// Arguments behind the body: 1, 2 and 3.
std::array<double, 3> vector_of(const Message& message) {
  std::array<double, 3> vector{};
  for (std::size_t i = 0; i < vector.size(); ++i) {
    vector[i] = static_cast<double>(std::get<float>(message.arguments[i + 1]));
  }
  return vector;
}

std::optional<Vec3> place_of(const std::vector<Message>& messages, std::int32_t body) {
  const auto at = std::find_if(messages.begin(), messages.end(), [&](const auto& m) {
    return m.address == "/body/at" && body_of(m) == body;
  });
  if (at == messages.end()) return std::nullopt;
  return Vec3{std::get<float>(at->arguments[1]), std::get<float>(at->arguments[2]),
              std::get<float>(at->arguments[3])};
}

}  // namespace

bool tells_forces(const std::vector<Message>& messages) noexcept {
  return std::any_of(messages.begin(), messages.end(),
                     [](const Message& message) { return message.address == "/force"; });
}

std::vector<Push> ForceChanges::take(const std::vector<Message>& messages, double time) {
  const bool is_sound = std::none_of(messages.begin(), messages.end(), [](const Message& message) {
    return violation(message).has_value();
  });
  if (!is_sound || messages.empty()) return {};
  const auto frame = to_frame(messages.front());
  const std::int32_t session = frame ? frame->session : 0;
  std::vector<Push> pushes;
  for (const Message& message : messages) {
    if (message.address != "/force") continue;
    const std::int32_t body = body_of(message);
    Last& last = last_[static_cast<std::size_t>(body)];
    const double passed = time - last.time;
    const bool goes_on = last.session == session;
    if (goes_on && std::abs(passed) < kLeast) continue;
    const Last now = {session, time, vector_of(message)};
    const Last before = std::exchange(last, now);
    const auto place = place_of(messages, body);
    if (!goes_on || passed < 0.0 || passed > kGap || !place) continue;
    const double rate = std::hypot(now.force[0] - before.force[0], now.force[1] - before.force[1],
                                   now.force[2] - before.force[2]) /
                        passed;
    pushes.push_back({*place, body, std::min(static_cast<float>(rate), kMostRate)});
  }
  return pushes;
}

}  // namespace splash::protocol
