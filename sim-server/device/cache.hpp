// SPDX-License-Identifier: MIT
// Where PoCL keeps compiled kernels. PoCL 3.1 crashes when it cannot write there, so the folder
// is chosen and tried before the first OpenCL call.
#pragma once

#include <filesystem>

namespace splash::sim {

/// Sets POCL_CACHE_DIR, if it is not set, to $XDG_CACHE_HOME/splash, ~/.cache/splash or, without
/// either, a folder of this user's own among the temporary ones, makes the folder, writes to it and
/// removes what is damaged there (cache_seal.hpp). Also pins PoCL's workers, one to a core
/// (POCL_AFFINITY), unless the user chose or gave the process some cores only. Returns the folder;
/// throws std::runtime_error that names it, the cause and the cure.
std::filesystem::path prepare_kernel_cache();

/// Removes environment settings that make PoCL many times slower, and says so on stderr.
void refuse_slow_settings();

}  // namespace splash::sim
