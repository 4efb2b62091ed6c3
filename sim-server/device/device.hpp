// SPDX-License-Identifier: MIT
// An OpenCL device and what suits it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

// The Khronos C++ binding, configured once: OpenCL 1.2 calls, errors as exceptions.
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_TARGET_OPENCL_VERSION 120

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wignored-attributes"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

namespace splash::sim {

// What suits a device, decided here and nowhere else: how many particles a work-item handles, and
// into how many pieces work is cut. CPUs have few cores with wide vectors and dear synchronisation;
// GPUs have thousands of scalar lanes that read memory together.

struct Profile {
  int lanes = 1;             ///< particles per vector in kernels: 1, 8 or 16 (fluid/lanes/lanes.h)
  std::size_t group = 64;    ///< work-items of a work-group, where each has a vector of its own
  std::size_t team = 64;     ///< work-items that find a part of a sum together (lanes/team.h)
  std::size_t parts = 256;   ///< of a sum over all particles, one to a team
  std::size_t judges = 256;  ///< work-items of the one work-group that adds up all parts
  int sort_chunks = 0;       ///< runs of points that are sorted side by side; 0: by rank
};

/// `lanes`: 8 or 16.
[[nodiscard]] Profile cpu_profile(unsigned cores, int lanes = 16);

/// Scalar: runs on any device, on a CPU as on a GPU but for the speed.
[[nodiscard]] Profile gpu_profile();

// An OpenCL device: which there are, which was chosen and why, and its queue.

/// In the order in which they are taken.
enum class DeviceKind { gpu, accelerator, cpu };

struct DeviceFacts {
  int index = 0;  ///< as --device counts them
  std::string name;
  std::string platform;
  std::string driver;
  DeviceKind kind = DeviceKind::gpu;
  unsigned compute_units = 0;
  std::size_t memory = 0;      ///< [B]
  std::size_t allocation = 0;  ///< largest single buffer [B]
};

/// All devices of all platforms that tell their facts. Throws std::runtime_error with the package
/// to install when there is no OpenCL platform.
[[nodiscard]] std::vector<DeviceFacts> list_devices();

/// One line for people: index, name, kind, units, memory.
[[nodiscard]] std::string describe(const DeviceFacts& facts);

/// A chosen device with its context and in-order queue.
class Device {
 public:
  /// `index` as list_devices counts; -1: the first that $SPLASH_DEVICE means, or of all
  /// (device_choice.hpp).
  /// `lanes`: 8 or 16 particles per vector in kernels; 1: as GPUs do it, whatever the device;
  /// 0: as suits the device (16 on CPUs with AVX-512, 8 on others), or 1 where $SPLASH_SCALAR is
  /// set.
  explicit Device(int index = -1, bool profiling = false, int lanes = 0);
  /// Cuts work as `profile` says, whatever would suit the device.
  Device(int index, bool profiling, const Profile& profile);
  /// Waits for the work that is still queued: a driver may run or compile a kernel on threads of
  /// its own, which must not outlive what the process tears down when it exits.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] const DeviceFacts& facts() const noexcept { return facts_; }
  [[nodiscard]] const cl::Context& context() const noexcept { return context_; }
  [[nodiscard]] const cl::Device& handle() const noexcept { return handle_; }
  [[nodiscard]] cl::CommandQueue& queue() noexcept { return queue_; }
  [[nodiscard]] const Profile& profile() const noexcept { return profile_; }
  /// Particles per vector in kernels.
  [[nodiscard]] int lanes() const noexcept { return profile_.lanes; }
  /// Work-items that `particles` take, a vector to each.
  [[nodiscard]] std::size_t vectors_of(int particles) const noexcept;

 private:
  DeviceFacts facts_;
  Profile profile_;
  cl::Device handle_;
  cl::Context context_;
  cl::CommandQueue queue_;
};

}  // namespace splash::sim
