// SPDX-License-Identifier: MIT
// All kernels in the eyes of clang, for the targets of GPUs' compilers: OpenCL C 1.2 without a
// single extension, no double, no half, nothing that only PoCL knows; with the warnings of the
// host's code as errors, but for functions that a program has of a shared header and does not
// call, and parameters that vectors alone have a use for. What kernels take of a GPU stays within
// its documented limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/fluid/params/parts.hpp"
#include "tests/support/programs.hpp"

namespace splash::sim {

namespace kernels {
std::vector<KernelSource> detect();
std::vector<KernelSource> gauge();
std::vector<KernelSource> pin();
}  // namespace kernels

namespace {

using testing::Each;
using testing::Eq;
using testing::Le;

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
  return {{"fluid", kernels::fluid()},
          {"free_bodies", kernels::free_bodies()},
          {"reduce_stats", kernels::stats()},
          {"pin", kernels::pin()},
          {"grid_projected", kernels::grid_projected()},
          {"tank_turn", kernels::tank_turn()},
          {"detect", kernels::detect()},
          {"gauge", kernels::gauge()}};
}

class Compiled : public ::testing::Test {
 protected:
  void SetUp() override {
    if (tests::run_command({"clang", "--version"}, 10.0).code != 0) {
      GTEST_SKIP() << "clang is not installed";
    }
  }
  ~Compiled() override { std::filesystem::remove(file_); }

  /// What clang prints for `program`; `how`: what it makes, and for which target.
  std::string compile(const NamedProgram& program, const std::string& how) const {
    std::ofstream file(file_);
    for (const KernelSource& source : program.sources) {
      file << "#line 1 \"" << source.name << "\"\n" << source.text << '\n';
    }
    file.close();
    const std::string command =
        "clang -x cl -cl-std=CL1.2 -Xclang -cl-ext=-all -Xclang -finclude-default-header "
        "-nogpulib -Wno-unused-command-line-argument -Wall -Wextra -Wshadow -Wdouble-promotion "
        "-Werror -Wno-unused-function -Wno-unused-parameter " +
        how + ' ' + file_.string();
    const tests::Ended ended = tests::run_command({"sh", "-c", command}, 100.0);
    EXPECT_EQ(ended.code, 0) << program.name << ":\n" << ended.text;
    return ended.text;
  }

 private:
  std::filesystem::path file_ =
      std::filesystem::path(::testing::TempDir()) / ("kernels-" + std::to_string(getpid()) + ".cl");
};

class KernelLanguage : public Compiled, public ::testing::WithParamInterface<Target> {};

TEST_P(KernelLanguage, IsUnderstood) {
  for (const NamedProgram& program : programs()) {
    compile(program,
            std::string("-fsyntax-only -target ") + GetParam().triple + ' ' + GetParam().defines);
  }
}

/// All numbers that follow `key` in a text.
std::vector<int> numbers_after(const std::string& text, const std::string& key) {
  std::vector<int> found;
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    found.push_back(std::atoi(text.c_str() + at + key.size()));
  }
  return found;
}

/// How many kernels stand in the sources of `program`.
std::size_t kernels_of(const NamedProgram& program) {
  std::size_t count = 0;
  for (const KernelSource& source : program.sources) {
    for (std::size_t at = source.text.find("kernel void "); at != std::string::npos;
         at = source.text.find("kernel void ", at + 1)) {
      ++count;
    }
  }
  return count;
}

// AMD's: 64 KiB of local memory for a work-group, 256 work-items where a kernel does not ask for
// more, 4 KiB of arguments; no kernel needs more registers than the 512 there are (ROCm's
// documentation of the AMDGPU target, and of OpenCL's limits).
TEST_F(Compiled, FitsAmdsLimits) {
  const Profile gpu = gpu_profile();
  EXPECT_LE(std::max({gpu.group, gpu.team, gpu.judges}), 256U);
  for (const NamedProgram& program : programs()) {
    const std::string code = compile(program,
                                     "-O1 -S -o - -target amdgcn-amd-amdhsa -mcpu=gfx90a "
                                     "-DLANES=1 -DTEAM=64 -DJUDGES=256");
    const std::vector<int> local = numbers_after(code, ".group_segment_fixed_size: ");
    EXPECT_EQ(local.size(), kernels_of(program)) << program.name;
    EXPECT_THAT(local, Each(Le(64 * 1024))) << program.name;
    EXPECT_THAT(numbers_after(code, ".kernarg_segment_size: "), Each(Le(4096))) << program.name;
    EXPECT_THAT(numbers_after(code, ".vgpr_spill_count: "), Each(Eq(0))) << program.name;
  }
}

// NVIDIA's: 48 KiB of shared memory that a kernel declares (CUDA C++ Programming Guide, technical
// specifications for each compute capability).
TEST_F(Compiled, FitsNvidiasLimits) {
  for (const NamedProgram& program : programs()) {
    const std::string code = compile(
        program, "-O1 -S -o - -target nvptx64-unknown-nvcl -DLANES=1 -DTEAM=64 -DJUDGES=256");
    std::map<std::string, int> shared;
    const std::regex declared(R"(\.shared \.align \d+ \.b8 (\w+)_\$_\w+\[(\d+)\])");
    for (std::sregex_iterator at(code.begin(), code.end(), declared), end; at != end; ++at) {
      shared[(*at)[1]] += std::stoi((*at)[2]);
    }
    EXPECT_EQ(code.find(".shared") != std::string::npos, !shared.empty()) << program.name;
    for (const auto& [kernel, bytes] : shared) EXPECT_LE(bytes, 48 * 1024) << kernel;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Targets, KernelLanguage,
    ::testing::Values(Target{"nvidia", "nvptx64-unknown-nvcl", "-DLANES=1 -DTEAM=64 -DJUDGES=256"},
                      Target{"amd", "amdgcn-amd-amdhsa", "-DLANES=1 -DTEAM=64 -DJUDGES=256"},
                      Target{"spir", "spir64-unknown-unknown", "-DLANES=1 -DTEAM=64 -DJUDGES=256"},
                      Target{"vectors", "spir64-unknown-unknown",
                             "-DLANES=16 -DTEAM=1 -DJUDGES=64"},
                      Target{"bodies_alone", "spir64-unknown-unknown",
                             "-DLANES=16 -DTEAM=1 -DJUDGES=64 -DHAS_SLOPE=0 -DHAS_PISTON=0 "
                             "-DHAS_FRICTION=0 -DHAS_MESH=0 -DHAS_POCKETS=0"},
                      Target{"water_alone", "spir64-unknown-unknown",
                             "-DLANES=16 -DTEAM=1 -DJUDGES=64 -DHAS_BODIES=0 -DHAS_SLOPE=0 "
                             "-DHAS_PISTON=0 -DHAS_FRICTION=0 -DHAS_MESH=0 -DHAS_POCKETS=0"}),
    [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace splash::sim
