// SPDX-License-Identifier: MIT
// Sounds as files: the shipped ones, what is left out, and what is wrong with its place.
#include "synth-server/sound/sound_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/refusal.hpp"
#include "tests/support/text_of.hpp"

namespace splash::synth {
namespace {

using testing::HasSubstr;

const std::filesystem::path kFolder = std::filesystem::path(SPLASH_SOURCE_DIR) / "configs/sounds";

TEST(Sound, Cirio2013IsWhatTheVoicesPlayUntold) {
  const NamedSound sound = read_sound(kFolder / "cirio2013.yaml");
  EXPECT_EQ(sound.name, "cirio2013");
  EXPECT_EQ(numbers_of(sound.sound), numbers_of(Sound{}));
}

TEST(Sound, EveryShippedOneIsReadAndCalledLikeItsFile) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".yaml") continue;
    const NamedSound sound = read_sound(entry.path());
    EXPECT_EQ(sound.name, entry.path().stem().string());
    EXPECT_FALSE(sound.description.empty()) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 1);
}

TEST(Sound, IsThePapersWhereItsFileSaysNothing) {
  const NamedSound sound = parse_sound("name: mine\nimpact: {q: 2}\ncavity: {gain_db: -6}\n", "x");
  Sound wanted;
  wanted.impact.q = 2.0;
  wanted.cavity.gain_db = -6.0;
  EXPECT_EQ(sound.name, "mine");
  EXPECT_EQ(numbers_of(sound.sound), numbers_of(wanted));
}

/// Every number of a sound has its row: a file that sets each to another value leaves none as it
/// is.
template <class Part>
std::string all_rows(const std::string& part, const std::vector<Field<Part>>& fields, Part before) {
  std::string text = part + ":\n";
  for (const Field<Part>& field : fields) {
    const double number = before.*std::get<double Part::*>(field.member);
    const double other = number == field.row.max ? field.row.min : 0.5 * (number + field.row.max);
    text += "  " + field.row.key + ": " + std::to_string(other) + "\n";
  }
  return text;
}

TEST(Sound, HasARowForEachOfItsNumbers) {
  const Sound unset;
  std::string text = "name: all\n";
  each_part(unset, [&text](const char* part, const auto& numbers) {
    text += all_rows(part, fields_of(numbers, part), numbers);
  });
  const NamedSound sound = parse_sound(text, "all.yaml");
  const SoundNumbers paper = numbers_of(Sound{});
  const SoundNumbers set = numbers_of(sound.sound);
  for (std::size_t i = 0; i < kSoundNumbers; ++i) EXPECT_NE(set[i], paper[i]) << "number " << i;
}

template <class Part>
void expect_rows_complete(const std::vector<Field<Part>>& fields) {
  const Part paper;
  std::set<std::string> keys;
  for (const auto& field : fields) {
    SCOPED_TRACE(field.row.key);
    const double number = paper.*std::get<double Part::*>(field.member);
    EXPECT_TRUE(keys.insert(field.row.key).second);
    EXPECT_FALSE(field.row.unit.empty());
    EXPECT_FALSE(field.row.meaning.empty());
    EXPECT_GE(number, field.row.min);
    EXPECT_LE(number, field.row.max);
    EXPECT_TRUE(std::isfinite(field.row.max - field.row.min));
  }
}

TEST(Sound, EveryRowHasAUnitAMeaningAndARangeAroundThePapersValue) {
  const Sound paper;
  each_part(paper, [](const char* part, const auto& numbers) {
    SCOPED_TRACE(part);
    expect_rows_complete(fields_of(numbers, part));
  });
}

struct Broken {
  std::string text;
  std::string place;
  std::string words;
};

class BrokenSound : public testing::TestWithParam<Broken> {};
INSTANTIATE_TEST_SUITE_P(
    All, BrokenSound,
    testing::Values(Broken{"impact: {q: 5}\n", "sound.yaml:1:", "name"},
                    Broken{"name: x\nimpact:\n  attak: 0.1\n", "sound.yaml:3:3:", "attack"},
                    Broken{"name: x\nimpact: {q: 51}\n", "sound.yaml:2:13:", "50"},
                    Broken{"name: x\nbubble: {pitch: high}\n", "sound.yaml:2:17:", "high"},
                    Broken{"name: x\nbubble: {pitch: .nan}\n", "sound.yaml:2:17:", "pitch"},
                    Broken{"name: x\nbuble: {pitch: 1}\n", "sound.yaml:2:1:", "bubble"},
                    Broken{"name: x\ncavity: 3\n", "sound.yaml:2:9:", "mapping"},
                    Broken{"name: x\noutputs: []\n", "sound.yaml:2:10:", "this is a rig"},
                    Broken{"name: x\ntank: {}\n", "sound.yaml:2:7:", "this is a scene"}));

TEST_P(BrokenSound, IsAnsweredWithItsPlaceAndTheReason) {
  EXPECT_THAT(tests::refusal([] { return parse_sound(GetParam().text, "sound.yaml"); }),
              AllOf(HasSubstr(GetParam().place), HasSubstr(GetParam().words)))
      << GetParam().text;
}

TEST(SoundKeys, AreWhatTheReadmeOfTheSoundsSays) {
  EXPECT_THAT(tests::text_of(kFolder / "README.md"), HasSubstr(describe_sound_keys()))
      << "put the output of sound-reference behind the README's text";
}

}  // namespace
}  // namespace splash::synth
