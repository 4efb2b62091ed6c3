// SPDX-License-Identifier: MIT
// Where PoCL keeps compiled kernels. PoCL 3.1 crashes when it cannot write there, so the folder
// is chosen and tried before the first OpenCL call.
#pragma once

#include <chrono>
#include <filesystem>
#include <string_view>
#include <vector>

namespace splash::sim {

/// Sets POCL_CACHE_DIR, if it is not set, to $XDG_CACHE_HOME/splash, ~/.cache/splash or, without
/// either, a folder of this user's own among the temporary ones, makes the folder, writes to it and
/// removes what is damaged there (cache.hpp). Also pins PoCL's workers, one to a core
/// (POCL_AFFINITY), unless the user chose or gave the process some cores only. Returns the folder;
/// throws std::runtime_error that names it, the cause and the cure.
std::filesystem::path prepare_kernel_cache();

/// Removes environment settings that make PoCL many times slower, and says so on stderr.
void refuse_slow_settings();

// Compiled kernels that were cut short, by a power failure or a full disk, crash PoCL when it loads
// them. So a finished cache is sealed: a list of its files with their checksums, against which the
// next start holds it.

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

// How PoCL lays out its cache: two capital letters / the rest of the source's hash / program.bc,
// kernels/.../*.so.

/// A file of each program that PoCL touches at every start that asks for it.
constexpr std::string_view kLastAccessed = "last_accessed";
/// How the names of drafts begin: PoCL leaves one, empty, at every start.
constexpr std::string_view kDraft = "tempfile_";

/// The folders of compiled programs, relative to PoCL's cache `folder`.
[[nodiscard]] std::vector<std::filesystem::path> programs_in(const std::filesystem::path& folder);

// PoCL never takes anything out of its cache, and each start leaves an empty draft behind.

/// Programs that no start asked for in so long are removed. They are of versions and scenes of
/// then; if one comes back after all, it is compiled in some seconds.
constexpr std::chrono::days kProgramKept{30};

/// Removes from `folder` the drafts that PoCL left and the programs that nobody used in
/// `kProgramKept`. Nobody else may be using the folder. Returns how many programs were removed.
int remove_leftovers(const std::filesystem::path& folder);

}  // namespace splash::sim
