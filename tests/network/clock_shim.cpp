// SPDX-License-Identifier: MIT
// To be preloaded (LD_PRELOAD): the system clock is $SPLASH_CLOCK_OFFSET seconds ahead, as on a
// host whose clock nobody has set. The monotonic clock stays as it is.
#include <dlfcn.h>

#include <cmath>
#include <cstdlib>
#include <ctime>

// The header's names are reserved ones.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name)
extern "C" __attribute__((visibility("default"))) int clock_gettime(clockid_t clock,
                                                                    timespec* time) noexcept {
  using Function = int (*)(clockid_t, timespec*);
  static const auto kOriginal = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "clock_gettime"));
  static const char* const kText = std::getenv("SPLASH_CLOCK_OFFSET");
  static const double kOffset = kText == nullptr ? 0.0 : std::strtod(kText, nullptr);
  const int result = kOriginal(clock, time);
  if (result != 0 || clock != CLOCK_REALTIME) return result;
  constexpr long kNanoseconds = 1000000000;
  const double whole = std::floor(kOffset);
  time->tv_sec += static_cast<time_t>(whole);
  time->tv_nsec += static_cast<long>((kOffset - whole) * 1e9);
  if (time->tv_nsec >= kNanoseconds) {
    time->tv_nsec -= kNanoseconds;
    ++time->tv_sec;
  }
  return result;
}
