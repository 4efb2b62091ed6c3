// SPDX-License-Identifier: MIT
// What libFuzzer calls: one program per target, chosen by SPLASH_FUZZ_TRY.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    splash::fuzz::SPLASH_FUZZ_TRY(std::as_bytes(std::span(data, size)));
  } catch (const std::exception& broken) {
    std::fprintf(stderr, "broken: %s\n", broken.what());
    std::abort();
  }
  return 0;
}
