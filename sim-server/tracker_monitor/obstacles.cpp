// SPDX-License-Identifier: MIT
#include "sim-server/tracker_monitor/obstacles.hpp"

#include <fstream>
#include <sstream>
#include <system_error>

namespace splash::sim {
namespace {

bool has_line(const std::filesystem::path& path, const std::string& wanted) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(wanted)) return true;
  }
  return false;
}

std::string list_of(const std::vector<std::uint16_t>& ports, const std::string& before,
                    const std::string& after) {
  std::string list;
  for (const std::uint16_t port : ports) list += before + std::to_string(port) + after;
  return list;
}

}  // namespace

// Two lines of the same name: what the columns are called, and their numbers.
std::uint64_t unwanted_datagrams(const SystemFiles& files) {
  std::ifstream file(files.counters);
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("Udp: ")) continue;
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; words >> word;) row.push_back(word);
    for (std::size_t i = 0; i < row.size() && i < names.size(); ++i) {
      if (names[i] == "NoPorts") return std::stoull(row[i]);
    }
    names = row;
  }
  return 0;
}

std::string obstacles(const std::vector<std::uint16_t>& ports, std::uint64_t unwanted,
                      const SystemFiles& files) {
  std::string text;
  std::error_code ignored;
  if (has_line(files.ufw, "ENABLED=yes")) {
    text += "the firewall ufw is on; it lets trackers in with:" +
            list_of(ports, " sudo ufw allow ", "/udp;") + '\n';
  }
  if (std::filesystem::exists(files.firewalld, ignored)) {
    text += "the firewall firewalld is on; it lets trackers in with: sudo firewall-cmd" +
            list_of(ports, " --add-port=", "/udp") + '\n';
  }
  if (unwanted > 0) {
    text += std::to_string(unwanted) +
            " datagrams came for ports of this host where nobody listens: is the sender's port one "
            "of those above? (./splash listen PORT listens at another)\n";
  }
  return text;
}

}  // namespace splash::sim
