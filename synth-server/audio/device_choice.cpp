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

std::size_t choose_device(const std::vector<DeviceDescription>& devices,
                          const std::string& wanted) {
  if (devices.empty()) throw DeviceError("there is no sound device with outputs");
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
