// SPDX-License-Identifier: MIT
#include "sim-server/send/force_sender.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/address.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/send/lo_packet.hpp"

namespace splash::sim {
namespace {

constexpr std::size_t kBodies = 5;  ///< of a bundle

template <std::size_t size>
protocol::Message message_of(const char* address, std::int32_t body,
                             const std::array<double, size>& values) {
  protocol::Message message = {address, {body}};
  for (const double value : values) message.arguments.emplace_back(static_cast<float>(value));
  return message;
}

std::vector<protocol::Message> messages_of(const ForceReading& reading) {
  return {message_of("/body/at", reading.body, reading.at),
          message_of("/body/twist", reading.body, reading.twist),
          message_of("/force", reading.body, reading.force),
          message_of("/force/rate", reading.body, reading.rate)};
}

/// A number that is none breaks every range.
bool is_sound(const std::vector<protocol::Message>& messages) {
  return std::none_of(messages.begin(), messages.end(), [](const protocol::Message& message) {
    return protocol::violation(message).has_value();
  });
}

}  // namespace

std::vector<std::vector<protocol::Message>> force_bundles(
    const std::vector<ForceReading>& readings) {
  std::vector<std::vector<protocol::Message>> bundles;
  for (std::size_t first = 0; first < readings.size(); first += kBodies) {
    std::vector<protocol::Message> bundle;
    for (std::size_t k = first; k < std::min(first + kBodies, readings.size()); ++k) {
      const auto messages = messages_of(readings[k]);
      if (is_sound(messages)) bundle.insert(bundle.end(), messages.begin(), messages.end());
    }
    if (!bundle.empty()) bundles.push_back(std::move(bundle));
  }
  return bundles;
}

void ForceSender::send(std::int64_t step, double unix_time,
                       const std::vector<std::vector<protocol::Message>>& bundles) {
  for (const std::vector<protocol::Message>& messages : bundles) {
    const double delay = 1000.0 * (unix_time - protocol::unix_now());
    std::vector<protocol::Message> bundle = {protocol::to_message(
        protocol::Frame{.session = session_,
                        .sequence = sequence_,
                        .step = static_cast<std::int32_t>(step % protocol::kCounterWrap),
                        .delay_ms = static_cast<float>(std::clamp(delay, -10000.0, 10000.0))})};
    bundle.insert(bundle.end(), messages.begin(), messages.end());
    targets_.send(socket_, build_bundle(protocol::to_time_tag(unix_time), bundle), kForceStream);
    sequence_ = (sequence_ + 1) % protocol::kCounterWrap;
    ++bundles_;
  }
}

}  // namespace splash::sim
