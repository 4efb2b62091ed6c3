// SPDX-License-Identifier: MIT
#include "program/this_program.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "program/failure.hpp"

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

std::vector<std::string> with_options(const std::vector<std::string>& line,
                                      const OptionValues& options) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool apart = std::any_of(options.begin(), options.end(),
                                   [&](const auto& option) { return line[i] == option.first; });
    const bool together = std::any_of(options.begin(), options.end(), [&](const auto& option) {
      return line[i].starts_with(option.first + '=');
    });
    if (apart) ++i;  // its value, too
    if (!apart && !together) result.push_back(line[i]);
  }
  for (const auto& [name, value] : options) {
    result.push_back(name);
    result.back() += '=' + value;
  }
  return result;
}

void start_anew(const std::vector<std::string>& line) {
  std::vector<std::string> words = line;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  const std::string program = this_program().string();
  execv(program.c_str(), arguments.data());
  throw Failure(kExitUnavailable,
                "cannot begin anew with '" + program + "': " + std::strerror(errno));
}

}  // namespace splash::program
