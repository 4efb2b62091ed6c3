// SPDX-License-Identifier: MIT
// The programs' exit codes, those of sysexits(3); docs/running.md lists them for users.
#pragma once

namespace splash::program {

enum ExitCode : int {
  kExitOk = 0,
  kExitUsage = 64,        ///< the command line
  kExitData = 65,         ///< a file that holds something else than it should
  kExitNoInput = 66,      ///< a file that cannot be read
  kExitUnavailable = 69,  ///< no port, no OpenCL, no such device
  kExitInternal = 70,     ///< an internal error
  kExitIo = 74,           ///< a file that cannot be written
  kExitConfig = 78,       ///< an error in a scene or rig file
};

}  // namespace splash::program
