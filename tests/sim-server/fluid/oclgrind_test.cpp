// SPDX-License-Identifier: MIT
// Every kernel of a step under oclgrind, which interprets them and sees each access: no data race,
// no access out of bounds, no misuse of the interface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <tuple>

namespace {

struct Ended {
  int status = 0;
  std::string output;
};

Ended run(const std::string& command) {
  Ended ended;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {-1, "cannot start " + command};
  std::array<char, 4096> part;
  std::size_t size = 0;
  while ((size = fread(part.data(), 1, part.size(), pipe)) > 0) {
    ended.output.append(part.data(), size);
  }
  ended.status = pclose(pipe);
  return ended;
}

/// Particles per vector, and whether the water is divergence-free.
class Oclgrind : public ::testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(Oclgrind, FindsNothing) {
  const auto [lanes, divergence_free] = GetParam();
  if (run("oclgrind --version").status != 0) GTEST_SKIP() << "oclgrind is not installed";
  // Its compiler's optimiser makes instructions that its interpreter does not know.
  const Ended ended =
      run("timeout 280 oclgrind --data-races --check-api --build-options -cl-opt-disable " +
          std::string(SPLASH_BINARY_DIR) + "/sim_fluid_two_steps " + std::to_string(lanes) + " " +
          std::to_string(divergence_free));
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_THAT(ended.output, ::testing::HasSubstr("Oclgrind: 251 particles"));
  for (const char* report : {"Invalid", "race", "error", "ERROR", "CL_"}) {
    EXPECT_THAT(ended.output, ::testing::Not(::testing::HasSubstr(report)));
  }
}

// Scalar kernels of the divergence-free solver take the interpreter minutes: by hand only.
INSTANTIATE_TEST_SUITE_P(LanesAndSolvers, Oclgrind,
                         ::testing::Values(std::tuple(1, 0), std::tuple(16, 0), std::tuple(16, 1)));

}  // namespace
