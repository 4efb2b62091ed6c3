// SPDX-License-Identifier: MIT
#include "sim-server/serve/pose_senders.hpp"

#include <algorithm>

namespace splash::sim {
namespace {

/// Senders are remembered for so long, to be told of when they come back [s]; so many at most: some
/// programs send each pose from another port.
constexpr double kRemembered = 5.0;
constexpr std::size_t kMost = 16;
constexpr double kLinePeriod = 1.0;  ///< between two lines on a body [s]

}  // namespace

bool PoseSenders::lets(const protocol::Endpoint& from, double now) const {
  const auto sends = [&](const Sender& sender) { return now - sender.heard <= ends_; };
  const auto own = std::find_if(senders_.begin(), senders_.end(),
                                [&](const Sender& sender) { return sender.from == from; });
  if (own == senders_.end() || !sends(*own)) return true;
  return std::none_of(senders_.begin(), senders_.end(), [&](const Sender& other) {
    return sends(other) && other.began > own->began;
  });
}

std::optional<protocol::Endpoint> PoseSenders::hear(const protocol::Endpoint& from, double now) {
  std::erase_if(senders_, [now](const Sender& sender) { return now - sender.heard > kRemembered; });
  const auto own = std::find_if(senders_.begin(), senders_.end(),
                                [&](const Sender& sender) { return sender.from == from; });
  if (own == senders_.end()) {
    if (senders_.size() == kMost) {
      senders_.erase(
          std::min_element(senders_.begin(), senders_.end(),
                           [](const Sender& a, const Sender& b) { return a.heard < b.heard; }));
    }
    senders_.push_back({from, now, now});
    return std::nullopt;
  }
  if (now - own->heard > ends_) own->began = now;
  own->heard = now;
  const bool is_told = followed_ == from || own->told == followed_ || now < next_line_;
  if (!followed_ || is_told) return std::nullopt;
  own->told = followed_;
  next_line_ = now + kLinePeriod;
  return followed_;
}

double PoseSenders::heard() const {
  double last = -std::numeric_limits<double>::infinity();
  for (const Sender& sender : senders_) last = std::max(last, sender.heard);
  return last;
}

void PoseSenders::forget(const protocol::Endpoint& from) {
  std::erase_if(senders_, [&](const Sender& sender) { return sender.from == from; });
}

}  // namespace splash::sim
