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

  /// A bundle sent at `sent` by the sender's clock came at `arrival` by ours [s]. In their order:
  /// what was overtaken says nothing of the clock. True: one of the clocks was set, and what was
  /// known of them is forgotten. `unix_now`: ours [s].
  bool observe(double sent, double arrival, double unix_now) noexcept;
  /// The four stamps of a ping and its pong [s, Unix]: t0 and t3 ours, t1 and t2 the sender's.
  void pong(double t0, double t1, double t2, double t3);
  /// The sender was restarted: its bundles' delays say nothing any more.
  void restart() noexcept;

  /// What to add to the sender's times to have ours [s]; 0 while the clocks agree.
  /// `unix_now`: ours [s].
  [[nodiscard]] double correction(double unix_now) const noexcept;

 private:
  /// Bundles in a row that seem to have travelled for too long, and all for as long.
  struct LateRun {
    int bundles = 0;
    double since = 0.0;  ///< arrival of the first [s]
    double least = 0.0;  ///< shortest travel among them [s]
    double most = 0.0;   ///< longest [s]
  };

  [[nodiscard]] double correction_by_arrival() const noexcept;
  /// Whether a bundle that travelled for `travel`, corrected, shows that a clock was set [s].
  [[nodiscard]] bool shows_step(double travel, double arrival) noexcept;

  bool same_host_;
  protocol::ClockEstimate estimate_;
  /// Shortest time from sending to arrival in this and the last span of kWindow [s].
  double shortest_ = std::numeric_limits<double>::infinity();
  double shortest_before_ = std::numeric_limits<double>::infinity();
  double window_start_ = 0.0;
  LateRun late_;
};

}  // namespace splash::synth
