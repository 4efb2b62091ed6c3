// SPDX-License-Identifier: MIT
#include "synth-server/receive/sender.hpp"

#include <algorithm>
#include <limits>

namespace splash::synth {
namespace {

/// A synth listens to one simulator, a few in a workshop; strangers must not fill the memory.
constexpr std::size_t kMostSenders = 16;

void add(SequenceTotals& totals, const protocol::SequenceWatch& watch) noexcept {
  totals.received += watch.received();
  totals.lost += watch.lost();
  totals.duplicates += watch.duplicates();
  totals.reordered += watch.reordered();
  totals.sessions += watch.sessions();
}

}  // namespace

Sender* SenderTable::find(const protocol::Endpoint& from) noexcept {
  const auto found = std::find_if(senders_.begin(), senders_.end(),
                                  [&](const Sender& sender) { return sender.endpoint == from; });
  return found == senders_.end() ? nullptr : &*found;
}

Sender& SenderTable::at(const protocol::Endpoint& from) {
  if (Sender* known = find(from)) return *known;
  if (senders_.size() == kMostSenders) {
    const auto oldest =
        std::min_element(senders_.begin(), senders_.end(),
                         [](const Sender& a, const Sender& b) { return a.heard < b.heard; });
    add(forgotten_, oldest->sequence);
    senders_.erase(oldest);
  }
  return senders_.emplace_back(from);
}

bool SenderTable::expire(double now) noexcept {
  bool ended = false;
  for (Sender& sender : senders_) {
    if (!sender.present || now < sender.heard + kLease) continue;
    sender.present = false;
    ended = true;
  }
  return ended && !anybody_present();
}

double SenderTable::next_expiry() const noexcept {
  double next = std::numeric_limits<double>::infinity();
  for (const Sender& sender : senders_) {
    if (sender.present) next = std::min(next, sender.heard + kLease);
  }
  return next;
}

bool SenderTable::anybody_present() const noexcept {
  return std::any_of(senders_.begin(), senders_.end(),
                     [](const Sender& sender) { return sender.present; });
}

SequenceTotals SenderTable::totals() const noexcept {
  SequenceTotals totals = forgotten_;
  for (const Sender& sender : senders_) add(totals, sender.sequence);
  return totals;
}

}  // namespace splash::synth
