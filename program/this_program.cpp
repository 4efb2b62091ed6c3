// SPDX-License-Identifier: MIT
#include "program/this_program.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

namespace splash::program {
namespace {

bool is_loader(const std::filesystem::path& file) {
  return file.filename().string().starts_with("ld-");
}

}  // namespace

std::filesystem::path this_program() {
  std::error_code error;
  std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const char* starter = std::getenv("SPLASH_PROGRAM");
  if (starter != nullptr && is_loader(file)) return starter;
  return file;
}

}  // namespace splash::program
