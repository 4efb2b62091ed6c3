// SPDX-License-Identifier: MIT
// Catches a thread that enters the kernel, whatever it does there: sleeps, waits for a lock, reads,
// writes. No function needs to be known for it: Linux itself hands each system call of the thread
// to us (syscall user dispatch, since 5.11).
#pragma once

namespace splash::synth {

/// System calls of this thread are caught while one lives.
class SystemCallScope {
 public:
  SystemCallScope() noexcept;
  ~SystemCallScope();
  SystemCallScope(const SystemCallScope&) = delete;
  SystemCallScope& operator=(const SystemCallScope&) = delete;

  /// Whether there was any since the scope began: the first one ends the watch.
  [[nodiscard]] static bool any() noexcept;
  /// Its number, -1 without one: see <sys/syscall.h>.
  [[nodiscard]] static int first() noexcept;
  /// False where the kernel or the processor cannot do it: then none is ever seen.
  [[nodiscard]] static bool works() noexcept;
};

}  // namespace splash::synth
