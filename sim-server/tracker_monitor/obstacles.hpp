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

/// What came to the host and to no program, since the host was started; 0: none, or not known.
struct Missed {
  std::uint64_t unwanted = 0;  ///< datagrams for UDP ports where nobody listens
  std::uint64_t filtered = 0;  ///< packets that the kernel took in and a filter did not let through
};
[[nodiscard]] Missed missed(const SystemFiles& files = {});

/// Sentences, a line each, on why nothing may arrive at `ports`. `since`: what was missed since it
/// was begun to listen.
[[nodiscard]] std::string obstacles(const std::vector<std::uint16_t>& ports, const Missed& since,
                                    const SystemFiles& files = {});

}  // namespace splash::sim
