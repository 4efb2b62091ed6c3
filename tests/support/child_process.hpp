// SPDX-License-Identifier: MIT
// A program run by a test: all it prints is kept, it never outlives the test.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace splash::tests {

class ChildProcess {
 public:
  using Environment = std::vector<std::pair<std::string, std::string>>;

  /// Starts `arguments[0]` (searched in PATH) with `environment` on top of the test's own. Throws
  /// std::runtime_error when it cannot.
  explicit ChildProcess(const std::vector<std::string>& arguments,
                        const Environment& environment = {});
  /// SIGTERM, then SIGKILL, to the child alone.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Exit status, when it ends within `seconds`; 128 + signal when one ended it.
  std::optional<int> wait(double seconds);
  /// The same, but kills it (SIGKILL) when `seconds` have passed.
  int wait_for_end(double seconds = 60.0);
  /// False when it ends or `seconds` pass before it prints `text`.
  bool wait_for_text(const std::string& text, double seconds = 60.0);
  void signal(int number) const;
  /// SIGTERM, and its exit status.
  int end();
  /// SIGKILL, and waits until it is gone.
  void kill();
  [[nodiscard]] bool running() { return !wait(0.0); }
  [[nodiscard]] pid_t id() const noexcept { return pid_; }
  /// What it has printed so far, to stdout and stderr.
  [[nodiscard]] std::string output() const;

 private:
  pid_t pid_ = -1;
  int output_ = -1;  ///< a file without a name
  std::optional<int> status_;
};

}  // namespace splash::tests
