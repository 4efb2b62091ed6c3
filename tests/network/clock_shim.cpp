// SPDX-License-Identifier: MIT
// To be preloaded (LD_PRELOAD): the system clock is $SPLASH_CLOCK_OFFSET seconds ahead, as on a
// host whose clock nobody has set. The monotonic clock stays as it is.
#include <dlfcn.h>

#include <cmath>
#include <cstdlib>
#include <ctime>

extern "C" __attribute__((visibility("default"))) int clock_gettime(clockid_t clock,
                                                                    timespec* time) noexcept {
  using Function = int (*)(clockid_t, timespec*);
  static const auto original = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "clock_gettime"));
  static const char* const text = std::getenv("SPLASH_CLOCK_OFFSET");
  static const double offset = text == nullptr ? 0.0 : std::strtod(text, nullptr);
  const int result = original(clock, time);
  if (result != 0 || clock != CLOCK_REALTIME) return result;
  constexpr long kNanoseconds = 1000000000;
  const double whole = std::floor(offset);
  time->tv_sec += static_cast<time_t>(whole);
  time->tv_nsec += static_cast<long>((offset - whole) * 1e9);
  if (time->tv_nsec >= kNanoseconds) {
    time->tv_nsec -= kNanoseconds;
    ++time->tv_sec;
  }
  return result;
}
