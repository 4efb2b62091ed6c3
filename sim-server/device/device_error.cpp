// SPDX-License-Identifier: MIT
#include "sim-server/device/device_error.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "sim-server/device/device.hpp"

namespace splash::sim {
namespace {

constexpr const char* kSmaller =
    "the device has too little memory: lower the scene's particles, or choose another device "
    "(--list-devices)";
constexpr const char* kLost =
    "the device was lost or its driver stopped: start again, and if it happens again look at the "
    "driver's messages (dmesg) or choose another device (--list-devices)";
constexpr const char* kCompiler =
    "the platform has no compiler: install the rest of it, for PoCL apt install pocl-opencl-icd";
constexpr const char* kOurs = "this is a fault of sim-server: please report it with this line";

constexpr const char* kDamaged =
    "a compiled kernel is damaged: start again, and what may be the cause is compiled anew; if it "
    "happens again, please report it with this line";

struct Row {
  int error;
  const char* name;
  const char* cure;
};

constexpr std::array kRows = {
    Row{CL_DEVICE_NOT_FOUND, "CL_DEVICE_NOT_FOUND", kLost},
    Row{CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE", kLost},
    Row{CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE", kCompiler},
    Row{CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE", kSmaller},
    Row{CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES", kLost},
    Row{CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY", kSmaller},
    Row{CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,
        "CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST", kLost},
    Row{CL_INVALID_VALUE, "CL_INVALID_VALUE", kOurs},
    Row{CL_INVALID_CONTEXT, "CL_INVALID_CONTEXT", kLost},
    Row{CL_INVALID_COMMAND_QUEUE, "CL_INVALID_COMMAND_QUEUE", kLost},
    Row{CL_INVALID_KERNEL_NAME, "CL_INVALID_KERNEL_NAME", kDamaged},
    Row{CL_INVALID_ARG_SIZE, "CL_INVALID_ARG_SIZE", kOurs},
    Row{CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS", kOurs},
    Row{CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE", kOurs},
    Row{CL_INVALID_WORK_ITEM_SIZE, "CL_INVALID_WORK_ITEM_SIZE", kOurs},
    Row{CL_INVALID_GLOBAL_WORK_SIZE, "CL_INVALID_GLOBAL_WORK_SIZE", kOurs},
    Row{CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE", kSmaller},
    Row{-9999, "NVIDIA: illegal read or write", kLost},
};

/// Where memory is asked for; other calls run out of resources, on NVIDIA, when a kernel went wrong
/// or ran too long.
bool asks_for_memory(std::string_view call) {
  return call.starts_with("clCreate") || call == "clEnqueueFillBuffer";
}

}  // namespace

std::string opencl_error_text(const char* call, int error) {
  const auto* const row = std::find_if(kRows.begin(), kRows.end(),
                                       [error](const Row& known) { return known.error == error; });
  const bool known = row != kRows.end();
  const bool full = error == CL_OUT_OF_RESOURCES && asks_for_memory(call);
  return std::string("OpenCL's ") + call + " failed: " + (known ? row->name : "error") + " (" +
         std::to_string(error) + "); " +
         (full    ? kSmaller
          : known ? row->cure
                  : kLost);
}

void rethrow_opencl_error() {
  try {
    throw;
  } catch (const cl::Error& error) {
    throw DeviceError(opencl_error_text(error.what(), error.err()));
  }
}

}  // namespace splash::sim
