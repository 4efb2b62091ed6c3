// SPDX-License-Identifier: MIT
// A log to WAV files, offline.
#pragma once

#include "synth-server/options.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Renders options.replay to options.render (and its stems) and prints what it held. Throws
/// std::runtime_error when the log cannot be read or a file not be written.
void render_log(const Options& options, const Rig& rig);

}  // namespace splash::synth
