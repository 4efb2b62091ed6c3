// SPDX-License-Identifier: MIT
// OpenCL compilers end the whole process when they fail: LLVM exits on a full disk, PoCL asserts.
// Whoever started the simulator then gets to read why, and what to do.
#pragma once

#include <filesystem>

namespace splash::sim {

/// While it lives, an exit() that is none of ours says that OpenCL caused it, and ends with
/// `exit_code`; until built(), a crash does as well. One at a time.
class LastWords {
 public:
  /// `cache`: where compiled kernels are kept.
  LastWords(const std::filesystem::path& cache, int exit_code);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  /// LLVM takes all signals when the devices are first asked for, and an abort that its handler has
  /// returned from ends the program without a word: from now on they are ours again.
  void devices_known();
  /// The kernels are there: from now on a crash leaves what a crash leaves.
  void built();
};

}  // namespace splash::sim
