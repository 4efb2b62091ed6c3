// SPDX-License-Identifier: MIT
#include "synth-server/figure/components.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/figure/wav_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::synth {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Components, KeepTheChannelThatWasHitAndFillShortFiles) {
  const tests::TemporaryFolder folder;
  const auto stereo = [&](const std::string& name, const std::vector<float>& samples) {
    return folder.write(name, testing::float_file(2, 1000, samples));
  };
  const Components components =
      read_components({stereo("i.wav", {0.0F, 0.5F, 0.0F, 0.25F}),
                       stereo("b.wav", {0.1F, 0.0F}),
                       stereo("c.wav", {0.0F, 0.0F, 0.0F, 0.5F, 0.0F, 0.125F}),
                       {}});
  EXPECT_EQ(components.channel, 2);
  EXPECT_THAT(components.impact, ElementsAre(0.5F, 0.25F, 0.0F));
  EXPECT_THAT(components.bubble, ElementsAre(0.0F, 0.0F, 0.0F));
  EXPECT_THAT(components.signal(), ElementsAre(0.5F, 0.75F, 0.125F));
}

TEST(Components, WhatWasPlayedIsTheSignalAndSaysHowLongItLasts) {
  const tests::TemporaryFolder folder;
  folder.write("part.wav", testing::float_file(1, 1000, {0.25F, 0.25F, 0.25F, 0.25F}));
  folder.write("played.wav", testing::float_file(1, 1000, {0.5F, -0.5F, 0.125F}));
  const auto part = folder / "part.wav";
  const Components components = read_components({part, part, part, folder / "played.wav"});
  EXPECT_THAT(components.signal(), ElementsAre(0.5F, -0.5F, 0.125F));
  EXPECT_THAT(components.bubble, ElementsAre(0.25F, 0.25F, 0.25F));
  EXPECT_THAT(cut(components, 0.001, 0.002).signal(), ElementsAre(-0.5F));
}

TEST(Components, RefuseFilesOfDifferentRates) {
  const tests::TemporaryFolder folder;
  folder.write("a.wav", testing::float_file(1, 48000, {0.5F}));
  folder.write("b.wav", testing::float_file(1, 44100, {0.5F}));
  EXPECT_THAT(
      [&] {
        read_components({folder / "a.wav", folder / "a.wav", folder / "b.wav", {}});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("the files differ")));
}

TEST(Components, CutKeepsItsTime) {
  const Components whole{
      10.0, 0.0, 1, {0.0F, 1.0F, 2.0F, 3.0F}, {0.0F, 0.0F, 0.0F, 0.0F}, {4.0F, 5.0F, 6.0F, 7.0F}};
  const Components part = cut(whole, 0.1, 0.3);
  EXPECT_DOUBLE_EQ(part.start, 0.1);
  EXPECT_THAT(part.impact, ElementsAre(1.0F, 2.0F));
  EXPECT_THAT(part.cavity, ElementsAre(5.0F, 6.0F));
  EXPECT_EQ(cut(whole, 0.0, 99.0).impact.size(), 4U);
  EXPECT_THAT([&] { cut(whole, 0.5, 0.7); },
              ThrowsMessage<std::runtime_error>(HasSubstr("holds no sample")));
}

}  // namespace
}  // namespace splash::synth
