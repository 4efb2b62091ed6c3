// SPDX-License-Identifier: MIT
// How the program ends, in the numbers of sysexits(3).
#pragma once

namespace splash::protocol {

enum ExitCode : int {
  kExitOk = 0,
  kExitUsage = 64,        ///< the command line
  kExitData = 65,         ///< a log that is none
  kExitNoInput = 66,      ///< a file that cannot be read
  kExitUnavailable = 69,  ///< the port or the device
  kExitInternal = 70,     ///< a fault of ours
  kExitIo = 74,           ///< a file that cannot be written
  kExitConfig = 78,       ///< a rig file
};

}  // namespace splash::protocol
