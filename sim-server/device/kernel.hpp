// SPDX-License-Identifier: MIT
// Kernels: programs of them, and calls of one.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/device/shared_struct.h"

namespace splash::sim {

// A kernel and its arguments, which are passed by the names of its parameters: in any order, each
// once, and of the parameter's type. The parameters are read (clGetKernelArgInfo) when the kernel
// is created; names, types and completeness are checked at the first launch of each call site.
// Later launches compare addresses only, and set the arguments that differ from the last launch's.

/// OpenCL on CPUs compiles a kernel when it first runs, which takes seconds for all of them.
struct KernelCount {
  int all = 0;    ///< made by this process so far
  int ready = 0;  ///< of these, have run
};
/// From now on each kernel's first run calls `told`, in the thread that runs it; {}: nobody is
/// told.
void tell_of_kernels(std::function<void(const KernelCount&)> told);

/// A value for the parameter `name`, a literal: a buffer, which must live until the launch, or a
/// number.
class KernelArg {
 public:
  template <class T>
  KernelArg(const char* name, const Buffer<T>& buffer)
      : name_(name), type_(kKernelType<T>), memory_(&buffer.memory()) {
    static_assert(!kKernelType<T>.empty(), "kernels know no such type (shared_struct.h)");
  }
  KernelArg(const char* name, int value)
      : name_(name), type_(kKernelType<int>), bits_(std::bit_cast<std::uint32_t>(value)) {}
  KernelArg(const char* name, float value)
      : name_(name), type_(kKernelType<float>), bits_(std::bit_cast<std::uint32_t>(value)) {}

 private:
  friend class Kernel;
  const char* name_;
  std::string_view type_;  ///< of the number, or of the buffer's elements
  const cl::Buffer* memory_ = nullptr;
  std::uint32_t bits_ = 0;
};

/// What a kernel's parameter is called, and its type as OpenCL C writes it, without qualifiers and
/// spaces: "float*".
struct KernelParameter {
  std::string name;
  std::string type;
  friend bool operator==(const KernelParameter&, const KernelParameter&) = default;
};
/// As the program's source says, for devices that do not tell (kernel.cpp asks them to).
[[nodiscard]] std::vector<KernelParameter> parameters_in(const std::string& source,
                                                         const std::string& kernel);

/// Run over `count` work-items padded to whole groups, however few; kernels return at once for
/// indices past the end. OpenCL on CPUs compiles a kernel anew for each size of its groups.
class Kernel {
 public:
  Kernel() = default;
  /// `group`: work-items handed out together, few when each is worth microseconds, 1 when there are
  /// no more than a CPU has cores; fewer where the device allows this kernel no more.
  Kernel(const cl::Program& program, const std::string& name, std::size_t group = 64);
  Kernel(Kernel&&) = default;
  Kernel& operator=(Kernel&&) = default;
  Kernel(const Kernel&) = delete;  // two would set the arguments of one kernel
  Kernel& operator=(const Kernel&) = delete;
  ~Kernel() = default;

  /// `more`: arguments that go together, as arrays. Throws std::logic_error for an argument that
  /// the kernel has no parameter for, of another type or twice, and for one that is missing.
  template <class... More>
  void run(cl::CommandQueue& queue, std::size_t count, std::initializer_list<KernelArg> args,
           const More&... more) {
    if (count == 0) return;
    set_all(args, more...);
    launch(queue, (count + group_ - 1) / group_);
  }

  /// Of whole work-groups, whose items work together.
  template <class... More>
  void run_teams(cl::CommandQueue& queue, std::size_t teams, std::initializer_list<KernelArg> args,
                 const More&... more) {
    if (teams == 0) return;
    set_all(args, more...);
    launch(queue, teams);
  }

  [[nodiscard]] const std::vector<KernelParameter>& parameters() const noexcept {
    return parameters_;
  }

 private:
  /// What a parameter was set to. The buffer is kept alive: another one at its address would be
  /// taken for it.
  struct Setting {
    cl::Buffer memory;
    std::uint32_t bits = 0;
    bool is_set = false;
  };
  /// The parameter that an argument of the last launch belongs to, by its place in the lists.
  struct Binding {
    const char* name = nullptr;
    std::string_view type;
    bool is_buffer = false;
    std::size_t parameter = 0;
  };

  template <class... More>
  void set_all(std::initializer_list<KernelArg> args, const More&... more) {
    place_ = 0;
    set(std::span<const KernelArg>(args.begin(), args.size()));
    (set(std::span<const KernelArg>(more)), ...);
    if (is_new_ || place_ != bindings_.size()) check_complete();
  }
  void set(std::span<const KernelArg> args);
  [[nodiscard]] bool is_written(const std::string& name, const std::string& type) const;
  [[nodiscard]] Binding bind(const KernelArg& arg) const;
  void check_complete();
  void launch(cl::CommandQueue& queue, std::size_t groups);

  cl::Kernel kernel_;
  std::string name_;
  std::size_t group_ = 64;
  bool has_run_ = false;
  std::vector<KernelParameter> parameters_;
  std::vector<Setting> settings_;  ///< of each parameter
  std::vector<Binding> bindings_;
  std::size_t place_ = 0;  ///< in the lists of this launch
  bool is_new_ = true;     ///< this launch's lists differ from the last one's
};

// Kernel sources to programs, with build errors that name the kernel's own file and line.

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

}  // namespace splash::sim
