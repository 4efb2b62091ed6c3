// SPDX-License-Identifier: MIT
#include "tests/support/process_use.hpp"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace splash::tests {

long resident(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  }
  return 0;
}

double cpu_seconds(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  text.erase(0, text.rfind(')') + 1);  // the name may have spaces
  std::vector<std::string> fields;
  std::istringstream words(text);
  for (std::string word; words >> word;) fields.push_back(word);
  return (std::stod(fields.at(11)) + std::stod(fields.at(12))) /
         static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace splash::tests
