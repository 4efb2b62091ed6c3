// SPDX-License-Identifier: MIT
// The ways kernels are built: every vector width on whatever device there is.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace splash::sim {

struct Build {
  int lanes = 1;
};

/// Else GoogleTest prints the bytes, padding and all, into the tests' names.
inline void PrintTo(const Build& build, std::ostream* out) {
  *out << build.lanes;
}

inline const auto kBuilds = ::testing::Values(Build{1}, Build{8}, Build{16});
/// For what does not sum over neighbours: 8 lanes are 16 with other numbers.
inline const auto kScalarAndVector = ::testing::Values(Build{1}, Build{16});

inline std::string build_name(const ::testing::TestParamInfo<Build>& info) {
  return std::to_string(info.param.lanes) + "_lanes";
}

}  // namespace splash::sim
