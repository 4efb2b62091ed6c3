// SPDX-License-Identifier: MIT
// Both ends on hosts whose clocks go wrong: when does each event sound, against when it should?
#pragma once

#include <functional>
#include <vector>

#include "protocol/udp_socket.hpp"
#include "synth-server/play/player.hpp"

namespace splash::network {

/// Error of a host's clock at a true time since the start [s].
using ClockError = std::function<double(double)>;

struct Clocks {
  ClockError simulator = [](double) { return 0.0; };
  ClockError synth = [](double) { return 0.0; };
  bool same_host = false;
  bool answers_pings = true;  ///< a simulator of another make may not
};

struct Sounded {
  double at = 0.0;     ///< true time at which the event was handed over [s]
  double error = 0.0;  ///< by how much its moment is off, positive: it sounds late [s]
};

struct ClockReport {
  std::vector<Sounded> events;
  synth::PlayerCounters player;

  /// Largest magnitude of the error in [from, to) [s].
  [[nodiscard]] double worst(double from, double to) const;
};

/// A steady stream, each event up to 40 ms ahead, over a network that takes 5 to 16 ms.
[[nodiscard]] ClockReport run_clocks(const Clocks& clocks, double seconds);

}  // namespace splash::network
