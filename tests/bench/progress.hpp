// SPDX-License-Identifier: MIT
// A line on a terminal that says how far a run is, until it is written over with what came of it.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <utility>

namespace splash::bench {

class Progress {
 public:
  explicit Progress(std::string what) : what_(std::move(what)) {}
  /// Of the run; shown not more often than every two seconds.
  void operator()(double share) {
    const auto now = std::chrono::steady_clock::now();
    if (!on_terminal_ || now - shown_ < std::chrono::seconds(2)) return;
    shown_ = now;
    std::printf("\r%s %3.0f %%", what_.c_str(), 100.0 * std::min(share, 1.0));
    std::fflush(stdout);
  }
  /// Where the last line begins: over this one.
  [[nodiscard]] std::string end() const { return (on_terminal_ ? "\r" : "") + what_; }

 private:
  std::string what_;
  bool on_terminal_ = isatty(STDOUT_FILENO) != 0;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

}  // namespace splash::bench
