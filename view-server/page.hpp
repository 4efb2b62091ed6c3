// SPDX-License-Identifier: MIT
// The files of page/, held by the program.
#pragma once

#include <string_view>
#include <vector>

namespace splash::view {

struct PageFile {
  std::string_view name;  ///< as asked for, without the first slash
  std::string_view text;
};

/// Written by write_page.cmake.
[[nodiscard]] const std::vector<PageFile>& page_files();

}  // namespace splash::view
