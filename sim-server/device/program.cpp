// SPDX-License-Identifier: MIT
#include "sim-server/device/program.hpp"

#include "sim-server/device/device_error.hpp"

namespace splash::sim {

cl::Program build_program(const Device& device, const std::vector<KernelSource>& sources,
                          const std::vector<std::string>& defines, bool relaxed) {
  std::string text;
  for (const KernelSource& source : sources) {
    text += "#line 1 \"" + source.name + "\"\n" + source.text + "\n";
  }
  std::string options = "-cl-std=CL1.2 -cl-mad-enable -cl-no-signed-zeros";
  if (relaxed) options += " -cl-fast-relaxed-math";
  options += " -DLANES=" + std::to_string(device.lanes());
  for (const std::string& define : defines) options += " -D" + define;

  cl::Program program(device.context(), text);
  try {
    program.build(device.handle(), options.c_str());
  } catch (const cl::Error& error) {
    throw DeviceError("the kernels do not build on " + device.facts().name + " (error " +
                      std::to_string(error.err()) + "):\n" +
                      program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.handle()) +
                      "Choose another device (--list-devices). If a kernel's line is named above, "
                      "please report it; if none is, the disk of $POCL_CACHE_DIR may be full");
  }
  return program;
}

}  // namespace splash::sim
