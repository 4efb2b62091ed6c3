// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/pose_clock.hpp"

#include <algorithm>
#include <cmath>

namespace splash::sim {

namespace {

/// The shortest way is that of one to two of these, so that drift of the clocks is followed [s].
constexpr double kSpan = 5.0;
/// The offset follows it by this part of the time that passes: no pose jumps [1].
constexpr double kSlew = 0.05;
/// A way shorter or longer than the shortest by more than this shows that a clock was set [s],
/// unless a single tag is wrong.
constexpr double kSetAhead = 0.25;
constexpr double kSetBack = 1.0;
constexpr double kAlike = 0.25;
constexpr int kStrangeEnough = 3;

/// Of arrivals the line goes through [s]; at most so many, at least so many.
constexpr double kRhythm = 0.8;
constexpr std::size_t kMost = 128;
constexpr std::size_t kLeast = 8;
/// After a longer silence the rhythm is another one [s].
constexpr double kSilence = 0.25;
/// Lost poses are counted while arrivals scatter by less than this part of the period [1].
constexpr double kCountable = 0.1;
/// Arrivals that wander by more than this are a sender's own, by less than that they are jitter.
constexpr double kWanders = 0.9;
constexpr double kStaysNear = 0.6;
constexpr double kSmooth = 0.03;
/// Arrivals that scatter by this part of the period have overtaken each other, more or less [1].
constexpr double kMixes = 0.5;
/// So many arrivals in a row far off on one side are of another rhythm.
constexpr int kAnother = 4;
constexpr double kFarOff = 0.004;  // [s]
/// A moment is no later than this after the arrival: early ones lie before the line [s].
constexpr double kEarly = 0.030;
constexpr double kQuantile = 0.9;

}  // namespace

void PoseClock::restart() noexcept {
  shortest_ = shortest_before_ = std::numeric_limits<double>::infinity();
  strange_ = 0;
  arrivals_.clear();
  line_ = {};
  wander_ = -1.0;
  off_ = 0;
  noted_ = 0;
  lateness_ = doubt_ = scatter_ = 0.0;
}

double PoseClock::taken(const PoseStamp& stamp) {
  if (stamp.sent.has_value() != tagged_ || (tagged_ && stamp.sender != sender_)) restart();
  tagged_ = stamp.sent.has_value();
  sender_ = stamp.sender;
  const double moment = tagged_ ? by_tag(stamp.arrival, *stamp.sent) : by_rhythm(stamp.arrival);
  newest_ = std::max(newest_, stamp.arrival);
  note_lateness(stamp.arrival - moment);
  return moment;
}

double PoseClock::by_tag(double arrival, double sent) {
  const double delay = arrival - sent;
  const double known = std::min(shortest_, shortest_before_);
  if (!std::isfinite(known)) {
    shortest_ = offset_ = delay;
    span_start_ = arrival;
    return arrival;
  }
  if (delay < known - kSetAhead || delay > known + kSetBack) {
    const bool alike = strange_ > 0 && std::abs(delay - strange_delay_) < kAlike;
    strange_ = alike ? strange_ + 1 : 1;
    strange_delay_ = delay;
    if (strange_ >= kStrangeEnough) {
      restart();
      return by_tag(arrival, sent);
    }
    // Held up for long, or wrong: that one is not of now.
    return delay > known ? sent + offset_ : arrival;
  }
  strange_ = 0;
  if (arrival - span_start_ > kSpan) {
    shortest_before_ = shortest_;
    shortest_ = std::numeric_limits<double>::infinity();
    span_start_ = arrival;
  }
  shortest_ = std::min(shortest_, delay);
  const double most = kSlew * std::max(arrival - newest_, 0.0);
  offset_ += std::clamp(std::min(shortest_, shortest_before_) - offset_, -most, most);
  return sent + offset_;
}

PoseClock::Line PoseClock::fit(const std::vector<Arrival>& arrivals) noexcept {
  const std::size_t size = arrivals.size();
  const auto count = static_cast<double>(size);
  const Arrival& newest = arrivals.back();
  double index = 0.0;
  double time = 0.0;
  for (const Arrival& a : arrivals) {
    index += (a.index - newest.index) / count;
    time += (a.time - newest.time) / count;
  }
  double square = 0.0;
  double product = 0.0;
  for (const Arrival& a : arrivals) {
    const double along = a.index - newest.index - index;
    square += along * along;
    product += along * (a.time - newest.time - time);
  }
  Line line;
  line.period = square > 0.0 ? product / square : 0.0;
  line.last = newest.time + time - index * line.period;
  const auto off = [&](std::size_t i) {
    return arrivals[i].time - line.last - (arrivals[i].index - newest.index) * line.period;
  };
  const auto change = [&](std::size_t steps) {
    double sum = 0.0;
    for (std::size_t i = steps; i < size; ++i) sum += std::pow(off(i) - off(i - steps), 2);
    return sum / static_cast<double>(size - steps);
  };
  for (std::size_t i = 0; i < size; ++i) line.scatter += off(i) * off(i) / count;
  line.scatter = std::sqrt(line.scatter);
  const std::size_t third = std::max<std::size_t>(size / 3, 2);
  line.wander = change(third) / (std::sqrt(static_cast<double>(third)) * change(1) + 1.0e-12);
  return line;
}

void PoseClock::count_again() {
  std::vector<double> steps;
  for (std::size_t i = 1; i < arrivals_.size(); ++i) {
    steps.push_back(arrivals_[i].time - arrivals_[i - 1].time);
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  if (*middle <= 0.0) return;
  std::vector<Arrival> counted = arrivals_;
  for (std::size_t i = 1; i < counted.size(); ++i) {
    const double step = std::round((counted[i].time - counted[i - 1].time) / *middle);
    counted[i].index = counted[i - 1].index + std::max(step, 1.0);
  }
  const Line line = fit(counted);
  if (line.scatter > kCountable * line.period) return;
  arrivals_ = counted;
  line_ = line;
}

double PoseClock::by_rhythm(double arrival) {
  if (!arrivals_.empty() && arrival - arrivals_.back().time > kSilence) restart();
  double step = 1.0;
  const bool known = arrivals_.size() >= kLeast && line_.period > 0.0;
  if (known && line_.scatter < kCountable * line_.period) {
    step = std::max(1.0, std::round((arrival - line_.last) / line_.period));
  }
  if (known) {
    const double late = arrival - line_.last - step * line_.period;
    const bool far = std::abs(late) > 3.0 * line_.scatter + kFarOff;
    const int side = late > 0.0 ? 1 : -1;
    off_ = !far ? 0 : (off_ * side > 0 ? off_ + side : side);
  }
  const double index = arrivals_.empty() ? 0.0 : arrivals_.back().index + step;
  arrivals_.push_back({index, arrival});
  std::size_t kept = std::abs(off_) >= kAnother ? kAnother : kMost;
  if (kept == kAnother) off_ = 0;
  kept = std::min(kept, arrivals_.size());
  while (arrival - arrivals_[arrivals_.size() - kept].time > kRhythm) --kept;
  arrivals_.erase(arrivals_.begin(), arrivals_.end() - static_cast<std::ptrdiff_t>(kept));
  double moment = arrival;
  doubt_ = scatter_ = 0.0;
  if (arrivals_.size() >= kLeast) {
    line_ = fit(arrivals_);
    if (line_.scatter > kCountable * line_.period) count_again();
    wander_ = wander_ < 0.0 ? line_.wander : wander_ + kSmooth * (line_.wander - wander_);
    const double trust = std::clamp((kWanders - wander_) / (kWanders - kStaysNear), 0.0, 1.0);
    moment = std::min(arrival + trust * (line_.last - arrival), arrival + kEarly);
    const double mixed = std::min(line_.scatter / (kMixes * line_.period), 1.0);
    doubt_ = trust * mixed * mixed * line_.scatter;
    scatter_ = trust * line_.scatter;
  }
  moment = std::max(moment, last_taken_);
  last_taken_ = moment;
  return moment;
}

void PoseClock::note_lateness(double lateness) {
  latenesses_[noted_ % kRemembered] = lateness;
  ++noted_;
  std::array<double, kRemembered> sorted = latenesses_;
  const std::size_t count = std::min(noted_, kRemembered);
  const auto place = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(count - 1));
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(sorted.begin(), sorted.begin() + place, end);
  lateness_ = sorted[static_cast<std::size_t>(place)];
}

}  // namespace splash::sim
