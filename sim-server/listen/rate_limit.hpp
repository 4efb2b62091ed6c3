// SPDX-License-Identifier: MIT
// A token bucket for each peer: nobody draws more replies, or lines in the terminal, than a person
// or a clock needs, and one who floods takes none from the others.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/udp_socket.hpp"

namespace splash::sim {

class RateLimit {
 public:
  static constexpr double kRate = 20.0;         ///< per second, in the long run [1/s]
  static constexpr double kBurst = 40.0;        ///< at once after a rest
  static constexpr std::size_t kMaxPeers = 64;  ///< remembered; the one idle for longest goes

  /// Whether `peer` may have one more at `now` (monotonic [s]); takes a token when it may.
  [[nodiscard]] bool allow(const protocol::Endpoint& peer, double now);

 private:
  struct Bucket {
    protocol::Endpoint peer;
    double tokens = kBurst;
    double updated = 0.0;  ///< monotonic [s]
  };
  Bucket& bucket_of(const protocol::Endpoint& peer, double now);

  std::vector<Bucket> buckets_;
};

}  // namespace splash::sim
