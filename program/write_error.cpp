// SPDX-License-Identifier: MIT
#include "program/write_error.hpp"

#include <cerrno>
#include <cstring>

namespace splash::program {
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

}  // namespace splash::program
