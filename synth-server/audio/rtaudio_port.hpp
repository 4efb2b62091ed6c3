// SPDX-License-Identifier: MIT
// The part of RtAudio we use, alike for 5.x (devices are indices, errors are exceptions) and 6.x
// (devices are ids, errors are return codes); and what it does not tell of JACK.
#pragma once

#include <RtAudio.h>

#include <memory>
#include <string>
#include <vector>

#include "synth-server/audio/device_choice.hpp"

namespace splash::synth::rtaudio_port {

/// Keeps ALSA and JACK from writing to stderr while we look for devices that may not exist.
void silence_libraries();

/// The APIs this RtAudio was built with, in its order of preference.
[[nodiscard]] std::vector<std::string> apis();
/// Throws UnknownDevice when RtAudio was built without `api`.
[[nodiscard]] std::unique_ptr<RtAudio> create(const std::string& api);

struct Device {
  unsigned int id = 0;  ///< 5.x: index, 6.x: id
  DeviceDescription description;
};
/// Devices with outputs.
[[nodiscard]] std::vector<Device> devices(RtAudio& audio, const std::string& api);

struct Opening {
  unsigned int id = 0;
  unsigned int channels = 0;
  unsigned int sample_rate = 0;  ///< [Hz]
  unsigned int block = 0;        ///< frames; the device's own after open()
  RtAudioCallback callback = nullptr;
  void* context = nullptr;
  unsigned int inputs = 0;  ///< of the same device, from its first on
};
/// Planar floats, both ways, realtime priority asked for. Throws DeviceError with RtAudio's words.
void open(RtAudio& audio, Opening& opening);
void start(RtAudio& audio);
/// What JACK and PulseAudio call us.
inline constexpr const char* kClientName = "synth-server";

[[nodiscard]] bool is_open(const RtAudio& audio) noexcept;

/// Stops without draining (RtAudio waits for ever for a dead JACK server to drain) and closes.
void close(RtAudio& audio) noexcept;

/// What a device calls the places its channels go to. JACK: the input ports of the client called
/// `device`, in the order in which RtAudio connects to them. Empty when the API has no such names,
/// or fewer than `channels`.
[[nodiscard]] std::vector<std::string> port_names(const std::string& api, const std::string& device,
                                                  int channels);

/// Whether a JACK server is there that has ports of a client of this name.
[[nodiscard]] bool jack_knows(const std::string& name);

}  // namespace splash::synth::rtaudio_port
