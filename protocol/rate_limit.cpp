// SPDX-License-Identifier: MIT
// The buckets stand in a short list, since the allowed peers are few. A flood from ever new ports
// would get a fresh bucket each, so a peer that displaces another starts with an empty one.
#include "protocol/rate_limit.hpp"

#include <algorithm>

namespace splash::protocol {

bool RateLimit::allow(const Endpoint& peer, double now) {
  Bucket& bucket = bucket_of(is_loopback(peer) ? peer : Endpoint{peer.address, 0}, now);
  const double elapsed = std::max(0.0, now - bucket.updated);
  bucket.tokens = std::min(burst_, bucket.tokens + rate_ * elapsed);
  bucket.updated = now;
  if (bucket.tokens < 1.0) return false;
  bucket.tokens -= 1.0;
  return true;
}

RateLimit::Bucket& RateLimit::bucket_of(const Endpoint& peer, double now) {
  const auto known = std::find_if(buckets_.begin(), buckets_.end(),
                                  [&](const Bucket& bucket) { return bucket.peer == peer; });
  if (known != buckets_.end()) return *known;
  if (buckets_.size() < kMaxPeers) {
    return buckets_.emplace_back(Bucket{.peer = peer, .tokens = burst_, .updated = now});
  }
  const auto oldest =
      std::min_element(buckets_.begin(), buckets_.end(),
                       [](const Bucket& a, const Bucket& b) { return a.updated < b.updated; });
  // Its rest counts as the newcomer's: nothing when the list is churned quickly.
  *oldest = {.peer = peer, .tokens = 0.0, .updated = oldest->updated};
  return *oldest;
}

}  // namespace splash::protocol
