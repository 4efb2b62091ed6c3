// SPDX-License-Identifier: MIT
// What has arrived, from whom and how often: the book that `./splash listen` keeps, and the lines
// of a scene that it offers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::sim {

class Heard {
 public:
  /// A datagram that came at `port` at `now` [s].
  void take(protocol::Bytes packet, const protocol::Endpoint& from, std::uint16_t port, double now);
  /// What was heard since the last report, one paragraph each; what is new with the lines that map
  /// it. `now` [s]; empty: nothing.
  [[nodiscard]] std::string report(double now);
  [[nodiscard]] std::uint64_t packets() const noexcept { return packets_; }

 private:
  /// One tracker's messages: an address, the types and the texts before its numbers, who sends it
  /// and where to.
  struct Key {
    std::string address;
    std::string labels;
    std::uint32_t host = 0;
    std::uint16_t port = 0;
    bool operator<(const Key& other) const {
      return std::tie(address, labels, host, port) <
             std::tie(other.address, other.labels, other.host, other.port);
    }
  };
  struct Row {
    protocol::Message last;
    std::uint16_t from_port = 0;
    std::uint64_t count = 0;  ///< since the last report
    bool told = false;        ///< the lines that map it
  };
  /// What the gate refuses of a host.
  struct Refused {
    std::uint64_t count = 0;
    protocol::Refusal why = protocol::Refusal::none;
    std::string begins;  ///< its first characters, where they are an address
  };

  void note(const protocol::Message& message, const protocol::Endpoint& from, std::uint16_t port);

  std::map<Key, Row> rows_;
  std::map<std::uint32_t, Refused> refused_;
  std::map<std::pair<std::uint32_t, std::uint16_t>, bool> ways_;  ///< hosts and ports told how
  std::uint64_t packets_ = 0;
  std::uint64_t left_out_ = 0;  ///< messages of more trackers than are kept
  double since_ = -1.0;         ///< of the last report [s]
};

/// How sim-server is started so that it takes what `host` sends to `port`; "": as it is.
[[nodiscard]] std::string how_to_take(std::uint32_t host, std::uint16_t port);

/// What a scene says so that a message moves a body: its lines, each ended by a line feed, or one
/// that says why none maps the message. Lines of YAML begin with "tracking:" or with a blank,
/// others with "#".
[[nodiscard]] std::string mapping_lines(const protocol::Message& message);

}  // namespace splash::sim
