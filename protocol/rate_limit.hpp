// SPDX-License-Identifier: MIT
// A token bucket for each peer: no peer draws more replies, or lines in the log, than a person or a
// clock needs, and one that floods takes none from the others.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/udp_socket.hpp"

namespace splash::protocol {

class RateLimit {
 public:
  /// The number of peers that are remembered; the one idle for longest is forgotten first.
  static constexpr std::size_t kMaxPeers = 64;

  /// `rate`: tokens per second in the long run [1/s]; `burst`: tokens at once after a rest.
  RateLimit(double rate, double burst) noexcept : rate_(rate), burst_(burst) {}

  /// Whether `peer` may have one more at `now` (monotonic [s]); takes a token when it may. On this
  /// host each port is a peer. Another host is one peer, whatever ports its datagrams name: they
  /// may be forged.
  [[nodiscard]] bool allow(const Endpoint& peer, double now);

 private:
  struct Bucket {
    Endpoint peer;
    double tokens = 0.0;
    double updated = 0.0;  ///< monotonic [s]
  };
  Bucket& bucket_of(const Endpoint& peer, double now);

  double rate_;   ///< [1/s]
  double burst_;  ///< [1]
  std::vector<Bucket> buckets_;
};

}  // namespace splash::protocol
