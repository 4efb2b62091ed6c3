// SPDX-License-Identifier: MIT
// What an equaliser in a rig may be.
#pragma once

#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Throws std::invalid_argument with output, key, value and limit when one cannot be drawn.
void check_equalisers(const Output& output);

}  // namespace splash::synth
