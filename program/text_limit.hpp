// SPDX-License-Identifier: MIT
// What strangers can make a program print: so much a second, lest they fill a disk.
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

  /// Gives `line` to `print` if it may be printed at `now` (monotonic [s]), and before it how many
  /// were left out since the last.
  void print(const std::string& line, double now,
             const std::function<void(const std::string&)>& print);

 private:
  double left_ = kBurst;  ///< bytes
  double filled_ = 0.0;   ///< until then [s]
  std::uint64_t left_out_ = 0;
};

}  // namespace splash::program
