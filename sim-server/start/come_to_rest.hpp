// SPDX-License-Identifier: MIT
// A scene's water comes to rest before its time begins.
#pragma once

#include <vector>

#include "sim-server/bodies/body_steps.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/scene/scene.hpp"
#include "sim-server/scene/support_state.hpp"
#include "sim-server/start/settle.hpp"

namespace splash::sim {

/// Packs what of `fluid`, by id, hangs, and lets what is held come to rest; the rest stays where it
/// is. A gate makes two tanks of one until then: the water on each side of it comes to rest alone,
/// in a fluid of its own. Waits. `tell` hears how far it is. Throws program::Failure with
/// kExitConfig for water that does not come to rest, whatever the steps.
void come_to_rest(Fluid& fluid, const Scene& scene, const Bodies& bodies,
                  const std::vector<SupportState>& support_states, const Progress& tell);

}  // namespace splash::sim
