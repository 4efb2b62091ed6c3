// SPDX-License-Identifier: MIT
// All kernels in the eyes of clang's front end, for the targets of GPUs' compilers: OpenCL C 1.2
// without a single extension, no double, no half, nothing that only PoCL knows.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim-server/fluid/kernel_sources.hpp"

namespace splash::sim {

namespace kernels {
std::vector<KernelSource> detect();
std::vector<KernelSource> gauge();
std::vector<KernelSource> pin();
}  // namespace kernels

namespace {

struct Target {
  const char* name;
  const char* triple;
  const char* defines;
};

struct NamedProgram {
  const char* name;
  std::vector<KernelSource> sources;
};

std::vector<NamedProgram> programs() {
  return {{"fluid", fluid_sources()},
          {"divergence_free", divergence_free_sources()},
          {"free_bodies", free_body_sources()},
          {"reduce_stats", stats_sources()},
          {"pin", kernels::pin()},
          {"grid_projected", grid_projected_sources()},
          {"detect", kernels::detect()},
          {"gauge", kernels::gauge()}};
}

std::string output_of(const std::string& command, int& status) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return "cannot start " + command;
  std::string output;
  char part[4096];
  for (std::size_t size = 0; (size = fread(part, 1, sizeof part, pipe)) > 0;) {
    output.append(part, size);
  }
  status = pclose(pipe);
  return output;
}

class KernelLanguage : public ::testing::TestWithParam<Target> {
 protected:
  ~KernelLanguage() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::path(::testing::TempDir()) / ("kernels-" + std::to_string(getpid()) + ".cl");
};

TEST_P(KernelLanguage, IsUnderstood) {
  int status = 0;
  static_cast<void>(output_of("clang --version", status));
  if (status != 0) GTEST_SKIP() << "clang is not installed";
  for (const NamedProgram& program : programs()) {
    std::ofstream file(file_);
    for (const KernelSource& source : program.sources) {
      file << "#line 1 \"" << source.name << "\"\n" << source.text << '\n';
    }
    file.close();
    const std::string output = output_of(
        std::string("clang -x cl -cl-std=CL1.2 -Xclang -cl-ext=-all -Xclang "
                    "-finclude-default-header -fsyntax-only -nogpulib -Wno-unused-command-line-"
                    "argument -Werror=implicit-function-declaration -Werror=double-promotion "
                    "-target ") +
            GetParam().triple + ' ' + GetParam().defines + ' ' + file_.string(),
        status);
    EXPECT_EQ(status, 0) << program.name << ":\n" << output;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Targets, KernelLanguage,
    ::testing::Values(Target{"nvidia", "nvptx64-unknown-nvcl", "-DLANES=1 -DTEAM=64 -DJUDGES=256"},
                      Target{"amd", "amdgcn-amd-amdhsa", "-DLANES=1 -DTEAM=64 -DJUDGES=256"},
                      Target{"spir", "spir64-unknown-unknown", "-DLANES=1 -DTEAM=64 -DJUDGES=256"},
                      Target{"vectors", "spir64-unknown-unknown",
                             "-DLANES=16 -DTEAM=1 -DJUDGES=64"}),
    [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace splash::sim
