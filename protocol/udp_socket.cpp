// SPDX-License-Identifier: MIT
// BSD sockets, plainly: never SO_REUSEADDR, so two programs cannot share a port by mistake.
#include "protocol/udp_socket.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

#include "protocol/time_tag.hpp"

namespace splash::protocol {
namespace {

constexpr int kWantedBuffer = 4 << 20;   // bytes, as scsynth asks; the kernel may grant less
constexpr double kLongestWait = 3600.0;  // [s]

sockaddr_in to_sockaddr(const Endpoint& endpoint) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(endpoint.address);
  address.sin_port = htons(endpoint.port);
  return address;
}

Endpoint to_endpoint(const sockaddr_in& address) {
  return {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
}

std::invalid_argument bad_endpoint(const std::string& text, const std::string& cause) {
  return std::invalid_argument("'" + text + "' is no host:port: " + cause +
                               "; write for example 127.0.0.1:57310 or :57310");
}

std::uint16_t parse_port(const std::string& text, const std::string& port) {
  unsigned value = 0;
  const char* end = port.data() + port.size();
  const auto [stop, error] = std::from_chars(port.data(), end, value);
  if (port.empty() || stop != end || error != std::errc{} || value > 65535) {
    throw bad_endpoint(text, "port '" + port + "' is not a number in 0..65535");
  }
  return static_cast<std::uint16_t>(value);
}

/// `text` is what the person wrote, `host` the name in it.
std::uint32_t resolve(const std::string& text, const std::string& host) {
  // By its name, too: a bare system has no /etc/hosts to ask (RFC 6761, section 6.3).
  if (host.empty() || host == "localhost") return INADDR_LOOPBACK;
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, &hints, &found);
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> guard(found, &freeaddrinfo);
  if (error != 0) {
    throw std::invalid_argument("'" + text + "': host '" + host + "': " + gai_strerror(error) +
                                "; write another name, or an IPv4 address as 127.0.0.1");
  }
  sockaddr_in address{};
  std::memcpy(&address, found->ai_addr, sizeof address);
  return ntohl(address.sin_addr.s_addr);
}

std::string why_not_bound(const Endpoint& local, int error) {
  switch (error) {
    case EADDRINUSE:
      return ", another program holds it; use --listen host:port with a port that is free, or "
             "port 0";
    case EADDRNOTAVAIL:
      return "; use --listen with an address of this host ('ip address' lists them), with "
             "127.0.0.1 or, for all of them, 0.0.0.0";
    case EACCES:
      return local.port < 1024 ? "; use --listen with a port of 1024 or above" : "";
    default:
      return "; use --listen with another host:port";
  }
}

SocketError cannot_bind(const Endpoint& local, int error) {
  return SocketError("cannot listen on UDP port " + std::to_string(local.port) + " (" +
                     to_string(local) + "): " + std::strerror(error) + why_not_bound(local, error));
}

void apply_options(int descriptor) {
  const int on = 1;
  // All may be refused without harm: smaller buffers, drops that are not counted. The sending one
  // must hold what the kernel keeps for hosts that do not answer its ARP (208 KiB each, for
  // seconds), else two of them cut off all others.
  (void)setsockopt(descriptor, SOL_SOCKET, SO_SNDBUF, &kWantedBuffer, sizeof kWantedBuffer);
  (void)setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &kWantedBuffer, sizeof kWantedBuffer);
  (void)setsockopt(descriptor, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
  (void)setsockopt(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
}

// What the kernel says of a datagram besides its bytes.
template <class Value>
std::optional<Value> said_of(msghdr& header, int type) {
  for (cmsghdr* item = CMSG_FIRSTHDR(&header); item != nullptr; item = CMSG_NXTHDR(&header, item)) {
    if (item->cmsg_level == SOL_SOCKET && item->cmsg_type == type) {
      Value value{};
      std::memcpy(&value, CMSG_DATA(item), sizeof value);
      return value;
    }
  }
  return std::nullopt;
}

// When the kernel took a datagram. Its stamp is the system clock's, which may have been set.
ClockReading taken_at(const std::optional<timespec>& stamp) {
  constexpr double kLongest = 60.0;  // [s]
  const ClockReading now = read_clocks();
  if (!stamp) return now;
  const double then =
      static_cast<double>(stamp->tv_sec) + 1e-9 * static_cast<double>(stamp->tv_nsec);
  const double waited = now.unix_time - then;
  if (!(waited > 0.0 && waited < kLongest)) return now;
  return {now.monotonic - waited, now.unix_time - waited};
}

bool wait_readable(int descriptor, double timeout) {
  const double seconds = timeout > 0.0 ? std::min(timeout, kLongestWait) : 0.0;
  timespec limit{};
  limit.tv_sec = static_cast<time_t>(seconds);
  limit.tv_nsec = static_cast<long>((seconds - static_cast<double>(limit.tv_sec)) * 1e9);
  pollfd readable{descriptor, POLLIN, 0};
  return ppoll(&readable, 1, &limit, nullptr) > 0;
}

}  // namespace

Endpoint parse_endpoint(const std::string& text, std::uint16_t default_port) {
  if (text.empty()) throw bad_endpoint(text, "it is empty");
  if (text.find_first_not_of("0123456789") == std::string::npos) {
    return {resolve(text, ""), parse_port(text, text)};
  }
  const auto colon = text.find(':');
  if (colon == std::string::npos) return {resolve(text, text), default_port};
  if (text.find(':', colon + 1) != std::string::npos) {
    throw bad_endpoint(text, "more than one ':' (IPv6 is not supported)");
  }
  const auto port = parse_port(text, text.substr(colon + 1));
  return {resolve(text, text.substr(0, colon)), port};
}

Endpoint endpoint_of(const std::string& option, const std::string& text,
                     std::uint16_t default_port) {
  try {
    return parse_endpoint(text, default_port);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(option + " " + error.what());
  }
}

std::string to_string(const Endpoint& endpoint) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += std::to_string(endpoint.address >> static_cast<unsigned>(shift) & 0xffU);
    text += shift > 0 ? '.' : ':';
  }
  return text + std::to_string(endpoint.port);
}

UdpSocket::UdpSocket(const Endpoint& local)
    : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (descriptor_ < 0) {
    throw SocketError(std::string("cannot open a UDP socket: ") + std::strerror(errno));
  }
  apply_options(descriptor_);
  auto address = to_sockaddr(local);
  socklen_t size = sizeof address;
  if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    const int error = errno;
    close(descriptor_);
    throw cannot_bind(local, error);
  }
  local_ = to_endpoint(address);
}

UdpSocket::~UdpSocket() {
  if (descriptor_ >= 0) close(descriptor_);
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      local_(other.local_),
      dropped_(other.dropped_) {}

bool UdpSocket::send_to(const Endpoint& peer, Bytes packet) noexcept {
  const auto address = to_sockaddr(peer);
  ssize_t sent = -1;
  do {
    sent = sendto(descriptor_, packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&address), sizeof address);
  } while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(packet.size());
}

std::optional<UdpSocket::Received> UdpSocket::receive(std::byte* buffer, std::size_t capacity,
                                                      double timeout) noexcept {
  if (!wait_readable(descriptor_, timeout)) return std::nullopt;
  sockaddr_in from{};
  iovec block{buffer, capacity};
  alignas(cmsghdr) std::byte control[128];
  msghdr header{};
  header.msg_name = &from;
  header.msg_namelen = sizeof from;
  header.msg_iov = &block;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  // MSG_TRUNC makes the kernel tell the datagram's real size.
  const ssize_t size = recvmsg(descriptor_, &header, MSG_TRUNC | MSG_DONTWAIT);
  if (size < 0) return std::nullopt;
  // The kernel's count has 32 bits: add what it moved by.
  // Total of datagrams dropped for a full buffer.
  if (const auto count = said_of<std::uint32_t>(header, SO_RXQ_OVFL))
    dropped_ += *count - static_cast<std::uint32_t>(dropped_);
  return Received{static_cast<std::size_t>(size), to_endpoint(from),
                  taken_at(said_of<timespec>(header, SCM_TIMESTAMPNS))};
}

std::size_t UdpSocket::receive_buffer() const noexcept {
  int granted = 0;
  socklen_t size = sizeof granted;
  if (getsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &granted, &size) != 0) return 0;
  return static_cast<std::size_t>(granted);
}

}  // namespace splash::protocol
