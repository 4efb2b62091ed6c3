// SPDX-License-Identifier: MIT
// Which visitor holds which body. To the simulator all visitors are one sender, so that two of them
// are kept apart here: who took a body first has it until it lets go, leaves, or falls silent and
// another wants it.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace splash::view {

/// A visitor that sends no pose for longer than this loses its body to the next who takes it [s];
/// the simulator gives the body back to its own motion as soon.
inline constexpr double kSilent = 0.5;

class Holds {
 public:
  using Visitor = const void*;  ///< its connection; nullptr: whoever sends OSC over UDP

  /// Whether the body is the visitor's from `now` [s] on.
  bool take(std::int32_t body, Visitor visitor, double now) {
    const auto held = holds_.find(body);
    const bool free = held == holds_.end() || held->second.visitor == visitor ||
                      now - held->second.heard > kSilent;
    if (free) holds_[body] = {visitor, now};
    return free;
  }
  /// Whether a pose that the visitor sends at `now` [s] may move the body: nobody else holds it.
  bool moves(std::int32_t body, Visitor visitor, double now) {
    const auto held = holds_.find(body);
    if (held == holds_.end()) return true;
    if (held->second.visitor != visitor) return false;
    held->second.heard = now;
    return true;
  }
  /// Whether the visitor may let go of the body: nobody else holds it.
  bool let_go(std::int32_t body, Visitor visitor) {
    const auto held = holds_.find(body);
    if (held == holds_.end()) return true;
    if (held->second.visitor != visitor) return false;
    holds_.erase(held);
    return true;
  }
  [[nodiscard]] std::vector<std::int32_t> of(Visitor visitor) const {
    return bodies([visitor](Visitor holder) { return holder == visitor; });
  }
  [[nodiscard]] std::vector<std::int32_t> of_others(Visitor visitor) const {
    return bodies([visitor](Visitor holder) { return holder != visitor; });
  }

 private:
  struct Hold {
    Visitor visitor = nullptr;
    double heard = 0.0;  ///< the last pose, or when it was taken [s]
  };
  template <class Counts>
  [[nodiscard]] std::vector<std::int32_t> bodies(const Counts& counts) const {
    std::vector<std::int32_t> found;
    for (const auto& [body, hold] : holds_) {
      if (counts(hold.visitor)) found.push_back(body);
    }
    return found;
  }

  std::map<std::int32_t, Hold> holds_;
};

}  // namespace splash::view
