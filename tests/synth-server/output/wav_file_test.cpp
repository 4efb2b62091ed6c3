// SPDX-License-Identifier: MIT
// WAV files are read back as they were written, also when the writer never came to close them.
#include "synth-server/output/wav_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::synth {
namespace {

struct WavContent {
  int format = 0;
  int subformat = 0;  ///< of the extensible format; else 0
  int channels = 0;
  int sample_rate = 0;
  std::uint32_t riff_size = 0;
  bool rf64 = false;
  std::uint64_t big_riff_size = 0;  ///< RF64: as its ds64 chunk has it
  std::uint64_t big_frames = 0;
  std::vector<float> samples;  ///< interleaved
};

/// Reads float WAV files chunk by chunk, knowing nothing of the writer.
WavContent read_wav(const std::filesystem::path& path) {
  const std::string bytes = tests::text_of(path);
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    if (at + size > bytes.size()) throw std::runtime_error("WAV: truncated");
    std::memcpy(&value, bytes.data() + at, size);
    return value;
  };
  const auto number64 = [&](std::size_t at) {
    return number(at, 4) | static_cast<std::uint64_t>(number(at + 4, 4)) << 32U;
  };
  WavContent content;
  content.rf64 = bytes.substr(0, 4) == "RF64";
  if ((bytes.substr(0, 4) != "RIFF" && !content.rf64) || bytes.substr(8, 4) != "WAVE") {
    throw std::runtime_error("WAV: no RIFF/WAVE");
  }
  std::uint64_t big_data_size = 0;
  content.riff_size = number(4, 4);
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string id = bytes.substr(at, 4);
    const bool elsewhere = content.rf64 && id == "data" && number(at + 4, 4) == 0xFFFFFFFFU;
    const std::size_t size = elsewhere ? big_data_size : number(at + 4, 4);
    if (at + 8 + size > bytes.size()) throw std::runtime_error("WAV: chunk passes the end");
    if (id == "ds64") {
      content.big_riff_size = number64(at + 8);
      big_data_size = number64(at + 16);
      content.big_frames = number64(at + 24);
    }
    if (id == "fmt ") {
      content.format = static_cast<int>(number(at + 8, 2));
      content.channels = static_cast<int>(number(at + 10, 2));
      content.sample_rate = static_cast<int>(number(at + 12, 4));
      if (size >= 40) content.subformat = static_cast<int>(number(at + 32, 2));
    }
    if (id == "data") {
      content.samples.resize(size / sizeof(float));
      std::memcpy(content.samples.data(), bytes.data() + at + 8, size);
      break;
    }
    at += 8 + size + size % 2;
  }
  return content;
}

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Wav : public testing::Test {
 protected:
  const tests::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "out.wav";
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
  EXPECT_THAT([] { const WavFile file("/no/such/folder/out.wav", 1, 1000); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("/no/such/folder/out.wav"), HasSubstr("No such"))));
}

TEST_F(Wav, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const auto fill = [] {
    WavFile file("/dev/full", 1, 1000);
    write(file, 1, 0, 200000);
    file.close();
  };
  EXPECT_THAT(fill, ThrowsMessage<std::runtime_error>(
                        AllOf(HasSubstr("/dev/full"), HasSubstr("No space"))));
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

static_assert(WavFile::kRiffLimit < 0xFFFFFFFF, "that value means RF64");

TEST_F(Wav, RefusesImpossibleChannels) {
  EXPECT_THROW(WavFile(path_, 0, 48000), std::invalid_argument);
  EXPECT_THROW(WavFile(path_, 16384, 48000), std::invalid_argument);
}

}  // namespace
}  // namespace splash::synth
