// SPDX-License-Identifier: MIT
// WAV files are read back as they were written, also when the writer never came to close them.
#include "synth-server/output/wav_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <vector>

#include "tests/synth-server/output/wav_reader.hpp"

namespace splash::synth {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Wav : public testing::Test {
 protected:
  Wav() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            ("splash-" + std::string(test->name()) + std::to_string(::getpid()) + ".wav");
  }
  ~Wav() override { std::filesystem::remove(path_); }
  std::filesystem::path path_;
};

float value(int channel, int frame) {
  return static_cast<float>(channel) + static_cast<float>(frame) / 65536.0F;
}

void write(WavFile& file, int channels, int first, int frames) {
  std::vector<std::vector<float>> planar(static_cast<std::size_t>(channels));
  std::vector<const float*> pointers;
  for (int c = 0; c < channels; ++c) {
    auto& samples = planar[static_cast<std::size_t>(c)];
    for (int i = 0; i < frames; ++i) samples.push_back(value(c, first + i));
    pointers.push_back(samples.data());
  }
  file.write(pointers.data(), frames);
}

void expect_content(const WavContent& content, int channels, int frames) {
  EXPECT_EQ(content.channels, channels);
  ASSERT_EQ(content.samples.size(), static_cast<std::size_t>(channels * frames));
  for (int i = 0; i < frames; ++i) {
    for (int c = 0; c < channels; ++c) {
      ASSERT_EQ(content.samples[static_cast<std::size_t>(i * channels + c)], value(c, i));
    }
  }
}

TEST_F(Wav, OfThirtySixChannelsIsExtensible) {
  WavFile file(path_, 36, 44100);
  write(file, 36, 0, 100);
  write(file, 36, 100, 57);
  file.close();
  const WavContent content = read_wav(path_);
  EXPECT_EQ(content.format, 0xFFFE);
  EXPECT_EQ(content.subformat, 3);
  EXPECT_EQ(content.sample_rate, 44100);
  EXPECT_EQ(content.riff_size + 8, std::filesystem::file_size(path_));
  expect_content(content, 36, 157);
}

TEST_F(Wav, OfTwoChannelsIsPlainFloat) {
  WavFile file(path_, 2, 48000);
  write(file, 2, 0, 10);
  file.close();
  const WavContent content = read_wav(path_);
  EXPECT_EQ(content.format, 3);
  EXPECT_EQ(content.riff_size + 8, std::filesystem::file_size(path_));
  expect_content(content, 2, 10);
}

TEST_F(Wav, IsReadableWhileItIsWritten) {
  WavFile file(path_, 1, 1000);
  write(file, 1, 0, 1000);  // a second: the header follows
  write(file, 1, 1000, 500);
  const WavContent content = read_wav(path_);
  expect_content(content, 1, 1000);
}

TEST_F(Wav, SaysWhichFileCannotBeCreated) {
  try {
    const WavFile file("/no/such/folder/out.wav", 1, 1000);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("/no/such/folder/out.wav"), HasSubstr("No such")));
  }
}

TEST_F(Wav, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  try {
    WavFile file("/dev/full", 1, 1000);
    write(file, 1, 0, 200000);
    file.close();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("/dev/full"), HasSubstr("No space")));
  }
}

TEST_F(Wav, BecomesRf64BeyondTheLimitOfRiff) {
  for (const std::uint64_t limit : {std::uint64_t{0xFFFFFFFE}, std::uint64_t{100000}}) {
    WavFile file(path_, 3, 1000, limit);
    for (int first = 0; first < 10000; first += 1000) write(file, 3, first, 1000);  // 120 kB
    EXPECT_EQ(read_wav(path_).samples.size(), 30000U) << "also while it is written";
    file.close();
    const WavContent content = read_wav(path_);
    EXPECT_EQ(content.rf64, limit < 120000);
    expect_content(content, 3, 10000);
    if (!content.rf64) continue;
    EXPECT_EQ(content.riff_size, 0xFFFFFFFFU);
    EXPECT_EQ(content.big_riff_size + 8, std::filesystem::file_size(path_));
    EXPECT_EQ(content.big_frames, 10000U);
  }
}

TEST_F(Wav, LimitIsThatOfThe32BitsOfRiff) {
  WavFile file(path_, 1, 48000);
  write(file, 1, 0, 10);
  file.close();
  EXPECT_FALSE(read_wav(path_).rf64);
  static_assert(WavFile::kRiffLimit < 0xFFFFFFFF, "that value means RF64");
}

TEST_F(Wav, RefusesImpossibleChannels) {
  EXPECT_THROW(WavFile(path_, 0, 48000), std::invalid_argument);
  EXPECT_THROW(WavFile(path_, 16384, 48000), std::invalid_argument);
}

}  // namespace
}  // namespace splash::synth
