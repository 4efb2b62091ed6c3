// SPDX-License-Identifier: MIT
// Where an event is felt: its gain in each channel of an output, from its place in the world.
#pragma once

#include "protocol/event.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// Writes channel_count(output) amplitude gains [1], trims not included.
///
/// tiles: w = 1 - (distance / reach)^2 of a tile's middle in the floor's plane, nil beyond, divided
///   by the root of the sum of w^2: the power is 1 wherever on the floor the event is, and only
///   near tiles move (the idea of distance-based amplitude panning, Lossius, Baltazar, de la Hogue
///   2009, with a finite reach). Beside the floor, its edge speaks, fading to nil at `reach` off
///   it.
/// stereo: constant power over `width` along x, around `place`.
/// single, worn: 1. A worn rig goes by body: events say which body they belong to, but not where
///   on it, so all its transducers play alike, each with its trim and its band.
void spread(const Output& output, const protocol::Vec3& position, double* gains) noexcept;

}  // namespace splash::synth
