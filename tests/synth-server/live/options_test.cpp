// SPDX-License-Identifier: MIT
#include "synth-server/options.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "program/failure.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::synth {
namespace {

ParsedOptions parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "synth-server");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

/// The numbers of `sound` after what the command line says of it.
SoundNumbers sound_with(const Options& options, Sound sound = {}) {
  apply(options.sound, sound);
  return numbers_of(sound);
}

TEST(Options, HaveSafeDefaults) {
  const auto parsed = parse({"--rig", "x.yaml"});
  ASSERT_TRUE(parsed.options);
  EXPECT_EQ(protocol::to_string(parsed.options->listen), "127.0.0.1:57310");
  EXPECT_TRUE(parsed.options->allow.empty());
  EXPECT_EQ(sound_with(*parsed.options), numbers_of(Sound{})) << "the paper's";
  EXPECT_DOUBLE_EQ(parsed.options->late_window, 0.050);
  EXPECT_LT(parsed.options->latency, 0.0) << "by the block";
  EXPECT_FALSE(parsed.options->muted);
}

TEST(Options, ReadWhatIsGiven) {
  const auto parsed = parse({"--rig", "x.yaml", "--listen", "0.0.0.0:9000", "--allow", "10.0.0.5",
                             "--allow", "10.0.0.6", "--chirp", "integrated", "--latency-ms", "20",
                             "--late-ms", "100", "--seed", "7", "--device", "null"});
  ASSERT_TRUE(parsed.options);
  EXPECT_EQ(protocol::to_string(parsed.options->listen), "0.0.0.0:9000");
  EXPECT_EQ(parsed.options->allow, (std::vector<std::uint32_t>{0x0A000005, 0x0A000006}));
  EXPECT_DOUBLE_EQ(parsed.options->latency, 0.020);
  EXPECT_DOUBLE_EQ(parsed.options->late_window, 0.100);
  EXPECT_EQ(parsed.options->engine.seed, 7U);
}

TEST(Options, ChooseHowVoicesSound) {
  const auto parsed =
      parse({"--rig", "x.yaml", "--bubbles", "physical", "--water-level", "-0.5",
             "--impact-exponent", "1.5", "--max-voices", "60000", "--no-skip", "unfelt"});
  ASSERT_TRUE(parsed.options);
  const EngineSettings& engine = parsed.options->engine;
  EXPECT_DOUBLE_EQ(engine.water_level, -0.5);
  EXPECT_EQ(engine.max_voices, 60000);
  EXPECT_FALSE(engine.skip_unfelt);
  EXPECT_TRUE(engine.skip_silent);
  EXPECT_TRUE(engine.skip_out_of_band);
}

TEST(Options, ChangeOneRowOfTheSoundWhateverItsFileSays) {
  Sound file;
  file.bubble.rise = file.cavity.rise = 0.3;
  file.bubble.physical = file.cavity.physical = 0.5;
  file.bubble.pitch = 2.0;
  const auto with = [&](std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"--rig", "x.yaml", "--sound", "mine"});
    const auto parsed = parse(arguments);
    EXPECT_TRUE(parsed.options);
    return parsed.options ? sound_with(*parsed.options, file) : SoundNumbers{};
  };
  EXPECT_EQ(with({}), numbers_of(file));
  Sound wanted = file;
  wanted.impact.exponent = 1.5;
  EXPECT_EQ(with({"--impact-exponent", "1.5"}), numbers_of(wanted));
  wanted = file;
  wanted.bubble.rise = wanted.cavity.rise = 0.05;
  EXPECT_EQ(with({"--chirp", "integrated"}), numbers_of(wanted));
  wanted.bubble.physical = wanted.cavity.physical = 1.0;
  EXPECT_EQ(with({"--bubbles", "physical"}), numbers_of(wanted)) << "theory knows no literal chirp";
  wanted = file;
  wanted.bubble.rise = wanted.cavity.rise = 0.1;
  wanted.bubble.physical = wanted.cavity.physical = 0.0;
  EXPECT_EQ(with({"--bubbles", "paper", "--chirp", "literal"}), numbers_of(wanted));
}

TEST(Options, RefuseToRenderOverTheLog) {
  const tests::TemporaryFolder folder;
  const auto log = folder.write("log.osc", "events");
  const std::string other = (log.parent_path() / "." / log.filename()).string();
  const auto parsed = parse({"--rig", "x", "--replay", log.c_str(), "--render", other.c_str()});
  EXPECT_FALSE(parsed.options) << "the same file by another name";
  EXPECT_EQ(parsed.exit_code, program::kExitUsage);
  EXPECT_FALSE(
      parse({"--rig", "x", "--replay", log.c_str(), "--record-events", other.c_str()}).options);
  std::filesystem::remove(log);
  EXPECT_TRUE(parse({"--rig", "x", "--replay", log.c_str(), "--record-events", "b"}).options);
  EXPECT_TRUE(parse({"--rig", "x", "--replay", log.c_str(), "--render", other.c_str()}).options);
}

TEST(Options, RefuseNonsenseAsUsage) {
  for (const std::vector<const char*>& bad : std::vector<std::vector<const char*>>{
           {},
           {"--bogus"},
           {"--rig"},
           {"--rig", "x", "--listen", "nowhere:99999"},
           {"--rig", "x", "--listen", "127.0.0.1:x"},
           {"--rig", "x", "--tail", "1"},
           {"--rig", "x", "--replay", "a.osc", "--tail", "nan"},
           {"--rig", "x", "--replay", "a.osc", "--stems"},
           {"--rig", "x", "--render", "a.wav"},
           {"--rig", "x", "--stems"},
           {"--rig", "x", "--block", "1"},
           {"--rig", "x", "--sample-rate", "nan"},
           {"--rig", "x", "--chirp", "up"},
           {"--rig", "x", "--bubbles", "soap"},
           {"--rig", "x", "--max-voices", "0"},
           {"--rig", "x", "--no-skip", "all"},
           {"--rig", "x", "--api", "oss"},
           {"--rig", "x", "--late-ms", "-1"},
           {"--rig", "x", "--late-ms", "nan"},
           {"--rig", "x", "--latency-ms", "-NaN"},
           {"--rig", "x", "--horizon-ms", "nan"},
           {"--rig", "x", "--water-level", "nan"},
           {"--rig", "x", "--impact-exponent", "nan(1)"},
           {"--rig", "x", "--replay", "a", "--render", "b", "--record-audio", "c"}}) {
    const auto parsed = parse(bad);
    EXPECT_FALSE(parsed.options);
    EXPECT_EQ(parsed.exit_code, program::kExitUsage);
  }
}

TEST(Options, HelpAndVersionAreNoErrors) {
  for (const char* flag : {"--help", "--version"}) {
    const auto parsed = parse({flag});
    EXPECT_FALSE(parsed.options);
    EXPECT_EQ(parsed.exit_code, program::kExitOk);
  }
}

}  // namespace
}  // namespace splash::synth
