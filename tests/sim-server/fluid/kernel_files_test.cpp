// SPDX-License-Identifier: MIT
// Every file of the kernels names what it uses: with its own includes alone it compiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sim-server/device/program.hpp"

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

fs::path root() {
  return SPLASH_SOURCE_DIR;
}

/// From the source tree's root, in order.
std::vector<std::string> kernel_files() {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root() / "sim-server")) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".cl" && ending != ".h") continue;
    files.push_back(entry.path().lexically_relative(root()).generic_string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// As the build embeds them: `name` behind all that it includes, each once.
void add_file(const std::string& name, std::set<std::string>& seen,
              std::vector<KernelSource>& sources) {
  static const std::regex kInclude(R"(\n#include "([^"]+)\")");
  if (!seen.insert(name).second) return;
  std::ifstream in(root() / name);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) {
    add_file((*it)[1].str(), seen, sources);
  }
  sources.push_back({name, std::regex_replace(text, kInclude, "\n//")});
}

class KernelFile : public ::testing::TestWithParam<std::string> {};

TEST_P(KernelFile, CompilesWithItsOwnIncludes) {
  Device device;
  std::set<std::string> seen;
  std::vector<KernelSource> sources;
  add_file(GetParam(), seen, sources);
  if (GetParam().ends_with(".h")) {
    sources.push_back({"nothing.cl", "kernel void nothing(int count) {}\n"});
  }
  EXPECT_NO_THROW(static_cast<void>(build_program(device, sources, {}, false)));
}

INSTANTIATE_TEST_SUITE_P(, KernelFile, ::testing::ValuesIn(kernel_files()), [](const auto& file) {
  std::string name = file.param.substr(file.param.rfind('/') + 1);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace splash::sim
