// SPDX-License-Identifier: MIT
// To be preloaded (LD_PRELOAD): makes the OpenCL devices whose names contain $SPLASH_SHIM_DEVICE
// GPUs, which go wrong as $SPLASH_SHIM says:
//   build   no program builds on them; if $SPLASH_SHIM_KERNEL is set, none with that kernel
//   wrong   the sort leaves out what it should gather
//   hang    what was enqueued never ends
//   crash   the first launch ends the program
//   mute    they do not tell what they are
// or, with any other word, not at all.
#include <CL/cl.h>
#include <dlfcn.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

/// The library's own function of that name.
template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool goes(const char* way) {
  const char* chosen = std::getenv("SPLASH_SHIM");
  return chosen != nullptr && std::strcmp(chosen, way) == 0;
}

bool is_meant(cl_device_id device) {
  static const auto info = next<decltype(&clGetDeviceInfo)>("clGetDeviceInfo");
  const char* part = std::getenv("SPLASH_SHIM_DEVICE");
  char name[256] = {};
  return part != nullptr &&
         info(device, CL_DEVICE_NAME, sizeof name - 1, name, nullptr) == CL_SUCCESS &&
         std::strstr(name, part) != nullptr;
}

bool is_meant(cl_command_queue queue) {
  cl_device_id device = nullptr;
  clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof device, &device, nullptr);
  return is_meant(device);
}

bool is_meant(cl_program program) {
  const char* part = std::getenv("SPLASH_SHIM_KERNEL");
  if (part == nullptr) return true;
  std::size_t size = 0;
  clGetProgramInfo(program, CL_PROGRAM_SOURCE, 0, nullptr, &size);
  std::string source(size, '\0');
  clGetProgramInfo(program, CL_PROGRAM_SOURCE, size, source.data(), nullptr);
  return source.find(std::string("kernel void ") + part + "(") != std::string::npos;
}

std::string name_of(cl_kernel kernel) {
  char name[128] = {};
  clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name - 1, name, nullptr);
  return name;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): these are OpenCL's names.
extern "C" cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t room,
                                  void* value, size_t* size) {
  static const auto real = next<decltype(&clGetDeviceInfo)>("clGetDeviceInfo");
  const bool meant = is_meant(device);
  if (meant && goes("mute") && what == CL_DEVICE_MAX_COMPUTE_UNITS) return CL_INVALID_VALUE;
  const cl_int result = real(device, what, room, value, size);
  if (meant && what == CL_DEVICE_TYPE && value != nullptr) {
    *static_cast<cl_device_type*>(value) = CL_DEVICE_TYPE_GPU;
  }
  return result;
}

extern "C" cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices,
                                 const char* options, void (*told)(cl_program, void*), void* to) {
  static const auto real = next<decltype(&clBuildProgram)>("clBuildProgram");
  const bool fails = goes("build") && count > 0 && is_meant(*devices) && is_meant(program);
  if (fails) options = "-DLANES=7";  // lanes/lanes.h refuses that
  return real(program, count, devices, options, told, to);
}

extern "C" cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel,
                                         cl_uint dimensions, const size_t* offset,
                                         const size_t* global, const size_t* local, cl_uint waits,
                                         const cl_event* wait_for, cl_event* event) {
  static const auto real = next<decltype(&clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
  if (is_meant(queue)) {
    if (goes("crash")) std::raise(SIGKILL);
    if (goes("wrong") && name_of(kernel) == "gather_cells") return CL_SUCCESS;
  }
  return real(queue, kernel, dimensions, offset, global, local, waits, wait_for, event);
}

extern "C" cl_int clFinish(cl_command_queue queue) {
  static const auto real = next<decltype(&clFinish)>("clFinish");
  while (goes("hang") && is_meant(queue)) pause();
  return real(queue);
}
// NOLINTEND(readability-identifier-naming)
