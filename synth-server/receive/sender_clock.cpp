// SPDX-License-Identifier: MIT
#include "synth-server/receive/sender_clock.hpp"

#include <algorithm>
#include <cmath>

namespace splash::synth {
namespace {

/// Clocks that agree this well are left alone: the estimate is no better than that [s].
constexpr double kAgreement = 0.005;
/// Bundles travel at most this long in a network fit for the purpose [s].
constexpr double kLongestTravel = 0.025;
/// On one host, bundles wait in a busy receiver's socket, but never so long [s].
constexpr double kNonsense = 2.0;
/// The shortest delay is remembered for one to two of these, so that drift is followed [s].
constexpr double kWindow = 5.0;

}  // namespace

SenderClock::SenderClock(bool same_host) noexcept : same_host_(same_host) {}

void SenderClock::restart() noexcept {
  shortest_ = std::numeric_limits<double>::infinity();
  shortest_before_ = shortest_;
}

void SenderClock::observe(double sent, double arrival) noexcept {
  if (arrival - window_start_ > kWindow) {
    shortest_before_ = shortest_;
    shortest_ = std::numeric_limits<double>::infinity();
    window_start_ = arrival;
  }
  shortest_ = std::min(shortest_, arrival - sent);
}

void SenderClock::pong(double t0, double t1, double t2, double t3) {
  estimate_.add(t0, t1, t2, t3);
}

double SenderClock::correction_by_arrival() const noexcept {
  const double travel = std::min(shortest_, shortest_before_);
  const double least = same_host_ ? -kNonsense : -kAgreement;
  const double most = same_host_ ? kNonsense : kLongestTravel;
  const bool plausible = !std::isfinite(travel) || (travel >= least && travel <= most);
  return plausible ? 0.0 : travel;
}

double SenderClock::correction(double unix_now) const noexcept {
  if (!estimate_.ready()) return correction_by_arrival();
  const double offset = estimate_.offset_at(unix_now);
  const double doubt = 0.5 * estimate_.round_trip();
  return std::abs(offset) <= kAgreement + doubt ? 0.0 : -offset;
}

}  // namespace splash::synth
