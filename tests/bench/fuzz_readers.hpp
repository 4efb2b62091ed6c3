// SPDX-License-Identifier: MIT
// The differential test at length: what the gate accepts, oscpack, liblo and our decoder read
// alike.
#pragma once

#include <cstdint>

namespace splash::bench {

/// `inputs` packets, half of them legal and half mutated. Prints progress and the counts; true when
/// no packet was read differently.
bool compare_readers(std::uint64_t inputs);

}  // namespace splash::bench
