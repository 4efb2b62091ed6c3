// SPDX-License-Identifier: MIT
// What a file says.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace splash::tests {

/// All bytes of the file; none when it cannot be read.
inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace splash::tests
