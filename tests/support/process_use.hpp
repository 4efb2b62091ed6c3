// SPDX-License-Identifier: MIT
// What another process takes of the machine.
#pragma once

#include <sys/types.h>

namespace splash::tests {

/// Resident memory [KiB]; 0: there is no such process.
[[nodiscard]] long resident(pid_t process);
/// User and system time since its start [s]. Throws when there is no such process.
[[nodiscard]] double cpu_seconds(pid_t process);
/// The same of all children that have ended and been waited for [s].
[[nodiscard]] double cpu_of_children();

}  // namespace splash::tests
