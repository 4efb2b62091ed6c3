// SPDX-License-Identifier: MIT
#include "sim-server/simulation/recovery/recovery.hpp"

#include <algorithm>

namespace splash::sim {
namespace {

constexpr double kLeastShare = 1.0 / 8.0;  ///< three times halved
constexpr double kGrowth = 1.1;            ///< per sound frame: doubled after 8 of them

}  // namespace

Remedy Recovery::failed() noexcept {
  share_ = std::max(share_ / 2.0, kLeastShare);
  if (failed_ < kTries) {
    ++failed_;
    return Remedy::retry;
  }
  failed_ = 0;
  ++given_up_;
  if (given_up_ < kFramesGivenUp) return Remedy::calm;
  given_up_ = 0;
  return Remedy::reset;
}

void Recovery::succeeded() noexcept {
  failed_ = 0;
  given_up_ = 0;
  share_ = std::min(share_ * kGrowth, 1.0);
}

}  // namespace splash::sim
