// SPDX-License-Identifier: MIT
#include "program/start_anew.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "program/failure.hpp"
#include "program/this_program.hpp"

namespace splash::program {

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
