// SPDX-License-Identifier: MIT
#include "sim-server/device/program.hpp"

#include "sim-server/device/device_error.hpp"

namespace splash::sim {
namespace {

/// May compile. PoCL's compiler is C++ that throws when memory is short, past PoCL's own
/// locks, for which all that is released on the way up would wait for ever: the program is to end
/// where it stands (LastWords says why).
cl_int build(cl_program program, cl_device_id device, const char* options) noexcept {
  return clBuildProgram(program, 1, &device, options, nullptr, nullptr);
}

}  // namespace

cl::Program build_program(const Device& device, const std::vector<KernelSource>& sources,
                          const std::vector<std::string>& defines) {
  std::string text;
  for (const KernelSource& source : sources) {
    text += "#line 1 \"" + source.name + "\"\n" + source.text + "\n";
  }
  std::string options = "-cl-std=CL1.2 -cl-mad-enable -cl-no-signed-zeros -cl-kernel-arg-info";
  options += " -DLANES=" + std::to_string(device.lanes());
  options += " -DTEAM=" + std::to_string(device.profile().team);
  options += " -DJUDGES=" + std::to_string(device.profile().judges);
  for (const std::string& define : defines) options += " -D" + define;

  cl::Program program(device.context(), text);
  const cl_int error = build(program(), device.handle()(), options.c_str());
  if (error != CL_SUCCESS) {
    throw DeviceError("the kernels do not build on " + device.facts().name + " (error " +
                      std::to_string(error) + "):\n" +
                      program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.handle()) +
                      "Choose another device (--list-devices). If a kernel's line is named above, "
                      "please report it; if none is, the disk of $POCL_CACHE_DIR may be full, "
                      "or memory short or limited (ulimit -v)");
  }
  return program;
}

}  // namespace splash::sim
