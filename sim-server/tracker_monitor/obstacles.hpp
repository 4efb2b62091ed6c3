// SPDX-License-Identifier: MIT
// What may keep datagrams from this host's programs: a firewall, or another port than is meant.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace splash::sim {

/// Where the kernel and the firewalls say how they are.
struct SystemFiles {
  std::filesystem::path ufw = "/etc/ufw/ufw.conf";
  std::filesystem::path firewalld = "/run/firewalld";
  std::filesystem::path counters = "/proc/net/snmp";
};

/// Datagrams that came for UDP ports where nobody listens, since the host was started; 0: not
/// known.
[[nodiscard]] std::uint64_t unwanted_datagrams(const SystemFiles& files = {});

/// Sentences, a line each, on why nothing may arrive at `ports`. `unwanted`: such datagrams since
/// it was begun to listen.
[[nodiscard]] std::string obstacles(const std::vector<std::uint16_t>& ports, std::uint64_t unwanted,
                                    const SystemFiles& files = {});

}  // namespace splash::sim
