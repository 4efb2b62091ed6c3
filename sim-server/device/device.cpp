// SPDX-License-Identifier: MIT
#include "sim-server/device/device.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "sim-server/device/cache.hpp"
#include "sim-server/device/device_choice.hpp"
#include "sim-server/device/device_error.hpp"

namespace splash::sim {

Profile cpu_profile(unsigned cores, int lanes) {
  return {.lanes = lanes,
          .group = 4,
          .team = 1,
          .parts = 64,
          .judges = 64,
          .sort_chunks = static_cast<int>(std::clamp(cores, 1U, 64U))};
}

Profile gpu_profile() {
  return {};
}

namespace {

struct Found {
  DeviceFacts facts;
  cl::Device handle;
};

/// Why the library that an .icd file names cannot be loaded; empty: it can be.
std::string why_not_loaded(const std::filesystem::path& icd) {
  std::ifstream file(icd);
  std::string library;
  if (!(file >> library)) return icd.string() + " cannot be read";
  void* const loaded = dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (loaded != nullptr) {
    dlclose(loaded);
    return {};
  }
  return icd.string() + " names a platform that cannot be loaded: " + dlerror();
}

/// One that is installed and not found wants another cure than one that is missing.
std::string why_no_platform() {
  const char* chosen = std::getenv("OCL_ICD_VENDORS");
  const std::filesystem::path folder = chosen == nullptr ? "/etc/OpenCL/vendors" : chosen;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".icd") continue;
    const std::string reason = why_not_loaded(entry.path());
    if (!reason.empty()) {
      return "no OpenCL platform found: " + reason +
             "; if that is for want of memory or descriptors, raise the limit (ulimit -a shows "
             "them), else install the platform anew";
    }
  }
  if (error && error != std::errc::no_such_file_or_directory) {
    return "no OpenCL platform found: " + folder.string() + " cannot be listed: " + error.message();
  }
  return "no OpenCL platform found in " + folder.string() +
         (chosen == nullptr ? "; install one"
                            : ", which $OCL_ICD_VENDORS names; unset that, or install one") +
         ", for example: apt install pocl-opencl-icd";
}

std::vector<cl::Platform> platforms() {
  std::vector<cl::Platform> found;
  try {
    cl::Platform::get(&found);
  } catch (const cl::Error&) {
    found.clear();  // no loader entry at all (-1001): answered below like an empty list
  }
  if (found.empty()) throw DeviceError(why_no_platform());
  return found;
}

DeviceFacts facts_of(const cl::Platform& platform, const cl::Device& device, int index) {
  DeviceFacts facts;
  facts.index = index;
  facts.name = device.getInfo<CL_DEVICE_NAME>();
  facts.platform = platform.getInfo<CL_PLATFORM_NAME>();
  facts.driver = device.getInfo<CL_DRIVER_VERSION>();
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  facts.kind = (type & CL_DEVICE_TYPE_GPU) != 0   ? DeviceKind::gpu
               : (type & CL_DEVICE_TYPE_CPU) != 0 ? DeviceKind::cpu
                                                  : DeviceKind::accelerator;
  facts.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  facts.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  facts.allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  return facts;
}

std::vector<Found> find_devices() {
  prepare_kernel_cache();
  refuse_slow_settings();
  std::vector<Found> found;
  for (const cl::Platform& platform : platforms()) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;  // a platform without devices is not an error
    }
    for (const cl::Device& device : devices) {
      try {
        found.push_back({facts_of(platform, device, static_cast<int>(found.size())), device});
      } catch (const cl::Error& error) {
        std::cerr << "note: a device of " << platform.getInfo<CL_PLATFORM_NAME>()
                  << " does not tell what it is and is left out ("
                  << opencl_error_text(error.what(), error.err()) << ")\n";
      }
    }
  }
  if (found.empty()) throw DeviceError("the OpenCL platforms found have no device");
  return found;
}

std::vector<DeviceFacts> facts_of_all(const std::vector<Found>& found) {
  std::vector<DeviceFacts> list;
  for (const Found& one : found) list.push_back(one.facts);
  return list;
}

Found choose(int index) {
  const auto found = find_devices();
  const char* wish = std::getenv("SPLASH_DEVICE");
  const auto meant = meant_devices(facts_of_all(found), index >= 0        ? std::to_string(index)
                                                        : wish != nullptr ? wish
                                                                          : "");
  return found[static_cast<std::size_t>(meant.front().index)];
}

/// What a driver has to say about a failure, beside the number.
void CL_CALLBACK pass_on(const char* text, const void* /*data*/, std::size_t /*size*/,
                         void* /*user*/) {
  std::fprintf(stderr, "note: the device's driver says: %s\n", text);
}

const char* name_of(DeviceKind kind) {
  if (kind == DeviceKind::gpu) return "GPU";
  return kind == DeviceKind::cpu ? "CPU" : "accelerator";
}

}  // namespace

std::vector<DeviceFacts> list_devices() {
  return facts_of_all(find_devices());
}

std::string describe(const DeviceFacts& facts) {
  std::ostringstream line;
  line << facts.index << ": " << facts.name << " (" << name_of(facts.kind) << ", "
       << facts.compute_units << " compute units, " << (facts.memory >> 20U) << " MiB, "
       << facts.platform << ", driver " << facts.driver << ")";
  return line.str();
}

Device::Device(int index, bool profiling, int lanes) : Device(index, profiling, Profile{}) {
  const bool asked = std::getenv("SPLASH_SCALAR") != nullptr;
  const bool scalar = lanes == 1 || (lanes == 0 && (asked || facts_.kind != DeviceKind::cpu));
  const int suited = handle_.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>() >= 16 ? 16 : 8;
  profile_ =
      scalar ? gpu_profile() : cpu_profile(facts_.compute_units, lanes != 0 ? lanes : suited);
}

Device::Device(int index, bool profiling, const Profile& profile) : profile_(profile) {
  const Found found = choose(index);
  facts_ = found.facts;
  handle_ = found.handle;
  context_ = cl::Context(handle_, nullptr, pass_on);
  queue_ = cl::CommandQueue(context_, handle_, profiling ? CL_QUEUE_PROFILING_ENABLE : 0);
}

Device::~Device() {
  clFinish(queue_());
}

std::size_t Device::vectors_of(int particles) const noexcept {
  const auto lanes = static_cast<std::size_t>(profile_.lanes);
  return (static_cast<std::size_t>(particles) + lanes - 1) / lanes;
}

}  // namespace splash::sim
