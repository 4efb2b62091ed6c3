// SPDX-License-Identifier: MIT
#include "synth-server/receive/reply_limit.hpp"

#include <algorithm>

namespace splash::synth {
namespace {

constexpr std::size_t kMostHosts = 64;

}  // namespace

bool ReplyLimit::allow(std::uint32_t address, double now) {
  auto host = std::find_if(hosts_.begin(), hosts_.end(),
                           [&](const Host& known) { return known.address == address; });
  if (host == hosts_.end()) {
    if (hosts_.size() == kMostHosts) {
      hosts_.erase(std::min_element(hosts_.begin(), hosts_.end(),
                                    [](const Host& a, const Host& b) { return a.time < b.time; }));
    }
    host = hosts_.insert(hosts_.end(), {address, per_second_, now});
  }
  host->tokens = std::min(per_second_, host->tokens + per_second_ * (now - host->time));
  host->time = now;
  if (host->tokens < 1.0) return false;
  host->tokens -= 1.0;
  return true;
}

}  // namespace splash::synth
