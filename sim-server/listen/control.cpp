// SPDX-License-Identifier: MIT
// The control's thread: wait, stamp, gate, decode, obey. What the commands do is in
// control_commands.cpp.
#include "sim-server/listen/control.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

#include "protocol/arrays.hpp"
#include "protocol/time_tag.hpp"

namespace splash::sim {
namespace {

constexpr double kLookForStop = 0.1;  // [s]
/// Somewhat more than a legal datagram, so that a longer one is known as such.
constexpr std::size_t kBuffer = protocol::kMaxDatagram + 4;

/// "At once" and nothing at all, as some libraries write it, are no moments.
std::optional<double> sent_at(const std::optional<protocol::TimeTag>& tag) {
  if (!tag || tag->value <= protocol::kImmediately.value) return std::nullopt;
  return protocol::to_unix_seconds(*tag);
}

}  // namespace

ControlServer::ControlServer(const ControlSettings& settings, ControlActions actions,
                             Targets& targets)
    : settings_(settings),
      actions_(std::move(actions)),
      targets_(targets),
      socket_(settings.listen),
      thread_([this](const std::stop_token& stop) { listen(stop); }) {}

ControlCounts ControlServer::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void ControlServer::count(std::uint64_t ControlCounts::*counter) {
  const std::lock_guard lock(mutex_);
  ++(counts_.*counter);
}

void ControlServer::listen(const std::stop_token& stop) {
  std::array<std::byte, kBuffer> buffer{};
  while (!stop.stop_requested()) {
    ++turns_;
    const auto received = socket_.receive(buffer.data(), buffer.size(), kLookForStop);
    if (!received) continue;
    {
      const std::lock_guard lock(mutex_);
      ++counts_.packets;
      counts_.dropped = socket_.dropped_by_kernel();
    }
    const auto size = std::min(received->size, buffer.size());
    take(protocol::Bytes(buffer).first(size), *received);
  }
}

void ControlServer::take(protocol::Bytes packet, const protocol::UdpSocket::Received& received) {
  const protocol::Endpoint& from = received.from;
  // A busy or stopped program looks late: the kernel knows when it came.
  arrival_ = std::max(arrival_, protocol::monotonic_now() - received.waited);
  const double unix_time = protocol::unix_now() - received.waited;
  if (!is_allowed(from)) {
    count(&ControlCounts::not_allowed);
    complain(from,
             "not heard: this host is not among the allowed ones; --allow with its address lets it "
             "in");
    return;
  }
  const auto decoded = protocol::decode_with_arrays(packet);
  if (decoded.refusal != protocol::Refusal::none) {
    refuse(decoded.refusal, from);
    return;
  }
  targets_.renew(from);
  const auto level = static_cast<unsigned>(dump_level_);
  if ((level & 2U) != 0) dump(to_hexadecimal(packet), arrival_);
  protocol::ReplyBudget budget(from, packet.size());
  for (const auto& message : decoded.packet.messages) {
    if ((level & 1U) != 0) dump(protocol::to_string(from) + ' ' + to_text(message), arrival_);
    obey({message, from, arrival_, unix_time, sent_at(decoded.packet.time), budget});
  }
}

void ControlServer::dump(const std::string& line, double now) {
  if (actions_.print) dumped_.print(line, now, actions_.print);
}

void ControlServer::refuse(protocol::Refusal refusal, const protocol::Endpoint& from) {
  {
    const std::lock_guard lock(mutex_);
    ++counts_.refused[static_cast<std::size_t>(refusal)];
  }
  complain(from, "datagram refused: " + std::string(protocol::describe(refusal)));
}

/// No request may end this thread, whatever an action throws.
void ControlServer::obey(const Request& request) {
  try {
    run(request);
  } catch (const std::exception& problem) {
    fail(request, problem.what());
  }
}

bool ControlServer::is_allowed(const protocol::Endpoint& from) const {
  const auto& hosts = settings_.allowed;
  return is_loopback(from) || std::find(hosts.begin(), hosts.end(), from.address) != hosts.end();
}

void ControlServer::complain(const protocol::Endpoint& from, const std::string& text) {
  if (!complains_ || !actions_.print) return;
  if (!complaints_.allow(from, protocol::monotonic_now())) return;
  actions_.print(protocol::to_string(from) + ' ' + text);
}

}  // namespace splash::sim
