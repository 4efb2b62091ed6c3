// SPDX-License-Identifier: MIT
#include "program/text_limit.hpp"

#include <algorithm>

namespace splash::program {

void TextLimit::print(const std::string& line, double now,
                      const std::function<void(const std::string&)>& print) {
  left_ = std::min(kBurst, left_ + kRate * std::max(0.0, now - filled_));
  filled_ = now;
  const auto size = static_cast<double>(line.size() + 1);
  if (size > left_) {
    ++left_out_;
    return;
  }
  left_ -= size;
  if (left_out_ > 0) print("(" + std::to_string(left_out_) + " lines too many were left out)");
  left_out_ = 0;
  print(line);
}

}  // namespace splash::program
