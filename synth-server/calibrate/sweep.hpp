// SPDX-License-Identifier: MIT
// --sweep: what a transducer makes of its signal. A sine that rises through a channel's band is
// played on it, an accelerometer or a microphone hears it, and what is heard over what was sent is
// its response, which an equaliser of the rig undoes. The sweep's frequency rises as e^(t/L), so
// that distortion comes before the rest once it is compressed to a pulse, and is cut off (A. Farina
// 2000, AES 108th convention).
#pragma once

#include <csignal>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "synth-server/options.hpp"
#include "synth-server/output/rig.hpp"

namespace splash::synth {

/// What the device gets on `channel` (from 0) of the rig: the sweep through the channel's band,
/// without its equaliser, at a quarter of its ceiling; then a second of silence. `sample_rate`
/// [Hz].
[[nodiscard]] std::vector<float> sweep_of(const Rig& rig, std::size_t channel, double sample_rate);

/// In thirds of octaves within `band`, over their median. `heard` holds what `sent` became, later
/// by any time. Throws std::runtime_error where the sweep cannot be told from the rest.
[[nodiscard]] MeasuredResponse response_of(std::span<const float> heard,
                                           std::span<const float> sent, const Band& band,
                                           double sample_rate);

/// Lines for the rig's file.
[[nodiscard]] std::string equaliser_text(const MeasuredResponse& response, const std::string& part);

/// Plays it, and prints the lines from what --sensor hears; or from --response. Throws Failure.
void measure(const Options& options, const Rig& rig, const sigset_t& signals);

}  // namespace splash::synth
