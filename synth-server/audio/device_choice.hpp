// SPDX-License-Identifier: MIT
// Sound devices as a user sees them: what there is, and which one is meant.
#pragma once

#include <string>
#include <vector>

#include "program/failure.hpp"

namespace splash::synth {

struct DeviceChoice {
  std::string api;               ///< "jack", "alsa", "pulse"; empty: the first that has a device
  std::string device;            ///< a name or the unmistakable part of one; empty: the default
  int channels = 2;              ///< needed
  int sample_rate = 0;           ///< [Hz]; 0: what the device prefers
  int block = 256;               ///< wanted frames per call; the device may have its own
  int sensor = 0;                ///< input that is heard meanwhile, from 1 on; 0: none
  std::vector<int> places = {};  ///< the device's channel of each, from 1 on; empty: in order
};

struct DeviceDescription {
  std::string api;
  std::string name;
  int channels = 0;  ///< outputs
  bool is_default = false;
  int preferred_rate = 0;  ///< [Hz]
  int inputs = 0;
};

/// A device cannot be opened now: there is none, it has too few channels, its server refused.
/// The text names the device, the cause and what to do.
class DeviceError : public program::Failure {
 public:
  explicit DeviceError(const std::string& text) : Failure(program::kExitUnavailable, text) {}
};

/// What was asked for does not exist: another name or API is needed, waiting will not help.
class UnknownDevice : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

/// All sound devices with outputs, of one API ("": of all that RtAudio was built with).
/// Throws UnknownDevice when there is no such API.
[[nodiscard]] std::vector<DeviceDescription> list_devices(const std::string& api);

/// Why `api` ("": any) has no device, and what gives it one.
[[nodiscard]] std::string why_no_device(const std::string& api);

/// Position in `devices`, those of `api`, of the one that `wanted` names (exactly, else by a part
/// that only one has), or of the default for "". Throws UnknownDevice listing the names,
/// DeviceError for none.
[[nodiscard]] std::size_t choose_device(const std::vector<DeviceDescription>& devices,
                                        const std::string& wanted, const std::string& api);

}  // namespace splash::synth
