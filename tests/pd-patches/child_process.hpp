// SPDX-License-Identifier: MIT
// A program run by a test: its output goes to a file, it never outlives the test.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace splash::pd {

class ChildProcess {
 public:
  /// Starts `arguments[0]` (searched in PATH) with `environment` on top of the test's own; stdout
  /// and stderr go to `output`. Throws std::runtime_error when it cannot.
  ChildProcess(const std::vector<std::string>& arguments,
               const std::vector<std::pair<std::string, std::string>>& environment,
               std::filesystem::path output);
  /// SIGTERM, then SIGKILL, to the child alone.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Exit status, when it ends within `seconds`; 128 + signal when one ended it.
  std::optional<int> wait(double seconds);
  /// What it has printed so far.
  [[nodiscard]] std::string output() const;

 private:
  pid_t pid_ = -1;
  std::filesystem::path output_;
  std::optional<int> status_;
};

}  // namespace splash::pd
