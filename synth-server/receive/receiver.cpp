// SPDX-License-Identifier: MIT
#include "synth-server/receive/receiver.hpp"

#include <algorithm>
#include <utility>

#include "protocol/time_tag.hpp"

namespace splash::synth {
namespace {

/// Pings, and a host's clock that was set, are looked after this often; leases to the point [s].
constexpr double kTick = 0.02;
/// A flood must not keep leases and pings from being looked after [datagrams].
constexpr int kMostBetweenTicks = 256;
/// One byte more than any datagram has: nothing is cut off unseen.
constexpr std::size_t kBuffer = 65536;

}  // namespace

Receiver::Receiver(protocol::UdpSocket socket, CommandQueue& queue, ControlActions actions,
                   std::vector<std::uint32_t> allowed, ForceSource forces)
    : socket_(std::move(socket)),
      intake_(queue, std::move(actions), std::move(allowed), LocalTime{}, std::move(forces)),
      buffer_(kBuffer),
      thread_([this] { run(); }) {}

Receiver::~Receiver() {
  stopping_ = true;
  thread_.join();
  std::vector<Reply> replies;
  intake_.say_goodbye(replies);
  send(replies);
}

void Receiver::run() {
  std::vector<Reply> replies;
  int since_tick = 0;
  while (!stopping_) {
    ++turns_;
    const auto received = socket_.receive(buffer_.data(), buffer_.size(), limits());
    if (received) take(*received, replies);
    if (!received || ++since_tick >= kMostBetweenTicks) {
      since_tick = 0;
      const std::lock_guard lock(mutex_);
      intake_.tick(protocol::monotonic_now());
      intake_.tell_changes(replies);
      intake_.ask_for_forces(protocol::monotonic_now(), replies);
    }
    send(replies);
    dropped_by_kernel_ = socket_.dropped_by_kernel();
  }
}

// Only this thread changes intake_, so it reads without the lock.
double Receiver::limits() const noexcept {
  return std::clamp(intake_.next_expiry() - protocol::monotonic_now(), 0.0, kTick);
}

void Receiver::take(const protocol::UdpSocket::Received& received, std::vector<Reply>& replies) {
  const double arrival = protocol::monotonic_now();
  const protocol::Bytes bytes(buffer_.data(), std::min(received.size, buffer_.size()));
  const std::lock_guard lock(mutex_);
  intake_.datagram(bytes, received.from, arrival, replies);
}

void Receiver::send(std::vector<Reply>& replies) {
  for (const Reply& reply : replies) {
    (void)socket_.send_to(reply.to, protocol::encode(reply.message));  // UDP may lose
  }
  replies.clear();
}

IntakeCounters Receiver::counters() const {
  const std::lock_guard lock(mutex_);
  return intake_.counters();
}

bool Receiver::sender_present() const {
  const std::lock_guard lock(mutex_);
  return intake_.sender_present();
}

}  // namespace splash::synth
