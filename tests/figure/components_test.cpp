// SPDX-License-Identifier: MIT
#include "synth-server/figure/components.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/figure/wav_text.hpp"

namespace splash::synth {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Components, KeepTheChannelThatWasHitAndFillShortFiles) {
  const std::filesystem::path folder = testing::fresh_folder("components");
  const auto stereo = [&](const std::string& name, const std::vector<float>& samples) {
    testing::write(folder / name,
                   testing::riff(testing::chunk("fmt ", testing::format(3, 2, 1000, 32)) +
                                 testing::chunk("data", testing::floats(samples))));
    return folder / name;
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
  std::filesystem::remove_all(folder);
}

TEST(Components, WhatWasPlayedIsTheSignalAndSaysHowLongItLasts) {
  const std::filesystem::path folder = testing::fresh_folder("components-played");
  testing::write_mono(folder / "part.wav", 1000, {0.25F, 0.25F, 0.25F, 0.25F});
  testing::write_mono(folder / "played.wav", 1000, {0.5F, -0.5F, 0.125F});
  const auto part = folder / "part.wav";
  const Components components = read_components({part, part, part, folder / "played.wav"});
  EXPECT_THAT(components.signal(), ElementsAre(0.5F, -0.5F, 0.125F));
  EXPECT_THAT(components.bubble, ElementsAre(0.25F, 0.25F, 0.25F));
  EXPECT_THAT(cut(components, 0.001, 0.002).signal(), ElementsAre(-0.5F));
  std::filesystem::remove_all(folder);
}

TEST(Components, RefuseFilesOfDifferentRates) {
  const std::filesystem::path folder = testing::fresh_folder("components-rates");
  testing::write_mono(folder / "a.wav", 48000, {0.5F});
  testing::write_mono(folder / "b.wav", 44100, {0.5F});
  EXPECT_THAT(
      [&] {
        read_components({folder / "a.wav", folder / "a.wav", folder / "b.wav", {}});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("the files differ")));
  std::filesystem::remove_all(folder);
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
