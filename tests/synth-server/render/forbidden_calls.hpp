// SPDX-License-Identifier: MIT
// Counts what a real-time thread must not do. GCC 12 has no RealtimeSanitizer: forbidden_calls.cpp
// puts itself in front of malloc, its kin and the locks, for the program that links it.
#pragma once

namespace splash::synth {

/// Calls of this thread are counted while one lives.
class RealtimeScope {
 public:
  RealtimeScope() noexcept;
  ~RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

  [[nodiscard]] static int allocations() noexcept;  ///< since the scope began, frees included
  [[nodiscard]] static int locks() noexcept;
};

}  // namespace splash::synth
