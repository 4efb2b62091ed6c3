// SPDX-License-Identifier: MIT
// What a receiver must count, worked out from all that went into the link and came out of it: with
// every datagram in sight and no window to forget them, so by other means than the receiver's.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "tests/network/impaired_link.hpp"

namespace splash::network {

class Ledger {
 public:
  /// `latency`: of the synth; `window`: later than this an event is not played [s].
  Ledger(double latency, double window) : latency_(latency), window_(window) {}

  /// The event will sound at `moment`, in ticks.
  void note_event(std::int32_t id, double moment) { moments_[id] = moment; }
  void note_arrival(const Datagram& datagram, int tick);

  std::uint64_t bundles = 0;     ///< that came at least once
  std::uint64_t duplicates = 0;  ///< copies beyond the first
  std::uint64_t reordered = 0;   ///< that came behind a later one
  std::uint64_t late = 0;        ///< events past their moment, within the window
  std::uint64_t too_late = 0;    ///< events past the window
  std::set<std::int32_t> heard;  ///< events that came

  /// Bundles between the first heard and the newest that never came.
  [[nodiscard]] std::uint64_t lost() const;
  [[nodiscard]] std::uint64_t events() const { return heard.size(); }

 private:
  void judge(std::int32_t id, int tick);

  double latency_;
  double window_;
  std::map<std::int32_t, double> moments_;  ///< of all events [ticks]
  std::set<std::int32_t> sequences_;        ///< heard
  std::int32_t first_ = -1;
  std::int32_t newest_ = -1;
};

}  // namespace splash::network
