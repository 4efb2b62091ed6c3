// SPDX-License-Identifier: MIT
// Every file of kernels names what it uses: with its own includes alone it compiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sim-server/device/kernel.hpp"
#include "tests/support/text_of.hpp"

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
    if (entry.path().extension() != ".cl") continue;
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
  const std::string text = tests::text_of(root() / name);
  for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) {
    add_file((*it)[1].str(), seen, sources);
  }
  sources.push_back({name, std::regex_replace(text, kInclude, "\n//")});
}

/// What the device calls the parameters of a program's kernels is what its source does: a name that
/// OpenCL has for a function may be another one there.
void expect_parameters_of(const cl::Program& program) {
  const auto text = program.getInfo<CL_PROGRAM_SOURCE>();
  std::vector<cl::Kernel> kernels;
  cl::Program(program).createKernels(&kernels);
  for (const cl::Kernel& kernel : kernels) {
    const auto name = kernel.getInfo<CL_KERNEL_FUNCTION_NAME>();
    const std::vector<KernelParameter> told = Kernel(program, name).parameters();
    const std::vector<KernelParameter> written = parameters_in(text, name);
    ASSERT_EQ(told.size(), written.size()) << name;
    for (std::size_t i = 0; i < told.size(); ++i) {
      EXPECT_EQ(told[i].name, written[i].name) << name;
      EXPECT_EQ(told[i].type, written[i].type) << name << ", " << told[i].name;
    }
  }
}

TEST(KernelFiles, CompileWithTheirOwnIncludes) {
  Device device;
  const std::vector<std::string> files = kernel_files();
  ASSERT_GT(files.size(), 20U);
  for (const std::string& file : files) {
    std::set<std::string> seen;
    std::vector<KernelSource> sources;
    add_file(file, seen, sources);
    EXPECT_NO_THROW(expect_parameters_of(build_program(device, sources, {}))) << file;
  }
}

}  // namespace
}  // namespace splash::sim
