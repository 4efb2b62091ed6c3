// SPDX-License-Identifier: MIT
#include "synth-server/audio/device_choice.hpp"

#include "synth-server/audio/rtaudio_port.hpp"

namespace splash::synth {
namespace {

std::string names_of(const std::vector<DeviceDescription>& devices) {
  std::string names;
  for (const auto& device : devices) {
    names += (names.empty() ? "'" : ", '") + device.api + ": " + device.name + "'";
  }
  return names.empty() ? "none" : names;
}

}  // namespace

std::vector<DeviceDescription> list_devices(const std::string& api) {
  std::vector<DeviceDescription> found;
  const auto apis = api.empty() ? rtaudio_port::apis() : std::vector<std::string>{api};
  for (const auto& name : apis) {
    const auto audio = rtaudio_port::create(name);
    for (auto& device : rtaudio_port::devices(*audio, name)) {
      found.push_back(std::move(device.description));
    }
  }
  return found;
}

std::string why_no_device(const std::string& api) {
  if (api == "jack") {
    return "no JACK server is running for this user: start one, with 'jackd -d alsa' (package "
           "jackd2), or use PipeWire's by starting this program with pw-jack (package "
           "pipewire-jack)";
  }
  if (api == "pulse") {
    return "no PulseAudio server answers: start one, with 'pulseaudio --start' (package "
           "pulseaudio), or PipeWire's (package pipewire-pulse)";
  }
  if (api == "alsa") {
    return "ALSA has no sound card that this user may open: 'aplay -l' (package alsa-utils) lists "
           "the cards, and membership in the group audio opens them";
  }
  return "there is no sound device: no JACK server is running, no PulseAudio or PipeWire server, "
         "and ALSA has no card that this user may open; 'jackd -d alsa' (package jackd2) or "
         "'pulseaudio --start' (package pulseaudio) starts a server on a card that 'aplay -l' "
         "(package alsa-utils) lists";
}

std::size_t choose_device(const std::vector<DeviceDescription>& devices, const std::string& wanted,
                          const std::string& api) {
  if (devices.empty()) {
    throw DeviceError((wanted.empty() ? std::string() : "there is no device '" + wanted + "': ") +
                      why_no_device(api));
  }
  std::vector<std::size_t> partial;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (wanted.empty() ? devices[i].is_default : devices[i].name == wanted) return i;
    if (devices[i].name.find(wanted) != std::string::npos) partial.push_back(i);
  }
  if (wanted.empty()) return 0;  // an API without a default: its first
  if (partial.size() == 1) return partial.front();
  throw UnknownDevice("--device '" + wanted + "' names " +
                      (partial.empty() ? "no sound device" : "more than one sound device") +
                      "; there are: " + names_of(devices) +
                      "; use --list-devices, or --device null to play without one");
}

}  // namespace splash::synth
