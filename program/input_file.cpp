// SPDX-License-Identifier: MIT
#include "program/input_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "program/failure.hpp"

namespace splash::program {
namespace {

std::string nowhere(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto here = std::filesystem::current_path(ignored);
  return "there is no such file" + (path.is_absolute() ? std::string() : " in " + here.string());
}

std::string why_not(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return nowhere(path);
  if (error) return "it cannot be read: " + error.message();
  if (std::filesystem::is_directory(status)) return "it is a folder; name a file in it";
  if (!std::filesystem::is_regular_file(status)) return "it is a device or a pipe, not a file";
  if (access(path.c_str(), R_OK) == 0) return {};
  return std::string("it cannot be read: ") + std::strerror(errno);
}

}  // namespace

void require_readable(const std::string& option, const std::filesystem::path& path) {
  const std::string cause = why_not(path);
  if (!cause.empty()) throw Failure(kExitNoInput, option + " " + path.string() + ": " + cause);
}

}  // namespace splash::program
