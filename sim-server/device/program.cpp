// SPDX-License-Identifier: MIT
#include "sim-server/device/program.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "sim-server/device/device_error.hpp"

namespace splash::sim {
namespace {

/// Calls that may compile. PoCL's compiler is C++ that throws when memory is short, past PoCL's own
/// locks, for which all that is released on the way up would wait for ever: the program is to end
/// where it stands (LastWords says why).
cl_int build(cl_program program, cl_device_id device, const char* options) noexcept {
  return clBuildProgram(program, 1, &device, options, nullptr, nullptr);
}

cl_int enqueue(cl_command_queue queue, cl_kernel kernel, std::size_t count,
               std::size_t group) noexcept {
  return clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &count, &group, 0, nullptr, nullptr);
}

/// Of this process.
struct Ledger {
  std::mutex mutex;
  KernelCount count;
  std::function<void(const KernelCount&)> told;
};

Ledger& ledger() {
  static Ledger the_ledger;
  return the_ledger;
}

}  // namespace

void tell_of_kernels(std::function<void(const KernelCount&)> told) {
  const std::lock_guard lock(ledger().mutex);
  ledger().told = std::move(told);
}

void Kernel::note_made() {
  const std::lock_guard lock(ledger().mutex);
  ++ledger().count.all;
}

Kernel::Kernel(const cl::Program& program, const std::string& name, std::size_t group)
    : kernel_(program, name.c_str()), group_(group) {
  const auto device = program.getInfo<CL_PROGRAM_DEVICES>().front();
  group_ = std::clamp<std::size_t>(kernel_.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device), 1,
                                   group);
  note_made();
}

std::size_t Kernel::groups_of(std::size_t count) const noexcept {
  return count >= group_ ? (count + group_ - 1) / group_ : count;
}

void Kernel::launch(cl::CommandQueue& queue, std::size_t count, std::size_t group) {
  const cl_int error = enqueue(queue(), kernel_(), count, group);
  if (error != CL_SUCCESS) throw cl::Error(error, "clEnqueueNDRangeKernel");
  if (has_run_) return;
  has_run_ = true;
  const std::lock_guard lock(ledger().mutex);
  ++ledger().count.ready;
  if (ledger().told) ledger().told(ledger().count);
}

cl::Program build_program(const Device& device, const std::vector<KernelSource>& sources,
                          const std::vector<std::string>& defines) {
  std::string text;
  for (const KernelSource& source : sources) {
    text += "#line 1 \"" + source.name + "\"\n" + source.text + "\n";
  }
  std::string options = "-cl-std=CL1.2 -cl-mad-enable -cl-no-signed-zeros";
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
