// SPDX-License-Identifier: MIT
// Water that has come to rest, kept in a file, so that the next start of the same scene need not
// wait for it.
#pragma once

#include <filesystem>
#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/scene.hpp"
#include "sim-server/scene/support_state.hpp"
#include "sim-server/start/settle.hpp"

namespace splash::sim {

/// Takes the water at rest from `file`, bit by bit as it was, and returns true; or lets it come to
/// rest (come_to_rest.hpp), writes the file anew and returns false: if there is none, or if its
/// water is of another scene, device or program. Throws program::DataError for a file that is
/// damaged or holds something else, which stays as it is; program::Failure for one that cannot be
/// read, program::WriteError for one that cannot be written. Waits.
[[nodiscard]] bool rest_from_file(const std::filesystem::path& file, Fluid& fluid,
                                  const Scene& scene, const Bodies& bodies,
                                  const std::vector<SupportState>& support_states,
                                  const Progress& tell);

}  // namespace splash::sim
