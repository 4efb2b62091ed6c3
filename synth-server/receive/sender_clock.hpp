// SPDX-License-Identifier: MIT
// How far a sender's clock is off ours: from pings and pongs where it answers them, else from the
// quickest of its bundles. No clock is assumed to be shared, but a shared one is used as it is.
#pragma once

#include <limits>

#include "protocol/clock_estimate.hpp"

namespace splash::synth {

class SenderClock {
 public:
  /// On the same host both programs read the same clock: only a nonsensical one is corrected.
  explicit SenderClock(bool same_host) noexcept;

  /// A bundle sent at `sent` by the sender's clock came at `arrival` by ours [s].
  void observe(double sent, double arrival) noexcept;
  /// The four stamps of a ping and its pong [s, Unix]: t0 and t3 ours, t1 and t2 the sender's.
  void pong(double t0, double t1, double t2, double t3);
  /// The sender was restarted: its bundles' delays say nothing any more.
  void restart() noexcept;

  /// What to add to the sender's times to have ours [s]; 0 while the clocks agree.
  /// `unix_now`: ours [s].
  [[nodiscard]] double correction(double unix_now) const noexcept;

 private:
  [[nodiscard]] double correction_by_arrival() const noexcept;

  bool same_host_;
  protocol::ClockEstimate estimate_;
  /// Shortest time from sending to arrival in this and the last span of kWindow [s].
  double shortest_ = std::numeric_limits<double>::infinity();
  double shortest_before_ = std::numeric_limits<double>::infinity();
  double window_start_ = 0.0;
};

}  // namespace splash::synth
