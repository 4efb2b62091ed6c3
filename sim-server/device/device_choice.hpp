// SPDX-License-Identifier: MIT
// Which of several devices the water is computed on, and why.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"

namespace splash::sim {

/// The devices that `wish` means, those to take first in front: GPUs before accelerators before
/// CPUs, the ones with more compute units before the others. `wish` is a number as --list-devices
/// counts, "cpu", "gpu", a part of a name in whatever case, or empty: all.
/// Throws std::runtime_error that lists all when none is meant.
[[nodiscard]] std::vector<DeviceFacts> meant_devices(const std::vector<DeviceFacts>& all,
                                                     const std::string& wish);

/// What a device did with a small test of it.
struct Trial {
  double step = 0.0;    ///< what a time step took [s]
  std::string failure;  ///< empty: it computes what it should
};

struct Choice {
  DeviceFacts device;
  std::string reason;                    ///< why this one
  std::vector<std::string> passed_over;  ///< of each that failed its test, which and how
};

/// The first of `meant` that stands its test; of several GPUs the fastest. The last that is left is
/// taken without: there is nothing to take in its place. `asked`: the user named it or its kind.
[[nodiscard]] Choice choose_device(const std::vector<DeviceFacts>& meant, bool asked,
                                   const std::function<Trial(const DeviceFacts&)>& test);

}  // namespace splash::sim
