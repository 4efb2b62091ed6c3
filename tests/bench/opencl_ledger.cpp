// SPDX-License-Identifier: MIT
// The linker finds these calls here before it looks into libOpenCL, whose own are taken from the
// next library in line (dlsym, RTLD_NEXT).
#include "tests/bench/opencl_ledger.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include "sim-server/device/device.hpp"

namespace splash::bench {
namespace {

struct Launch {
  cl_kernel kernel = nullptr;
  cl_event event = nullptr;
  std::size_t items = 0;
};

struct Ledger {
  std::mutex mutex;
  bool open = false;
  Commands commands;
  std::vector<Launch> launches;
  std::map<cl_mem, std::size_t> buffers;
};

Ledger& ledger() {
  static Ledger instance;
  return instance;
}

/// The library's own function of that name.
template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::string name_of(cl_kernel kernel) {
  char name[128] = {};
  clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name - 1, name, nullptr);
  return name;
}

/// From its begin to its end on the device [s]; 0 where the queue does not tell.
double duration(cl_event event) {
  cl_ulong begin = 0;
  cl_ulong end = 0;
  const bool known = clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof begin,
                                             &begin, nullptr) == CL_SUCCESS &&
                     clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end,
                                             nullptr) == CL_SUCCESS;
  return known ? 1e-9 * static_cast<double>(end - begin) : 0.0;
}

}  // namespace

std::size_t buffer_bytes() {
  const std::scoped_lock lock(ledger().mutex);
  std::size_t sum = 0;
  for (const auto& [buffer, bytes] : ledger().buffers) sum += bytes;
  return sum;
}

void begin_ledger() {
  const std::scoped_lock lock(ledger().mutex);
  ledger().open = true;
  ledger().commands = {};
}

Commands noted_commands() {
  const std::scoped_lock lock(ledger().mutex);
  return ledger().commands;
}

namespace {

void note(std::int64_t Commands::*kind) {
  const std::scoped_lock lock(ledger().mutex);
  if (ledger().open) ++(ledger().commands.*kind);
}

}  // namespace

std::map<std::string, Launches> end_ledger() {
  const std::scoped_lock lock(ledger().mutex);
  ledger().open = false;
  std::map<std::string, Launches> totals;
  for (const Launch& launch : ledger().launches) {
    Launches& mine = totals[name_of(launch.kernel)];
    mine.least = mine.count == 0 ? launch.items : std::min(mine.least, launch.items);
    ++mine.count;
    mine.seconds += duration(launch.event);
    clReleaseEvent(launch.event);
    clReleaseKernel(launch.kernel);
  }
  ledger().launches.clear();
  return totals;
}

}  // namespace splash::bench

using splash::bench::ledger;

// NOLINTBEGIN(readability-identifier-naming): these are OpenCL's names.
extern "C" cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* host,
                                 cl_int* error) {
  static const auto real = splash::bench::next<decltype(&clCreateBuffer)>("clCreateBuffer");
  const cl_mem buffer = real(context, flags, size, host, error);
  const std::scoped_lock lock(ledger().mutex);
  if (buffer != nullptr) ledger().buffers[buffer] = size;
  return buffer;
}

extern "C" cl_int clReleaseMemObject(cl_mem buffer) {
  static const auto real = splash::bench::next<decltype(&clReleaseMemObject)>("clReleaseMemObject");
  cl_uint owners = 0;
  const cl_int asked =
      clGetMemObjectInfo(buffer, CL_MEM_REFERENCE_COUNT, sizeof owners, &owners, nullptr);
  if (asked == CL_SUCCESS && owners == 1) {
    const std::scoped_lock lock(ledger().mutex);
    ledger().buffers.erase(buffer);
  }
  return real(buffer);
}

extern "C" cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel,
                                         cl_uint dimensions, const size_t* offset,
                                         const size_t* global, const size_t* local, cl_uint waits,
                                         const cl_event* wait_for, cl_event* event) {
  static const auto real =
      splash::bench::next<decltype(&clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
  cl_event mine = nullptr;
  const cl_int result = real(queue, kernel, dimensions, offset, global, local, waits, wait_for,
                             event != nullptr ? event : &mine);
  if (result != CL_SUCCESS) return result;
  const std::scoped_lock lock(ledger().mutex);
  if (ledger().open) {
    clRetainKernel(kernel);
    if (mine == nullptr) clRetainEvent(mine = *event);
    ledger().launches.push_back({kernel, mine, *global});
    ledger().commands.late_kernels += ledger().commands.reads > 0;
  } else if (mine != nullptr) {
    clReleaseEvent(mine);
  }
  return result;
}

extern "C" cl_int clEnqueueWriteBuffer(cl_command_queue queue, cl_mem buffer, cl_bool wait,
                                       size_t offset, size_t size, const void* from, cl_uint waits,
                                       const cl_event* wait_for, cl_event* event) {
  static const auto real =
      splash::bench::next<decltype(&clEnqueueWriteBuffer)>("clEnqueueWriteBuffer");
  splash::bench::note(&splash::bench::Commands::writes);
  return real(queue, buffer, wait, offset, size, from, waits, wait_for, event);
}

extern "C" cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool wait,
                                      size_t offset, size_t size, void* to, cl_uint waits,
                                      const cl_event* wait_for, cl_event* event) {
  static const auto real =
      splash::bench::next<decltype(&clEnqueueReadBuffer)>("clEnqueueReadBuffer");
  splash::bench::note(&splash::bench::Commands::reads);
  return real(queue, buffer, wait, offset, size, to, waits, wait_for, event);
}

extern "C" cl_int clEnqueueFillBuffer(cl_command_queue queue, cl_mem buffer, const void* pattern,
                                      size_t pattern_size, size_t offset, size_t size,
                                      cl_uint waits, const cl_event* wait_for, cl_event* event) {
  static const auto real =
      splash::bench::next<decltype(&clEnqueueFillBuffer)>("clEnqueueFillBuffer");
  splash::bench::note(&splash::bench::Commands::fills);
  return real(queue, buffer, pattern, pattern_size, offset, size, waits, wait_for, event);
}

extern "C" cl_int clEnqueueCopyBuffer(cl_command_queue queue, cl_mem from, cl_mem to,
                                      size_t from_offset, size_t to_offset, size_t size,
                                      cl_uint waits, const cl_event* wait_for, cl_event* event) {
  static const auto real =
      splash::bench::next<decltype(&clEnqueueCopyBuffer)>("clEnqueueCopyBuffer");
  splash::bench::note(&splash::bench::Commands::copies);
  return real(queue, from, to, from_offset, to_offset, size, waits, wait_for, event);
}
// NOLINTEND(readability-identifier-naming)
