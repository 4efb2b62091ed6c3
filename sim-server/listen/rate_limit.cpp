// SPDX-License-Identifier: MIT
// Buckets in a short list: the allowed peers are few. A flood from ever new ports of one host would
// get a fresh bucket each, so a peer that had to displace another starts with an empty one.
#include "sim-server/listen/rate_limit.hpp"

#include <algorithm>

namespace splash::sim {

bool RateLimit::allow(const protocol::Endpoint& peer, double now) {
  Bucket& bucket = bucket_of(peer, now);
  const double elapsed = std::max(0.0, now - bucket.updated);
  bucket.tokens = std::min(kBurst, bucket.tokens + kRate * elapsed);
  bucket.updated = now;
  if (bucket.tokens < 1.0) return false;
  bucket.tokens -= 1.0;
  return true;
}

RateLimit::Bucket& RateLimit::bucket_of(const protocol::Endpoint& peer, double now) {
  const auto known = std::find_if(buckets_.begin(), buckets_.end(),
                                  [&](const Bucket& bucket) { return bucket.peer == peer; });
  if (known != buckets_.end()) return *known;
  if (buckets_.size() < kMaxPeers) {
    return buckets_.emplace_back(Bucket{.peer = peer, .tokens = kBurst, .updated = now});
  }
  const auto oldest =
      std::min_element(buckets_.begin(), buckets_.end(),
                       [](const Bucket& a, const Bucket& b) { return a.updated < b.updated; });
  // Its rest counts as the newcomer's: nothing when the list is churned quickly.
  *oldest = {.peer = peer, .tokens = 0.0, .updated = oldest->updated};
  return *oldest;
}

}  // namespace splash::sim
