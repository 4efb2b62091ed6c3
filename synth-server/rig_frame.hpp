// SPDX-License-Identifier: MIT
// The rig as a viewer gets it (view-server/README.md, SPR1), and where its channels lie between
// left and right.
#pragma once

#include <string>
#include <vector>

#include "protocol/frame.hpp"
#include "synth-server/desk.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// JSON. `sample_rate` [Hz].
[[nodiscard]] std::string describe_for_viewers(const Rig& rig, const Desk& desk, int sample_rate);
[[nodiscard]] protocol::ViewFrame rig_frame(const Rig& rig, const Desk& desk, int sample_rate);

/// What a channel gives to either side of a stereo monitor [1].
struct Pan {
  float left = 0.0F;
  float right = 0.0F;
};
/// Of each channel, of equal power: tiles by their x, left and right of loudspeakers to their own
/// sides, all else in the middle.
[[nodiscard]] std::vector<Pan> pans_of(const Rig& rig);

}  // namespace splash::synth
