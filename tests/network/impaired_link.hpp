// SPDX-License-Identifier: MIT
// A bad network inside a test: datagrams are lost, doubled, held back, delayed unevenly, and for a
// while nothing passes at all. Seeded, on a clock of ticks, so that every run can be repeated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

namespace splash::network {

using Datagram = std::vector<std::byte>;

struct Impairments {
  double loss = 0.0;         ///< part of the datagrams (of each copy) that never arrive [1]
  double duplication = 0.0;  ///< part of which two copies are under way [1]
  double reordering = 0.0;  ///< part that waits until up to `reorder_span` later ones were sent [1]
  int reorder_span = 32;    ///< [datagrams]
  int jitter = 0;           ///< each copy takes 1 to 1 + jitter [ticks]
  int outage_from = 0;      ///< [tick]
  int outage_to = 0;        ///< nothing enters or leaves the link before this [tick]
};

class ImpairedLink {
 public:
  ImpairedLink(const Impairments& impairments, std::uint32_t seed);

  void send(const Datagram& datagram, int tick);
  /// What comes out at `tick`, in the order of its coming. To be called for each tick.
  [[nodiscard]] std::vector<Datagram> arrivals(int tick);
  /// From now on nothing is impaired; what was held back is sent.
  void heal(int tick);

 private:
  struct Held {
    Datagram datagram;
    int until = 0;  ///< number of the datagram behind which it follows
  };

  [[nodiscard]] bool chance(double part);
  [[nodiscard]] int below(int limit);
  void dispatch(const Datagram& datagram, int tick);
  void release(int tick, bool all);
  [[nodiscard]] bool out(int tick) const;

  Impairments impairments_;
  std::mt19937 random_;
  int sent_ = 0;
  std::vector<Held> held_;
  std::map<int, std::vector<Datagram>> under_way_;  ///< by the tick of their arrival
};

}  // namespace splash::network
