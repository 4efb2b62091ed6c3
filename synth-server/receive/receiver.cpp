// SPDX-License-Identifier: MIT
#include "synth-server/receive/receiver.hpp"

#include <algorithm>
#include <utility>

#include "protocol/time_tag.hpp"
#include "synth-server/receive/oscpack_reader.hpp"
#include "synth-server/receive/packet_text.hpp"

namespace splash::synth {
namespace {

/// Pings, and a host's clock that was set, are looked after this often; leases to the point [s].
constexpr double kTick = 0.02;
/// A flood must not keep leases and pings from being looked after [datagrams].
constexpr int kMostBetweenTicks = 256;
/// One byte more than any datagram has: nothing is cut off unseen.
constexpr std::size_t kBuffer = 65536;
constexpr double kReportPeriod = 1.0;  ///< [s]

std::string complaint(const IntakeCounters& counters, const protocol::Endpoint& from) {
  std::string text = "refused from " + protocol::to_string(from) + "; so far:";
  for (std::size_t i = 0; i < counters.refusals.size(); ++i) {
    if (counters.refusals[i] == 0) continue;
    text += ' ' + std::to_string(counters.refusals[i]) + " x " +
            std::string(protocol::describe(static_cast<protocol::Refusal>(i))) + ',';
  }
  return text + ' ' + std::to_string(counters.out_of_table) + " x outside the address table, " +
         std::to_string(counters.forbidden) + " x command from a host that is not allowed";
}

}  // namespace

Receiver::Receiver(protocol::UdpSocket socket, CommandQueue& queue, Control control,
                   std::function<void(const std::string&)> log)
    : socket_(std::move(socket)),
      log_(std::move(log)),
      intake_(queue, std::move(control)),
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
    }
    send(replies);
    dropped_by_kernel_ = socket_.dropped_by_kernel();
  }
}

// Only this thread changes intake_, so it reads without the lock.
double Receiver::limits() const noexcept {
  return std::clamp(intake_.next_expiry() - protocol::monotonic_now(), 0.0, kTick);
}

// As above.
std::uint64_t Receiver::rejected() const {
  const IntakeCounters counters = intake_.counters();
  return refused(counters) + counters.forbidden;
}

void Receiver::take(const protocol::UdpSocket::Received& received, std::vector<Reply>& replies) {
  const double arrival = protocol::monotonic_now();
  const protocol::Bytes bytes(buffer_.data(), std::min(received.size, buffer_.size()));
  const std::uint64_t before = rejected();
  std::string unanswered;
  {
    const std::lock_guard lock(mutex_);
    intake_.datagram(bytes, received.from, arrival, replies);
    unanswered = intake_.take_complaint();
  }
  if (rejected() != before && is_due(next_refusal_)) {
    log_(complaint(intake_.counters(), received.from));
  }
  if (!unanswered.empty() && is_due(next_unanswered_)) log_(unanswered);
  if (intake_.control().dump_level() != 0) dump(bytes, received.from);
}

bool Receiver::is_due(double& next) const {
  const double now = protocol::monotonic_now();
  if (!intake_.control().reports_failures() || now < next) return false;
  next = now + kReportPeriod;
  return true;
}

void Receiver::dump(protocol::Bytes bytes, const protocol::Endpoint& from) {
  const double now = protocol::monotonic_now();
  const int level = intake_.control().dump_level();
  const std::string head = "osc from " + protocol::to_string(from) + ": ";
  const auto [refusal, packet] = read_packet(bytes);
  if ((level & 1) != 0) {
    dumped_.print(head + (refusal == protocol::Refusal::none
                              ? to_text(packet)
                              : "refused: " + std::string(protocol::describe(refusal))),
                  now, log_);
  }
  if ((level & 2) != 0) dumped_.print(head + to_hexadecimal(bytes), now, log_);
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
