// SPDX-License-Identifier: MIT
// The patch that holds events until their time, in the real pd, by pd's own clock: delay, offset,
// and how much earlier splash-advance lets all of them come.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/pd-patches/rendering.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::pd {
namespace {

/// An event with an offset of 5 ms in a bundle with a delay of 40 ms; prints when it comes.
constexpr const char* kPatch = R"(#N canvas 0 0 600 400 12;
#X obj 20 20 r go;
#X obj 20 50 t b b b b;
#X msg 400 80 40;
#X msg 20 80 1 0 0.01 0.1 0 0 0 5;
#X obj 20 120 splash-delay;
#X obj 20 160 t b;
#X obj 20 200 timer;
#X obj 20 240 print came;
#X obj 200 80 del 300;
#X msg 200 110 \; pd quit;
#X connect 0 0 1 0;
#X connect 1 0 3 0;
#X connect 1 1 8 0;
#X connect 1 2 6 0;
#X connect 1 3 2 0;
#X connect 2 0 4 1;
#X connect 3 0 4 0;
#X connect 4 0 5 0;
#X connect 5 0 6 1;
#X connect 6 0 7 0;
#X connect 8 0 9 0;
)";

/// How long the event waits, after this message to the patches [ms]; negative: it never came.
double waited(const std::string& message = {}) {
  const tests::TemporaryFolder folder;
  const std::string patch = folder.write("delay.pd", kPatch);
  const std::string patches = std::string(SPLASH_SOURCE_DIR) + "/pd-patches";
  std::vector<std::string> command = batch({"-path", patches, "-open", patch});
  if (!message.empty()) command.insert(command.end(), {"-send", message});
  command.insert(command.end(), {"-send", "go bang"});
  tests::ChildProcess pd(command);
  EXPECT_EQ(pd.wait_for_end(), 0) << pd.output();
  const std::string output = pd.output();
  const auto found = output.find("came: ");
  return found == std::string::npos ? -1.0 : std::strtod(output.c_str() + found + 6, nullptr);
}

TEST(Delay, IsThatOfBundleAndEventLessTheAdvance) {
  EXPECT_NEAR(waited(), 40.0 + 5.0 - 10.0, 0.01) << "10 ms where nothing is told";
  EXPECT_NEAR(waited("splash-advance 25"), 20.0, 0.01);
  EXPECT_NEAR(waited("splash-advance 0"), 45.0, 0.01);
  EXPECT_NEAR(waited("splash-advance 200"), 0.0, 0.01) << "no earlier than it was told";
}

}  // namespace
}  // namespace splash::pd
