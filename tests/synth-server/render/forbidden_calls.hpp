// SPDX-License-Identifier: MIT
// Counts what a real-time thread must not do. GCC 12 has no RealtimeSanitizer: forbidden_calls.cpp
// puts itself in front of malloc, its kin, the locks, the functions that wait and what throws, for
// the program that links it; the kernel tells of every system call.
#pragma once

#include <iosfwd>

namespace splash::synth {

/// Catches a thread that enters the kernel, whatever it does there: sleeps, waits for a lock,
/// reads, writes. No function needs to be known for it: Linux itself hands each system call of the
/// thread to us (syscall user dispatch, since 5.11). System calls of this thread are caught while
/// one lives.
class SystemCallScope {
 public:
  SystemCallScope() noexcept;
  ~SystemCallScope();
  SystemCallScope(const SystemCallScope&) = delete;
  SystemCallScope& operator=(const SystemCallScope&) = delete;

  /// Whether there was any since the scope began: the first one ends the watch.
  [[nodiscard]] static bool any() noexcept;
  /// False where the kernel or the processor cannot do it: then none is ever seen.
  [[nodiscard]] static bool works() noexcept;
};

struct ForbiddenCalls {
  int allocations = 0;   ///< frees included
  int locks = 0;         ///< taken, waited for or tried
  int waits = 0;         ///< functions that sleep, poll, read or write
  int exceptions = 0;    ///< thrown
  int system_calls = 0;  ///< sections with any, where the kernel can tell

  ForbiddenCalls& operator+=(const ForbiddenCalls& other) noexcept;
  bool operator==(const ForbiddenCalls&) const = default;
};
std::ostream& operator<<(std::ostream& out, const ForbiddenCalls& calls);

/// Calls of this thread are counted while one lives.
class RealtimeScope {
 public:
  RealtimeScope() noexcept;
  ~RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

  /// Since the latest scope of this thread began.
  [[nodiscard]] static ForbiddenCalls calls() noexcept;

 private:
  SystemCallScope system_calls_;
};

}  // namespace splash::synth
