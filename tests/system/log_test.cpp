// SPDX-License-Identifier: MIT
// The event log: the same seed writes the same bytes, its replay gives the same bits, and others'
// tools read it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/text_of.hpp"
#include "tests/system/small_scene.hpp"

namespace splash::tests {
namespace {

class Log : public testing::Test {
 protected:
  ~Log() override {
    for (const std::string& file : files_) std::filesystem::remove(file);
  }

  std::string file(const std::string& name) {
    files_.push_back(temporary_path(name));
    return files_.back();
  }

  /// Three seconds of plunging; the path of their log.
  std::string record(const std::string& name, int seed = 1,
                     const ChildProcess::Environment& environment = {}) {
    const SmallScene scene(plunging(), seed);
    std::string log = file(name);
    const auto [code, text] =
        run_program("sim-server",
                    {"--scene", scene.path(), "--listen", "127.0.0.1:0", "--record", log,
                     "--duration", "3", "--faster-than-real-time"},
                    120.0, environment);
    EXPECT_EQ(code, 0) << text;
    told_ = text;
    return log;
  }

  /// What the last recording program said.
  [[nodiscard]] const std::string& told() const noexcept { return told_; }

  std::string render(const std::string& log, const std::string& name) {
    std::string wav = file(name);
    const auto [code, text] = run_program(
        "synth-server", {"--rig", rig_path("handheld.yaml"), "--replay", log, "--render", wav});
    EXPECT_EQ(code, 0) << text;
    return wav;
  }

 private:
  std::vector<std::string> files_;
  std::string told_;
};

TEST_F(Log, SameSeedWritesTheSameBytes) {
  const std::string first = text_of(record("first.osc"));
  EXPECT_GT(first.size(), 1000U);
  EXPECT_EQ(first, text_of(record("second.osc")));
  EXPECT_NE(first, text_of(record("other.osc", 2))) << "another seed, another log";
}

TEST_F(Log, OneProcessorTellsTheSameAsAll) {
  const std::string all = text_of(record("all.osc"));
  // By the names that PoCL 3 and its successors know.
  const std::string one = text_of(
      record("one.osc", 1, {{"POCL_MAX_PTHREAD_COUNT", "1"}, {"POCL_CPU_MAX_CU_COUNT", "1"}}));
  EXPECT_THAT(told(), testing::HasSubstr("(CPU, 1 compute units"));
  EXPECT_GT(all.size(), 1000U);
  EXPECT_EQ(one, all);
}

TEST_F(Log, ReplayedTwiceGivesTheSameBits) {
  const std::string log = record("replayed.osc");
  const std::string first = render(log, "first.wav");
  EXPECT_GT(peak(read_recording(first).channels.at(0)), 0.001F) << "something is heard";
  EXPECT_EQ(text_of(first), text_of(render(log, "second.wav")));
}

/// An OSC number, most significant byte first.
std::uint64_t number(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes.at(at + i));
  }
  return value;
}

TEST_F(Log, HasTheFramingOfScoreFiles) {
  const std::string log = record("framed.osc");
  EXPECT_GT(protocol::read_log(log).size(), 10U) << "each packet passed the gate";
  // Once more by hand, as scsynth reads it: a length, a bundle of that length, times that rise.
  const std::string bytes = text_of(log);
  std::uint64_t last = 0;
  std::size_t bundles = 0;
  for (std::size_t at = 0; at < bytes.size(); ++bundles) {
    const std::size_t size = number(bytes, at, 4);
    ASSERT_LE(size, 1472U);
    ASSERT_EQ(bytes.substr(at + 4, 8), std::string("#bundle\0", 8)) << "bundle " << bundles;
    const std::uint64_t time = number(bytes, at + 12, 8);
    EXPECT_GE(time, last) << "bundle " << bundles;
    last = time;
    at += 4 + size;
    ASSERT_LE(at, bytes.size());
  }
  EXPECT_EQ(bundles, protocol::read_log(log).size());
  EXPECT_NEAR(static_cast<double>(last >> 32U), 3.0, 1.0) << "seconds since the start";
}

TEST_F(Log, OpensInScsynth) {
  if (!std::filesystem::exists("/usr/bin/scsynth")) GTEST_SKIP() << "there is no scsynth";
  const std::string log = record("score.osc");
  const std::string wav = file("score.wav");
  ChildProcess scsynth(
      {"/usr/bin/scsynth", "-V", "-1", "-o", "1", "-N", log, "_", wav, "48000", "WAV", "float"});
  EXPECT_EQ(scsynth.wait_for_end(), 0) << scsynth.output();
  // It knows none of our commands, but renders until the last one's time.
  const Recording recording = read_recording(wav);
  ASSERT_EQ(recording.channels.size(), 1U);
  EXPECT_NEAR(static_cast<double>(recording.channels[0].size()) / 48000.0,
              protocol::read_log(log).back().seconds, 0.01);
}

}  // namespace
}  // namespace splash::tests
