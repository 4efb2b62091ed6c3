// SPDX-License-Identifier: MIT
// Both real programs: the synth asks the simulator for the forces on a body that is moved under
// water, where no event happens, and lets them be felt; both record them, and what was recorded
// feels the same again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

/// A sound with nothing but the texture: all else is 50 dB down or more.
constexpr const char* kTextureAlone =
    "name: texture\nimpact: {amplitude: 0.000001}\nbubble: {gain_db: -60}\n"
    "cavity: {gain_db: -60}\nfoot: {texture: 0.001, power: 1}\n";

/// The body's height `seconds` long, swinging by `swing` [m] around the middle of the water.
void move(Simulator& simulator, double seconds, float swing) {
  const double start = protocol::monotonic_now();
  for (double t = 0.0; t < seconds; t = protocol::monotonic_now() - start) {
    protocol::BodyPose pose;
    const double turn = 2.0 * std::numbers::pi * 2.5 * t;
    pose.position = {0.0F, 0.0F, 0.1F + swing * static_cast<float>(std::sin(turn))};
    simulator.send(protocol::encode(protocol::to_message(pose)));
    sleep(0.005);
  }
}

double effective(const std::vector<float>& samples, std::size_t from, std::size_t to) {
  double sum = 0.0;
  to = std::min(to, samples.size());
  for (std::size_t n = from; n < to; ++n)
    sum += static_cast<double>(samples[n]) * static_cast<double>(samples[n]);
  return from < to ? std::sqrt(sum / static_cast<double>(to - from)) : 0.0;
}

/// Largest effective value of a second.
double loudest_second(const std::vector<float>& samples) {
  double loudest = 0.0;
  for (std::size_t n = 0; n + 48000 <= samples.size(); n += 2400) {
    loudest = std::max(loudest, effective(samples, n, n + 48000));
  }
  return loudest;
}

/// What a shoe feels of a body that rests in the water for a while and is then moved; and of the
/// logs of both programs.
struct Felt {
  double at_rest = 0.0;
  double moved = 0.0;
  double loudest = 0.0;           ///< within a second
  double of_simulator_log = 0.0;  ///< the same of the simulator's log
  bool same_of_synth_log = false;
};

/// A log as the same rig and sound render it.
Recording rendered(const std::string& log, const std::string& sound) {
  const std::string wav = log + ".wav";
  const auto [code, text] =
      run_program("synth-server", {"--rig", rig_path("handheld.yaml"), "--sound", sound, "--replay",
                                   log, "--render", wav, "--fade-in", "2"});
  EXPECT_EQ(code, 0) << text;
  return read_recording(wav);
}

Felt felt(bool asks) {
  const SmallScene scene(tracked());
  const TemporaryFolder folder;
  const std::string sound = folder.write("texture.yaml", kTextureAlone);
  const std::string wav = folder / "texture.wav";
  const std::string told = folder / "told.osc";
  const std::string started = folder / "started.osc";
  Simulator simulator({"--scene", scene.path(), "--record", told, "--record-forces"});
  EXPECT_TRUE(simulator.process().wait_for_text("running")) << simulator.process().output();
  move(simulator, 1.0, 0.0F);  // down into the water
  Arguments arguments = {
      "--rig", rig_path("handheld.yaml"), "--sound", sound, "--device", "null", "--record-audio",
      wav,     "--record-events",         started};
  if (asks) {
    arguments.insert(arguments.end(), {"--forces", protocol::to_string(simulator.endpoint())});
  }
  Synth synth(arguments);
  const double rest = asks ? 2.8 : 1.0;  // [s]; it opens within two
  constexpr double kMoved = 1.5;         // [s]
  move(simulator, rest, 0.0F);
  move(simulator, kMoved, 0.02F);
  EXPECT_EQ(synth.end(), 0) << synth.process().output();
  EXPECT_EQ(simulator.end(), 0) << simulator.process().output();
  const auto heard = read_recording(wav).channels.at(0);
  const auto sample = [](double seconds) { return static_cast<std::size_t>(seconds * 48000.0); };
  Felt felt = {effective(heard, sample(2.0), sample(rest - 0.1)),
               effective(heard, sample(rest + 0.4), sample(rest + kMoved))};
  if (asks) {
    const auto again = rendered(started, sound).channels.at(0);
    const auto whole = static_cast<std::ptrdiff_t>(sample(rest + kMoved));  // then it fades out
    felt.same_of_synth_log = std::equal(heard.begin(), heard.begin() + whole, again.begin(),
                                        [](float a, float b) { return std::abs(a - b) < 1e-6F; });
    felt.loudest = loudest_second(heard);
    felt.of_simulator_log = loudest_second(rendered(told, sound).channels.at(0));
  }
  return felt;
}

TEST(Underfoot, FeelsTheForcesOfTheRealSimulatorWhenItAsks) {
  const Felt with = felt(true);
  const Felt without = felt(false);
  std::cout << "at rest " << with.at_rest << ", moved " << with.moved << "; without forces "
            << without.moved << " of full scale\n";
  EXPECT_GT(with.moved, 0.01);
  EXPECT_GT(with.moved, 5.0 * with.at_rest) << "follows how the force changes";
  EXPECT_LT(without.moved, 0.1 * with.moved) << "nothing happens that is an event";
  std::cout << "loudest second " << with.loudest << ", by the simulator's log "
            << with.of_simulator_log << '\n';
  EXPECT_NEAR(with.of_simulator_log / with.loudest, 1.0, 0.25) << "other noise, same forces";
  EXPECT_TRUE(with.same_of_synth_log) << "the samples of its own recording";
}

}  // namespace
}  // namespace splash::tests
