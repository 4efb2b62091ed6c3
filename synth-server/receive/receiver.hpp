// SPDX-License-Identifier: MIT
// The receiving thread: takes datagrams from the socket, sends replies, never dies of a packet.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "program/text_limit.hpp"
#include "protocol/udp_socket.hpp"
#include "synth-server/receive/intake.hpp"

namespace splash::synth {

class Receiver {
 public:
  /// `log` gets lines for people: refused datagrams and questions that are too short for their
  /// answers (at most one line a second of each), and /dumpOSC's.
  Receiver(protocol::UdpSocket socket, CommandQueue& queue, Control control,
           std::function<void(const std::string&)> log);
  /// Says goodbye to the clients.
  ~Receiver();
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  [[nodiscard]] protocol::Endpoint local() const noexcept { return socket_.local(); }
  [[nodiscard]] IntakeCounters counters() const;
  [[nodiscard]] bool sender_present() const;
  /// How often the thread has looked, fifty times a second at least.
  [[nodiscard]] std::uint64_t turns() const noexcept { return turns_; }
  /// Datagrams the kernel dropped because they came faster than they were read.
  [[nodiscard]] std::uint64_t dropped_by_kernel() const noexcept { return dropped_by_kernel_; }

 private:
  void run();
  /// How long to wait for a datagram [s].
  [[nodiscard]] double limits() const noexcept;
  void take(const protocol::UdpSocket::Received& received, std::vector<Reply>& replies);
  void send(std::vector<Reply>& replies);
  void dump(protocol::Bytes bytes, const protocol::Endpoint& from);
  /// Whether a line may be said of which the last was due before `next`: once a second at most,
  /// whatever comes, and not at all after /error 0.
  [[nodiscard]] bool is_due(double& next) const;
  [[nodiscard]] std::uint64_t rejected() const;

  protocol::UdpSocket socket_;
  std::function<void(const std::string&)> log_;
  mutable std::mutex mutex_;  ///< guards intake_; the audio thread never takes it
  Intake intake_;
  std::vector<std::byte> buffer_;
  program::TextLimit dumped_;
  double next_refusal_ = 0.0;     ///< when the next line on one is due [s, monotonic]
  double next_unanswered_ = 0.0;  ///< same
  std::atomic<std::uint64_t> dropped_by_kernel_{0};
  std::atomic<std::uint64_t> turns_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace splash::synth
