// SPDX-License-Identifier: MIT
// Time tags from seconds and back, keeping whole seconds and fraction apart for precision.
#include "protocol/time_tag.hpp"

#include <chrono>
#include <cmath>
#include <limits>

namespace splash::protocol {
namespace {

constexpr double kFractions = 4294967296.0;  // 2^32 fractions in a second, seconds in an NTP era

// `whole` and `fraction` of a second as 32.32 fixed point; whole seconds beyond an era wrap.
std::uint64_t fixed_point(double whole, double fraction) {
  const auto seconds = static_cast<std::uint64_t>(whole);
  const auto fractions = static_cast<std::uint64_t>(std::llround(fraction * kFractions));
  return (seconds << 32U) + fractions;  // a fraction rounded up to 1 carries
}

double seconds_of(TimeTag tag) {
  return static_cast<double>(tag.value >> 32U);
}
double fraction_of(TimeTag tag) {
  return static_cast<double>(tag.value & 0xffffffffU) / kFractions;
}

}  // namespace

TimeTag to_time_tag(double unix_seconds) noexcept {
  // Before 1900, past the next era or not a number: nothing a tag can say.
  if (!(unix_seconds >= -kNtpUnixOffset && unix_seconds < 2.0 * kFractions - kNtpUnixOffset)) {
    return kImmediately;
  }
  const double whole = std::floor(unix_seconds);
  return {fixed_point(whole + kNtpUnixOffset, unix_seconds - whole)};
}

double to_unix_seconds(TimeTag tag) noexcept {
  // The era by RFC 4330, section 3: a clear top bit means 2036 to 2104.
  const double era = (tag.value >> 63U) != 0 ? 0.0 : kFractions;
  return (seconds_of(tag) + era - kNtpUnixOffset) + fraction_of(tag);
}

TimeTag to_score_tag(double seconds) noexcept {
  if (!(seconds > 0.0)) return {0};
  if (seconds >= kFractions - 1.0) return {0xffffffff00000000U};
  const double whole = std::floor(seconds);
  return {fixed_point(whole, seconds - whole)};
}

double to_score_seconds(TimeTag tag) noexcept {
  return seconds_of(tag) + fraction_of(tag);
}

double unix_now() noexcept {
  using std::chrono::duration;
  return duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

double monotonic_now() noexcept {
  using std::chrono::duration;
  return duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ClockReading read_clocks(const Clock& monotonic, const Clock& unix_time) {
  constexpr int kReadings = 4;
  ClockReading best;
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kReadings; ++k) {
    const double before = monotonic();
    const double between = unix_time();
    const double took = monotonic() - before;
    if (took >= shortest) continue;
    shortest = took;
    best = {before + 0.5 * took, between};
  }
  return best;
}

}  // namespace splash::protocol
