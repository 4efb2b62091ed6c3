// SPDX-License-Identifier: MIT
// What a device calls the places its channels go to.
#pragma once

#include <string>
#include <vector>

namespace splash::synth {

/// JACK: the input ports of the client called `device`, in the order in which RtAudio connects to
/// them. Empty when the API has no such names, or fewer than `channels`.
[[nodiscard]] std::vector<std::string> port_names(const std::string& api, const std::string& device,
                                                  int channels);

/// Whether a JACK server is there that has ports of a client of this name.
[[nodiscard]] bool jack_knows(const std::string& name);

}  // namespace splash::synth
