// SPDX-License-Identifier: MIT
#include "synth-server/figure/wav_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/figure/wav_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::synth {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class WavReader : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& bytes) const {
    return folder_.write("a.wav", bytes);
  }

  void expect_refused(const std::string& bytes, const std::string& reason) const {
    const std::filesystem::path path = file(bytes);
    EXPECT_THAT([&] { read_wav(path); }, ThrowsMessage<std::runtime_error>(HasSubstr(reason)));
  }

 private:
  tests::TemporaryFolder folder_;
};

TEST_F(WavReader, ReadsFloatChannelsApart) {
  const WavSignal signal =
      read_wav(file(testing::float_file(2, 48000, {0.5F, -1.0F, 0.25F, 2.0F})));
  EXPECT_EQ(signal.sample_rate, 48000.0);
  EXPECT_THAT(signal.channels, ElementsAre(ElementsAre(0.5F, 0.25F), ElementsAre(-1.0F, 2.0F)));
}

TEST_F(WavReader, ReadsPcmOfEveryWidth) {
  const auto read_one = [&](int bits, std::uint32_t raw) {
    return read_wav(
               file(testing::riff(testing::chunk("fmt ", testing::format(1, 1, 44100, bits)) +
                                  testing::chunk("data", testing::little_endian(raw, bits / 8)))))
        .channels.at(0)
        .at(0);
  };
  EXPECT_EQ(read_one(16, 0x4000), 0.5F);
  EXPECT_EQ(read_one(16, 0x8000), -1.0F);
  EXPECT_EQ(read_one(24, 0xC00000), -0.5F);
  EXPECT_EQ(read_one(32, 0x20000000), 0.25F);
}

TEST_F(WavReader, SkipsChunksItDoesNotKnowOddLengthsToo) {
  const WavSignal signal = read_wav(file(testing::riff(
      testing::chunk("LIST", "odd") + testing::chunk("fmt ", testing::format(3, 1, 8000, 32)) +
      testing::chunk("data", testing::floats({0.125F})))));
  EXPECT_THAT(signal.channels, ElementsAre(ElementsAre(0.125F)));
}

TEST_F(WavReader, TakesWhatIsThereWhenTheRecorderWasKilled) {
  std::string bytes = testing::float_file(1, 8000, {0.5F, 0.25F, 0.125F});
  bytes.resize(bytes.size() - 4);
  EXPECT_THAT(read_wav(file(bytes)).channels, ElementsAre(ElementsAre(0.5F, 0.25F)));
}

TEST_F(WavReader, RefusesWhatItCannotRead) {
  expect_refused("no wave", "RIFF");
  expect_refused(testing::riff(testing::chunk("fmt ", testing::format(1, 1, 8000, 8)) +
                               testing::chunk("data", "aa")),
                 "8 bits is not read");
  expect_refused(testing::riff(testing::chunk("fmt ", testing::format(3, 1, 8000, 32))),
                 "no data chunk");
  expect_refused(testing::riff(testing::chunk("data", testing::floats({1.0F}))),
                 "before their format");
  expect_refused(testing::riff(testing::chunk("fmt ", testing::format(3, 0, 8000, 32)) +
                               testing::chunk("data", "")),
                 "no channels");
  EXPECT_THAT([] { read_wav("/nonexistent/a.wav"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot be opened")));
}

}  // namespace
}  // namespace splash::synth
