// SPDX-License-Identifier: MIT
// Devices are tested in a process of their own, which may crash, hang or be ended by a driver.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "sim-server/device/device_choice.hpp"

namespace splash::sim {

/// How long a device may take to build one kernel, and for the steps of the test itself.
struct TrialLimits {
  std::chrono::milliseconds build{60'000};
  std::chrono::milliseconds steps{30'000};
};

class DeviceTrials {
 public:
  /// `cache`: folder of compiled kernels, where it is remembered who stood the test. `program`: one
  /// that prints a line for each kernel it builds and "built" after the last, then "sound SECONDS"
  /// for a step, when its arguments are --check-device and the device's number: sim-server itself.
  DeviceTrials(const std::filesystem::path& cache, std::filesystem::path program,
               const TrialLimits& limits = {});

  /// Tests the device, unless it stood the test with this driver and these kernels before.
  [[nodiscard]] Trial operator()(const DeviceFacts& device) const;

 private:
  std::filesystem::path remembered_;
  std::filesystem::path program_;
  TrialLimits wait_;
};

}  // namespace splash::sim
