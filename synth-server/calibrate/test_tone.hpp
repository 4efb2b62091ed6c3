// SPDX-License-Identifier: MIT
// --test-tone: which transducer hangs on which channel.
#pragma once

#include <csignal>

#include "synth-server/options.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Plays a TestTone on the device that the options name until all channels, or the one asked for,
/// have had their second, or one of the blocked `signals` comes. Throws Failure.
void play_test_tone(const Options& options, const Rig& rig, const sigset_t& signals);

}  // namespace splash::synth
