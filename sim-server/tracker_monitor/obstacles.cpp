// SPDX-License-Identifier: MIT
#include "sim-server/tracker_monitor/obstacles.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
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

// Two lines of the same name: what the columns are called, and their numbers.
std::map<std::string, std::uint64_t> counters_of(const std::filesystem::path& path,
                                                 const std::string& name) {
  std::ifstream file(path);
  std::vector<std::string> names;
  std::map<std::string, std::uint64_t> counters;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; words >> word;) row.push_back(word);
    if (row.empty() || row.front() != name) continue;
    for (std::size_t i = 1; i < row.size() && i < names.size(); ++i) {
      counters[names[i]] = std::strtoull(row[i].c_str(), nullptr, 10);
    }
    names = row;
  }
  return counters;
}

}  // namespace

Missed missed(const SystemFiles& files) {
  const auto udp = counters_of(files.counters, "Udp:");
  auto ip = counters_of(files.counters, "Ip:");
  // What else became of a packet that was received; a filter counts nowhere.
  std::uint64_t known = ip["ReasmReqds"] - std::min(ip["ReasmOKs"], ip["ReasmReqds"]);
  for (const char* name : {"InHdrErrors", "InAddrErrors", "ForwDatagrams", "InUnknownProtos",
                           "InDiscards", "InDelivers"}) {
    known += ip[name];
  }
  const auto no_ports = udp.find("NoPorts");
  return {.unwanted = no_ports == udp.end() ? 0 : no_ports->second,
          .filtered = ip["InReceives"] > known ? ip["InReceives"] - known : 0};
}

std::string obstacles(const std::vector<std::uint16_t>& ports, const Missed& since,
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
  if (since.filtered > 0) {
    text += std::to_string(since.filtered) +
            " packets reached this host and were not let in: a firewall drops them (sudo nft list "
            "ruleset shows its rules); UDP is wanted at" +
            list_of(ports, " ", "") + '\n';
  }
  if (since.unwanted > 0) {
    text += std::to_string(since.unwanted) +
            " datagrams came for ports of this host where nobody listens: is the sender's port one "
            "of those above? (./splash listen PORT listens at another)\n";
  }
  return text;
}

}  // namespace splash::sim
