// SPDX-License-Identifier: MIT
#include "program/files.hpp"

#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <fstream>
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

namespace {

const char* cure(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "; free space there or name a file elsewhere";
    case ENOENT:
    case ENOTDIR:
      return "; name a file in a folder that exists";
    case EISDIR:
      return "; name a file in it";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; name a file in a folder that you may write to";
    case EFBIG:
      return "; the limit of file sizes is reached ('ulimit -f'): raise it";
    default:
      return "";
  }
}

}  // namespace

std::string write_error(int error) {
  return (error != 0 ? std::strerror(error) : std::string("input/output error")) + cure(error);
}

void write_file(const std::filesystem::path& path, const std::string& text,
                const std::string& what) {
  std::error_code ignored;
  const bool in_place =  // never replace a device or a pipe by a file
      std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored);
  const std::filesystem::path written = path.string() + (in_place ? "" : ".part");
  errno = 0;
  std::ofstream file(written, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  std::error_code error;
  if (!file) {
    error = std::error_code(errno, std::generic_category());
  } else if (in_place) {
    return;
  } else {
    std::filesystem::rename(written, path, error);
    if (!error) return;
  }
  if (!in_place) std::filesystem::remove(written, ignored);  // the first error is the one to tell
  throw WriteError(what, error.value());
}

}  // namespace splash::program
