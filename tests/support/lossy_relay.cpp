// SPDX-License-Identifier: MIT
#include "tests/support/lossy_relay.hpp"

#include <poll.h>

#include <algorithm>
#include <array>

namespace splash::tests {
namespace {

constexpr std::size_t kMostLines = 32;  ///< the oldest goes: programs that were killed
constexpr int kTimeout = 100;           ///< until the thread looks whether it shall end [ms]

using Datagram = std::array<std::byte, 2048>;  ///< ours have 1472 bytes at most

}  // namespace

LossyRelay::LossyRelay(const protocol::Endpoint& target, double loss, unsigned seed)
    : target_(target),
      loses_(loss),
      random_(seed),
      front_({INADDR_LOOPBACK, 0}),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void LossyRelay::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<pollfd> waiting = {{front_.descriptor(), POLLIN, 0}};
    for (const Line& line : lines_) waiting.push_back({line.socket.descriptor(), POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), kTimeout) <= 0) continue;
    for (std::size_t k = 1; k < waiting.size(); ++k) {
      if (waiting[k].revents != 0) pass_back(lines_[k - 1]);
    }
    if (waiting.front().revents != 0) pass_on();
  }
}

void LossyRelay::pass_on() {
  Datagram buffer{};
  const auto received = front_.receive(buffer.data(), buffer.size(), 0.0);
  if (!received) return;
  Line& line = line_of(received->from);
  if (loses_(random_)) {
    ++lost_;
    return;
  }
  line.socket.send_to(target_,
                      protocol::Bytes(buffer).first(std::min(received->size, buffer.size())));
}

void LossyRelay::pass_back(Line& line) {
  Datagram buffer{};
  const auto received = line.socket.receive(buffer.data(), buffer.size(), 0.0);
  if (!received || loses_(random_)) return;
  front_.send_to(line.peer, protocol::Bytes(buffer).first(std::min(received->size, buffer.size())));
}

LossyRelay::Line& LossyRelay::line_of(const protocol::Endpoint& peer) {
  const auto known = std::find_if(lines_.begin(), lines_.end(),
                                  [&](const Line& line) { return line.peer == peer; });
  if (known != lines_.end()) return *known;
  if (lines_.size() == kMostLines) {
    // Sockets cannot be assigned: the others move into a new list.
    std::vector<Line> younger;
    for (std::size_t k = 1; k < lines_.size(); ++k) younger.push_back(std::move(lines_[k]));
    lines_.swap(younger);
  }
  lines_.push_back({peer, protocol::UdpSocket({INADDR_LOOPBACK, 0})});
  return lines_.back();
}

}  // namespace splash::tests
