// SPDX-License-Identifier: MIT
// PoCL never takes anything out of its cache, and each start leaves an empty draft behind.
#pragma once

#include <chrono>
#include <filesystem>

namespace splash::sim {

/// Programs that no start asked for in so long are removed. They are of versions and scenes of
/// then; if one comes back after all, it is compiled in some seconds.
constexpr std::chrono::days kProgramKept{30};

/// Removes from `folder` the drafts that PoCL left and the programs that nobody used in
/// `kProgramKept`. Nobody else may be using the folder. Returns how many programs were removed.
int remove_leftovers(const std::filesystem::path& folder);

}  // namespace splash::sim
