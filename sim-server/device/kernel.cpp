// SPDX-License-Identifier: MIT
#include "sim-server/device/kernel.hpp"

#include <algorithm>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "sim-server/device/device_error.hpp"

namespace splash::sim {

namespace {

/// May compile (kernel.cpp says what that means).
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

void note_made() {
  const std::lock_guard lock(ledger().mutex);
  ++ledger().count.all;
}

/// A declaration in two: the last word is the name, the one before it the type.
KernelParameter parameter_of(std::string declaration) {
  const bool is_pointer = declaration.find('*') != std::string::npos;
  std::replace(declaration.begin(), declaration.end(), '*', ' ');
  std::istringstream words(declaration);
  KernelParameter parameter;
  for (std::string word; words >> word;) {
    parameter.type = std::exchange(parameter.name, word);
  }
  if (is_pointer) parameter.type += '*';
  return parameter;
}

/// A type without what some devices add to it.
std::string plain(std::string type) {
  type.erase(std::min(type.find(';'), type.size()));
  std::erase(type, ' ');
  return type;
}

std::vector<KernelParameter> parameters_of(const cl::Program& program, const cl::Kernel& kernel,
                                           const std::string& name) {
  std::vector<KernelParameter> parameters;
  try {
    const auto count = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    for (cl_uint i = 0; i < count; ++i) {
      parameters.push_back({kernel.getArgInfo<CL_KERNEL_ARG_NAME>(i),
                            plain(kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(i))});
    }
  } catch (const cl::Error& error) {
    if (error.err() != CL_KERNEL_ARG_INFO_NOT_AVAILABLE) throw;
    parameters = parameters_in(program.getInfo<CL_PROGRAM_SOURCE>(), name);
  }
  return parameters;
}

}  // namespace

void tell_of_kernels(std::function<void(const KernelCount&)> told) {
  const std::lock_guard lock(ledger().mutex);
  ledger().told = std::move(told);
}

std::vector<KernelParameter> parameters_in(const std::string& source, const std::string& kernel) {
  const std::string head = "kernel void " + kernel + "(";
  const std::size_t at = source.find(head);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + head.size();
  std::istringstream list(source.substr(begin, source.find(')', begin) - begin));
  std::vector<KernelParameter> parameters;
  for (std::string declaration; std::getline(list, declaration, ',');) {
    parameters.push_back(parameter_of(declaration));
  }
  return parameters;
}

Kernel::Kernel(const cl::Program& program, const std::string& name, std::size_t group)
    : kernel_(program, name.c_str()),
      name_(name),
      group_(group),
      parameters_(parameters_of(program, kernel_, name)),
      settings_(parameters_.size()) {
  const auto device = program.getInfo<CL_PROGRAM_DEVICES>().front();
  group_ = std::clamp<std::size_t>(kernel_.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device), 1,
                                   group);
  note_made();
}

/// Whether the program's source gives a parameter this type: a device may have its own way to say
/// it.
bool Kernel::is_written(const std::string& name, const std::string& type) const {
  const auto program = kernel_.getInfo<CL_KERNEL_PROGRAM>();
  const std::vector<KernelParameter> written =
      parameters_in(program.getInfo<CL_PROGRAM_SOURCE>(), name_);
  return std::find(written.begin(), written.end(), KernelParameter{name, type}) != written.end();
}

Kernel::Binding Kernel::bind(const KernelArg& arg) const {
  const std::string name = arg.name_;
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const KernelParameter& p) { return p.name == name; });
  if (found == parameters_.end()) {
    throw std::logic_error("the kernel " + name_ + " has no parameter " + name);
  }
  const std::string type = std::string(arg.type_) + (arg.memory_ != nullptr ? "*" : "");
  if (arg.type_ != kAnyKernelType && found->type != type && !is_written(found->name, type)) {
    throw std::logic_error("the parameter " + name + " of the kernel " + name_ + " is " +
                           found->type + ", and was given " + type);
  }
  return {arg.name_, arg.type_, arg.memory_ != nullptr,
          static_cast<std::size_t>(found - parameters_.begin())};
}

void Kernel::set(std::span<const KernelArg> args) {
  for (const KernelArg& arg : args) {
    const bool is_buffer = arg.memory_ != nullptr;
    if (place_ >= bindings_.size() || bindings_[place_].name != arg.name_ ||
        bindings_[place_].type != arg.type_ || bindings_[place_].is_buffer != is_buffer) {
      is_new_ = true;
      bindings_.resize(std::max(bindings_.size(), place_ + 1));
      bindings_[place_] = bind(arg);
    }
    const std::size_t index = bindings_[place_++].parameter;
    Setting& setting = settings_[index];
    if (is_buffer) {
      if (setting.is_set && setting.memory() == (*arg.memory_)()) continue;
      kernel_.setArg(static_cast<cl_uint>(index), *arg.memory_);
      setting.memory = *arg.memory_;
    } else {
      if (setting.is_set && setting.bits == arg.bits_) continue;
      kernel_.setArg(static_cast<cl_uint>(index), arg.bits_);
      setting.bits = arg.bits_;
    }
    setting.is_set = true;
  }
}

void Kernel::check_complete() {
  is_new_ = true;
  bindings_.resize(place_);
  std::vector<int> times(parameters_.size(), 0);
  for (const Binding& binding : bindings_) ++times[binding.parameter];
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] == 1) continue;
    throw std::logic_error("the parameter " + parameters_[i].name + " of the kernel " + name_ +
                           (times[i] == 0 ? " was given nothing" : " was given twice"));
  }
  is_new_ = false;
}

void Kernel::launch(cl::CommandQueue& queue, std::size_t groups) {
  const cl_int error = enqueue(queue(), kernel_(), groups * group_, group_);
  if (error != CL_SUCCESS) throw cl::Error(error, "clEnqueueNDRangeKernel");
  if (has_run_) return;
  has_run_ = true;
  const std::lock_guard lock(ledger().mutex);
  ++ledger().count.ready;
  if (ledger().told) ledger().told(ledger().count);
}

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
