// SPDX-License-Identifier: MIT
#include "program/this_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace splash::program {
namespace {

using testing::ElementsAre;

TEST(WithOptions, ReplacesAnOptionHoweverItWasWritten) {
  EXPECT_THAT(with_options({"sim", "--scene", "pool", "--listen=:1", "--fast"},
                           {{"--scene", "/a b.yaml"}, {"--listen", "127.0.0.1:2"}}),
              ElementsAre("sim", "--fast", "--scene=/a b.yaml", "--listen=127.0.0.1:2"));
}

TEST(WithOptions, AddsOneThatWasNotThereAndLeavesOthersAlone) {
  EXPECT_THAT(with_options({"synth", "--rig-x", "y", "--middle=1,2,3"}, {{"--middle", "-1,0,0"}}),
              ElementsAre("synth", "--rig-x", "y", "--middle=-1,0,0"));
  EXPECT_THAT(with_options({"synth", "--rig"}, {{"--rig", "shoes"}}),
              ElementsAre("synth", "--rig=shoes"));
}

}  // namespace
}  // namespace splash::program
