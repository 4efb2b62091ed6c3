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
/// A bundle that comes so long before it was sent shows that a clock was set [s].
constexpr double kBeforeSent = 0.020;
/// So do bundles that come so late for so long, each as late as the other: what a network holds up
/// comes in a heap, the last ones less late than the first [s].
constexpr double kTooLong = 0.060;
constexpr double kAlike = 0.020;
constexpr double kLongEnough = 0.050;
constexpr int kBundlesEnough = 3;

}  // namespace

SenderClock::SenderClock(bool same_host) noexcept : same_host_(same_host) {}

void SenderClock::restart() noexcept {
  shortest_ = std::numeric_limits<double>::infinity();
  shortest_before_ = shortest_;
}

bool SenderClock::shows_step(double travel, double arrival) noexcept {
  const double doubt = estimate_.ready() ? 0.5 * estimate_.round_trip() : 0.0;
  if (travel < -(kBeforeSent + doubt)) return true;
  if (travel < kTooLong + doubt) {
    late_.bundles = 0;
    return false;
  }
  const double least = std::min(late_.least, travel);
  const double most = std::max(late_.most, travel);
  if (late_.bundles == 0 || most - least > kAlike) {
    late_ = {1, arrival, travel, travel};
    return false;
  }
  late_ = {late_.bundles + 1, late_.since, least, most};
  return late_.bundles >= kBundlesEnough && arrival - late_.since >= kLongEnough;
}

bool SenderClock::observe(double sent, double arrival, double unix_now) noexcept {
  const bool known = estimate_.ready() || std::isfinite(std::min(shortest_, shortest_before_));
  const double travel = arrival - sent - correction(unix_now);
  // On the same host a clock that is set is set for both.
  const bool stepped = !same_host_ && known && shows_step(travel, arrival);
  if (stepped) {
    estimate_ = protocol::ClockEstimate();
    late_ = {};
    restart();
  }
  if (arrival - window_start_ > kWindow) {
    shortest_before_ = shortest_;
    shortest_ = std::numeric_limits<double>::infinity();
    window_start_ = arrival;
  }
  shortest_ = std::min(shortest_, arrival - sent);
  return stepped;
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
