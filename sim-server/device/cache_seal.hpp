// SPDX-License-Identifier: MIT
// Compiled kernels that were cut short, by a power failure or a full disk, crash PoCL when it loads
// them. So a finished cache is sealed: a list of its files with their checksums, against which the
// next start holds it.
#pragma once

#include <filesystem>

namespace splash::sim {

/// Removes every compiled program in `folder` that is not what the seal says, and those that are in
/// no seal if a simulator died or failed over its kernels, or if the seal is there but lost what it
/// said. Nobody else may be using the folder. Returns how many were removed; they are compiled anew
/// when they are asked for.
int remove_damaged_programs(const std::filesystem::path& folder);

/// A simulator at work in a cache: what it adds is not trusted until it is sealed.
class CacheSeal {
 public:
  explicit CacheSeal(std::filesystem::path folder);
  /// Ends the work cleanly, unless it is in doubt. What was not sealed is trusted as well: this
  /// process has seen it whole.
  ~CacheSeal();
  CacheSeal(const CacheSeal&) = delete;
  CacheSeal& operator=(const CacheSeal&) = delete;

  /// The device failed over the kernels: what is in no seal may be the cause, and the next start
  /// compiles it again.
  void doubt() noexcept { in_doubt_ = true; }

  /// Whether kernels are there that the seal does not know: some were compiled since.
  [[nodiscard]] bool has_new() const;
  /// All kernels that are there now are whole. A disk that refuses the list is no error: the next
  /// start then compiles again.
  void renew() const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path mark_;  ///< of work going on; left behind by who dies, and in doubt
  bool in_doubt_ = false;
};

}  // namespace splash::sim
