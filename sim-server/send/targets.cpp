// SPDX-License-Identifier: MIT
// The list of targets behind one lock, held for microseconds: sending to UDP does not wait.
#include "sim-server/send/targets.hpp"

#include <algorithm>
#include <utility>

namespace splash::sim {
namespace {

auto find(std::vector<Target>& targets, const protocol::Endpoint& endpoint) {
  return std::find_if(targets.begin(), targets.end(),
                      [&](const Target& target) { return target.endpoint == endpoint; });
}

}  // namespace

Targets::Targets(const std::vector<protocol::Endpoint>& fixed, Clock clock)
    : clock_(std::move(clock)) {
  for (const auto& endpoint : fixed) {
    if (find(targets_, endpoint) == targets_.end()) targets_.push_back({.endpoint = endpoint});
  }
}

bool Targets::subscribe(const protocol::Endpoint& endpoint, unsigned streams) {
  const std::lock_guard lock(mutex_);
  drop_expired();
  const double expires = clock_() + kSubscriptionLease;
  if (const auto known = find(targets_, endpoint); known != targets_.end()) {
    known->expires = expires;
    known->streams = known->fixed ? streams | kEventStream : streams;
    return true;
  }
  const auto subscribers = std::count_if(targets_.begin(), targets_.end(),
                                         [](const Target& target) { return !target.fixed; });
  if (static_cast<std::size_t>(subscribers) >= kMaxSubscribers) return false;
  targets_.push_back(
      {.endpoint = endpoint, .fixed = false, .expires = expires, .streams = streams});
  return true;
}

bool Targets::unsubscribe(const protocol::Endpoint& endpoint) {
  const std::lock_guard lock(mutex_);
  const auto known = find(targets_, endpoint);
  if (known == targets_.end()) return false;
  if (known->fixed) {
    known->streams = kEventStream;
    return false;
  }
  targets_.erase(known);
  return true;
}

void Targets::renew(const protocol::Endpoint& endpoint) {
  const std::lock_guard lock(mutex_);
  const auto known = find(targets_, endpoint);
  if (known != targets_.end()) known->expires = clock_() + kSubscriptionLease;
}

/// Of those named at start the lease bounds what they asked for besides.
bool Targets::takes(const Target& target, unsigned stream) const {
  if ((target.streams & stream) == 0) return false;
  return stream == kEventStream || target.expires >= clock_();
}

bool Targets::wants(unsigned stream) {
  const std::lock_guard lock(mutex_);
  drop_expired();
  return std::any_of(targets_.begin(), targets_.end(),
                     [&](const Target& target) { return takes(target, stream); });
}

void Targets::send(protocol::UdpSocket& socket, protocol::Bytes packet, unsigned stream) {
  const std::lock_guard lock(mutex_);
  drop_expired();
  for (auto& target : targets_) {
    if (!takes(target, stream)) continue;
    ++(socket.send_to(target.endpoint, packet) ? target.sent : target.failed);
  }
}

void Targets::tell(protocol::UdpSocket& socket, protocol::Bytes packet) {
  const std::lock_guard lock(mutex_);
  drop_expired();
  for (auto& target : targets_) {
    if (target.fixed || !takes(target, kEventStream)) continue;
    ++(socket.send_to(target.endpoint, packet) ? target.sent : target.failed);
  }
}

std::vector<Target> Targets::list() const {
  const std::lock_guard lock(mutex_);
  return targets_;
}

void Targets::drop_expired() {
  const double now = clock_();
  std::erase_if(targets_,
                [now](const Target& target) { return !target.fixed && target.expires < now; });
}

protocol::Endpoint sending_endpoint(const std::vector<protocol::Endpoint>& targets,
                                    const protocol::Endpoint& listening) {
  const bool stays_here =
      is_loopback(listening) && std::all_of(targets.begin(), targets.end(),
                                            [](const auto& target) { return is_loopback(target); });
  return {.address = stays_here ? INADDR_LOOPBACK : INADDR_ANY, .port = 0};
}

}  // namespace splash::sim
