// SPDX-License-Identifier: MIT
// The ways kernels are built: every vector width on whatever device there is, and relaxed.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace splash::sim {

struct Build {
  int lanes = 1;
  bool relaxed = false;
};

/// Else GoogleTest prints the bytes, padding and all, into the tests' names.
inline void PrintTo(const Build& build, std::ostream* out) {
  *out << build.lanes << (build.relaxed ? " relaxed" : "");
}

inline const auto kBuilds =
    ::testing::Values(Build{1, false}, Build{8, false}, Build{16, false}, Build{16, true});

inline std::string build_name(const ::testing::TestParamInfo<Build>& info) {
  return std::to_string(info.param.lanes) + "_lanes" + (info.param.relaxed ? "_relaxed" : "");
}

}  // namespace splash::sim
