// SPDX-License-Identifier: MIT
// From the command line to an open output: the device that is meant, or the null clock.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "synth-server/audio/audio_output.hpp"
#include "synth-server/audio/device_choice.hpp"
#include "synth-server/options.hpp"

namespace splash::synth {

inline constexpr int kDefaultRate = 48000;  ///< without a device [Hz]

struct OpenedOutput {
  std::unique_ptr<AudioOutput> output;
  std::string missing;  ///< why it only stands in for a device; empty: it does not
};

/// Throws UnknownDevice when the command line names a device that does not exist; that there is
/// none to be had now is no error, but said to `log`.
[[nodiscard]] OpenedOutput open_output(const Options& options, const Rig& rig,
                                       const std::function<void(const std::string&)>& log);

/// What to ask for when `opened` is lost: the same device, at the rate that the user wants, or else
/// at whichever it then has.
[[nodiscard]] DeviceChoice choice_again(const Options& options, const Rig& rig,
                                        const OpenedOutput& opened);

}  // namespace splash::synth
