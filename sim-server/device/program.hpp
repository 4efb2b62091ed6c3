// SPDX-License-Identifier: MIT
// Kernel sources to programs, with build errors that name the kernel's own file and line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"

namespace splash::sim {

struct KernelSource {
  std::string name;  ///< the file's path in the source tree
  std::string text;
};

/// Builds `sources` as one program. `defines`: "NAME=VALUE" build constants; keep them few, each
/// combination is compiled and cached apart.
/// Throws DeviceError with the compiler's log.
[[nodiscard]] cl::Program build_program(const Device& device,
                                        const std::vector<KernelSource>& sources,
                                        const std::vector<std::string>& defines);

/// OpenCL on CPUs compiles a kernel when it first runs, which takes seconds for all of them.
struct KernelCount {
  int all = 0;    ///< made by this process so far
  int ready = 0;  ///< of these, have run
};
/// From now on each kernel's first run calls `told`, in the thread that runs it; {}: nobody is
/// told.
void tell_of_kernels(std::function<void(const KernelCount&)> told);

/// A kernel, run over `count` work-items padded to whole groups; kernels return at once for
/// indices past the end.
class Kernel {
 public:
  Kernel() = default;
  /// `group`: work-items handed out together, few when each is worth microseconds; fewer where the
  /// device allows this kernel no more.
  Kernel(const cl::Program& program, const std::string& name, std::size_t group = 64);

  template <class... Args>
  void run(cl::CommandQueue& queue, std::size_t count, const Args&... args) {
    if (count == 0) return;
    set(args...);
    const std::size_t group = count >= group_ ? group_ : 1;
    launch(queue, groups_of(count) * group, group);
  }

  /// Of whole work-groups, whose items work together.
  template <class... Args>
  void run_teams(cl::CommandQueue& queue, std::size_t teams, const Args&... args) {
    if (teams == 0) return;
    set(args...);
    launch(queue, teams * group_, group_);
  }

  /// Work-groups of a run over `count` work-items.
  [[nodiscard]] std::size_t groups_of(std::size_t count) const noexcept;

 private:
  static void note_made();
  template <class... Args>
  void set(const Args&... args) {
    cl_uint index = 0;
    (kernel_.setArg(index++, args), ...);
  }
  void launch(cl::CommandQueue& queue, std::size_t count, std::size_t group);

  cl::Kernel kernel_;
  std::size_t group_ = 64;
  bool has_run_ = false;
};

}  // namespace splash::sim
