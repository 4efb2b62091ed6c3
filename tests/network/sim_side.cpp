// SPDX-License-Identifier: MIT
#include "tests/network/sim_side.hpp"

#include <array>
#include <utility>
#include <variant>

#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"

namespace splash::network {
namespace {

constexpr double kLead = 0.015;  // [s], as the built-in scenes'

}  // namespace

SimSide::SimSide(std::function<double()> unix_clock)
    : unix_clock_(std::move(unix_clock)),
      targets_({caught_.local()}),
      sender_(targets_, here_, nullptr, {.seed = 1, .lead = kLead, .clock = unix_clock_}) {}

std::vector<Datagram> SimSide::say(double seconds, std::vector<sim::TimedEvent> events) {
  // The pacer's origin follows the system clock.
  sender_.send_step({++step_, seconds, unix_clock_() - seconds}, std::move(events));
  std::vector<Datagram> said;
  std::array<std::byte, 2048> buffer{};
  while (const auto received = caught_.receive(buffer.data(), buffer.size(), 0.0)) {
    said.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(received->size));
  }
  return said;
}

protocol::Message SimSide::answer(const protocol::Message& ping) const {
  const auto now = protocol::to_time_tag(unix_clock_());
  return protocol::pong(std::get<protocol::TimeTag>(ping.arguments.at(0)), now, now);
}

}  // namespace splash::network
