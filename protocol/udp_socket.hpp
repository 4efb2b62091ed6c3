// SPDX-License-Identifier: MIT
// The UDP socket of both servers, with a large receive buffer and a count of the datagrams that the
// kernel dropped.
#pragma once

#include <netinet/in.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "program/failure.hpp"
#include "protocol/gate.hpp"
#include "protocol/time_tag.hpp"

namespace splash::protocol {

/// An IPv4 address and port.
struct Endpoint {
  std::uint32_t address = INADDR_LOOPBACK;  ///< host byte order
  std::uint16_t port = 0;
  bool operator==(const Endpoint&) const = default;
};

/// Whether the address is in 127.0.0.0/8, which always is this host itself.
[[nodiscard]] constexpr bool is_loopback(const Endpoint& endpoint) noexcept {
  return endpoint.address >> 24U == 127U;
}

/// "host:port", ":port", "port" or "host" -> Endpoint; names are resolved.
/// Throws std::invalid_argument with the text, the cause and an example.
[[nodiscard]] Endpoint parse_endpoint(const std::string& text, std::uint16_t default_port);
/// The same for the value of an option, which the exception names, too.
[[nodiscard]] Endpoint endpoint_of(const std::string& option, const std::string& text,
                                   std::uint16_t default_port);
[[nodiscard]] std::string to_string(const Endpoint& endpoint);

/// A port cannot be had. The text names it, the cause and what to do.
class SocketError : public program::Failure {
 public:
  explicit SocketError(const std::string& text) : Failure(program::kExitUnavailable, text) {}
};

class UdpSocket {
 public:
  /// Binds to `local` (port 0: a free one). Throws SocketError.
  explicit UdpSocket(const Endpoint& local);
  ~UdpSocket();
  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&&) = delete;
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// Returns false when the kernel refused the datagram (no route, buffer full). UDP may lose
  /// datagrams: the caller counts.
  bool send_to(const Endpoint& peer, Bytes packet) noexcept;

  struct Received {
    std::size_t size = 0;  ///< of the whole datagram, may exceed the buffer's [bytes]
    Endpoint from;
    /// When the kernel took it, or when it was read where that is not known.
    ClockReading arrival;
  };
  /// Waits up to `timeout` seconds (0: not at all) for one datagram. Returns nothing when the wait
  /// is interrupted.
  [[nodiscard]] std::optional<Received> receive(std::byte* buffer, std::size_t capacity,
                                                double timeout) noexcept;

  [[nodiscard]] Endpoint local() const noexcept { return local_; }
  [[nodiscard]] std::uint64_t dropped_by_kernel() const noexcept { return dropped_; }
  /// The receive buffer that the kernel granted, its own overhead included [bytes].
  [[nodiscard]] std::size_t receive_buffer() const noexcept;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  int descriptor_ = -1;
  Endpoint local_;
  std::uint64_t dropped_ = 0;
};

}  // namespace splash::protocol
