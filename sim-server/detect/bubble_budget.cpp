// SPDX-License-Identifier: MIT
#include "sim-server/detect/bubble_budget.hpp"

#include <algorithm>

namespace splash::sim {
namespace {

/// What is left serves for so long [s].
constexpr double kBurst = 0.050;

double most(double rate) {
  return std::max(1.0, kBurst * rate);
}

}  // namespace

BubbleBudget::BubbleBudget(double rate) : rate_(rate), left_(most(rate)) {}

int BubbleBudget::open(double time) {
  left_ = std::min(most(rate_), left_ + rate_ * std::max(0.0, time - filled_));
  filled_ = time;
  return static_cast<int>(left_);
}

}  // namespace splash::sim
