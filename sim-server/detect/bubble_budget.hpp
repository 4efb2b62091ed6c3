// SPDX-License-Identifier: MIT
// How many bubbles may be told: so many a second, and what a quiet moment leaves serves the next
// burst.
#pragma once

namespace splash::sim {

class BubbleBudget {
 public:
  /// `rate` [1/s].
  explicit BubbleBudget(double rate);

  /// Whole bubbles that may be told at `time` [s].
  [[nodiscard]] int open(double time);
  void set_rate(double rate) noexcept { rate_ = rate; }  ///< [1/s]
  /// So many were.
  void spend(int told) { left_ -= told; }

 private:
  double rate_;  ///< [1/s]
  double left_;
  double filled_ = 0.0;  ///< until then [s]
};

}  // namespace splash::sim
