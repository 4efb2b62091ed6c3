// SPDX-License-Identifier: MIT
// How the programs end, in the numbers of sysexits(3); README.md tells them to users.
#pragma once

namespace splash::program {

enum ExitCode : int {
  kExitOk = 0,
  kExitUsage = 64,        ///< the command line
  kExitData = 65,         ///< a log that is none
  kExitNoInput = 66,      ///< a file that cannot be read
  kExitUnavailable = 69,  ///< no port, no OpenCL, no such device
  kExitInternal = 70,     ///< a fault of ours
  kExitIo = 74,           ///< a file that cannot be written, now or on the way
  kExitConfig = 78,       ///< a scene or rig file
};

}  // namespace splash::program
