// SPDX-License-Identifier: MIT
// Another host in a test: packets sent from this address of the machine to itself never leave it,
// but do not come from 127.0.0.0/8.
#pragma once

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <cstdint>
#include <optional>

#include "protocol/udp_socket.hpp"

namespace splash::tests {

/// nullopt: this machine has no address besides loopback.
inline std::optional<std::uint32_t> own_address() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return std::nullopt;
  std::optional<std::uint32_t> found;
  for (const auto* item = list; item != nullptr; item = item->ifa_next) {
    if (item->ifa_addr == nullptr || item->ifa_addr->sa_family != AF_INET) continue;
    const auto* ip = reinterpret_cast<const sockaddr_in*>(item->ifa_addr);
    const auto address = ntohl(ip->sin_addr.s_addr);
    if (!is_loopback(protocol::Endpoint{address, 0})) found = address;
  }
  freeifaddrs(list);
  return found;
}

}  // namespace splash::tests
