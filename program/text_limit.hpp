// SPDX-License-Identifier: MIT
// Limits how much text per second other hosts can make a program print, so that they cannot fill a
// disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace splash::program {

class TextLimit {
 public:
  static constexpr double kRate = 64.0 * 1024.0;    ///< bytes per second, in the long run [1/s]
  static constexpr double kBurst = 256.0 * 1024.0;  ///< bytes at once after a rest

  /// Passes `line` to `print` if it may be printed at `now` (monotonic [s]), and before it the
  /// number of lines that were left out since the last one.
  void print(const std::string& line, double now,
             const std::function<void(const std::string&)>& print);

 private:
  double left_ = kBurst;  ///< bytes
  double filled_ = 0.0;   ///< until then [s]
  std::uint64_t left_out_ = 0;
};

}  // namespace splash::program
