// SPDX-License-Identifier: MIT
// OpenCL's errors are numbers: a person gets the call, the error's name and what to do.
#pragma once

#include <string>
#include <utility>

#include "program/failure.hpp"

namespace splash::sim {

/// There is no device, or it cannot do what is asked; the text names the cause and the cure.
class DeviceError : public program::Failure {
 public:
  explicit DeviceError(const std::string& text) : Failure(program::kExitUnavailable, text) {}
};

/// "clFinish failed: CL_OUT_OF_RESOURCES (-5); ..."
[[nodiscard]] std::string opencl_error_text(const char* call, int error);

/// To be called where an exception is handled: throws it again, a cl::Error as a DeviceError.
[[noreturn]] void rethrow_opencl_error();

/// Runs `action`; an OpenCL call that fails in it is told in words.
template <class Action>
auto naming_opencl_errors(Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (...) {
    rethrow_opencl_error();
  }
}

}  // namespace splash::sim
