// SPDX-License-Identifier: MIT
// The receiving thread: takes datagrams from the socket, sends replies, never dies of a packet.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "protocol/udp_socket.hpp"
#include "synth-server/receive/intake.hpp"

namespace splash::synth {

class Receiver {
 public:
  /// `allowed`: hosts whose commands are obeyed besides this one's, in host byte order. `forces`:
  /// who is asked for them.
  Receiver(protocol::UdpSocket socket, CommandQueue& queue, ControlActions actions,
           std::vector<std::uint32_t> allowed, ForceSource forces = ForceSource{});
  /// Says goodbye to the clients.
  ~Receiver();
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  [[nodiscard]] protocol::Endpoint local() const noexcept { return socket_.local(); }
  [[nodiscard]] IntakeCounters counters() const;
  [[nodiscard]] bool sender_present() const;
  /// The number of times that the thread has waited for a datagram, fifty a second at least.
  [[nodiscard]] std::uint64_t turns() const noexcept { return turns_; }
  /// Datagrams the kernel dropped because they came faster than they were read.
  [[nodiscard]] std::uint64_t dropped_by_kernel() const noexcept { return dropped_by_kernel_; }

 private:
  void run();
  /// How long to wait for a datagram [s].
  [[nodiscard]] double limits() const noexcept;
  void take(const protocol::UdpSocket::Received& received, std::vector<Reply>& replies);
  void send(std::vector<Reply>& replies);

  protocol::UdpSocket socket_;
  mutable std::mutex mutex_;  ///< guards intake_; the audio thread never takes it
  Intake intake_;
  std::vector<std::byte> buffer_;
  std::atomic<std::uint64_t> dropped_by_kernel_{0};
  std::atomic<std::uint64_t> turns_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace splash::synth
