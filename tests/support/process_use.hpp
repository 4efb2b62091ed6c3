// SPDX-License-Identifier: MIT
// What another process takes of the machine.
#pragma once

#include <sys/types.h>

namespace splash::tests {

/// Resident memory [KiB]; 0: there is no such process.
[[nodiscard]] long resident(pid_t process);
/// User and system time since its start [s]. Throws when there is no such process.
[[nodiscard]] double cpu_seconds(pid_t process);

}  // namespace splash::tests
