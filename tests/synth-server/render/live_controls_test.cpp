// SPDX-License-Identifier: MIT
// What is changed while it plays: where numbers go, on which way, and what is heard of it.
#include "synth-server/render/live_controls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

using Layout = ControlLayout;

/// A rig, and what is sent to its engine.
struct Board {
  explicit Board(Rig played, std::size_t logarithmic = kSoundNumbers)
      : rig(std::move(played)),
        layout{rig.outputs.size(), static_cast<std::size_t>(channel_count(rig))},
        targets{control_values(rig, {}), std::vector<float>(layout.count(), 0.02F)},
        box(targets, logarithmic_only(logarithmic)) {
    settings = file_settings();
    settings.controls = &box;
  }
  [[nodiscard]] std::vector<char> logarithmic_only(std::size_t number) const {
    std::vector<char> all(layout.count(), 0);
    if (number < all.size()) all[number] = 1;
    return all;
  }
  void send(std::size_t number, double value, double seconds = 0.02) {
    targets.values[number] = value;
    targets.seconds[number] = static_cast<float>(seconds);
    box.send(targets);
  }

  Rig rig;
  Layout layout;
  ControlTargets targets;
  ControlBox box;
  EngineSettings settings;
};

/// Where a member stands among the sound's numbers.
template <class Change>
std::size_t number_of(const Change& change) {
  Sound changed;
  change(changed);
  const SoundNumbers before = numbers_of(Sound{});
  const SoundNumbers after = numbers_of(changed);
  std::size_t i = 0;
  while (i < kSoundNumbers && before[i] == after[i]) ++i;
  return i;
}
const std::size_t kCavityGain = number_of([](Sound& s) { s.cavity.gain_db = 1.0; });
const std::size_t kImpactFrequency = number_of([](Sound& s) { s.impact.frequency = 1.0; });

/// Largest change of slope from sample to sample: what a click is.
double bend(const std::vector<float>& s) {
  double most = 0.0;
  for (std::size_t i = 2; i < s.size(); ++i) {
    most = std::max(most, std::abs(static_cast<double>(s[i]) - 2.0 * static_cast<double>(s[i - 1]) +
                                   static_cast<double>(s[i - 2])));
  }
  return most;
}

TEST(LiveControls, NothingChangesUntilSomethingIsSent) {
  Board board(floor_rig());
  Engine plain(board.rig, file_settings());
  Engine live(board.rig, board.settings);
  for (const TimedEvent& event : splashes(200, 4000)) {
    plain.schedule(event);
    live.schedule(event);
  }
  EXPECT_EQ(render(plain, 9600), render(live, 9600));
}

TEST(LiveControls, AGainGoesThereWithin20MillisecondsWithoutAClick) {
  Board board(open_rig());
  Engine plain(board.rig, file_settings());
  Engine live(board.rig, board.settings);
  for (Engine* engine : {&plain, &live}) engine->schedule({cavity(0.02F), 0});
  const auto before = render(plain, 4800)[0];
  EXPECT_EQ(render(live, 4800)[0], before);
  board.send(kCavityGain, -20.0);
  const auto whole = render(plain, 4800)[0];
  const auto turned = render(live, 4800)[0];
  const double most = loudest(whole);
  EXPECT_GT(loudest({turned.begin(), turned.begin() + 320}), 0.6 * most) << "not at once";
  for (std::size_t i = 1100; i < turned.size(); ++i) {  // there after 23 ms
    ASSERT_NEAR(static_cast<double>(turned[i]), 0.1 * static_cast<double>(whole[i]), 0.03 * most)
        << "but for what the band's high-pass remembers";
  }
  EXPECT_LT(bend(turned), 1.05 * bend(whole)) << "no click";
}

TEST(LiveControls, MuteAndSoloOfComponents) {
  const std::vector<protocol::Event> events = {impact(2.0F), bubble(0.005F), cavity(0.05F)};
  ASSERT_EQ(events.size(), protocol::kEventKinds) << "one of each kind, which can be heard";
  const auto heard = [&](std::size_t number) {
    Board board(open_rig());
    Engine engine(board.rig, board.settings);
    board.send(number, 1.0);
    render(engine, 4800);
    std::vector<bool> sounds;
    for (const protocol::Event& event : events) {
      engine.schedule({event, engine.clock()});
      sounds.push_back(loudest(render(engine, 2400)[0]) > 1e-4);
      render(engine, 48000 * 8);
    }
    return sounds;
  };
  for (std::size_t k = 0; k < events.size(); ++k) {
    ASSERT_EQ(events[k].index(), k);
    std::vector<bool> others(events.size(), true);
    others[k] = false;
    EXPECT_EQ(heard(Layout::mute(k)), others) << protocol::kKindNames[k].plural;
    others.flip();
    EXPECT_EQ(heard(Layout::solo(k)), others) << protocol::kKindNames[k].plural;
  }
}

TEST(LiveControls, LevelsMuteAndSoloOfOutputsAndChannels) {
  Rig rig = open_rig();
  rig.outputs.push_back(rig.outputs[0]);
  rig.outputs[1].name = "pair";
  rig.outputs[1].kind = OutputKind::stereo;
  const auto levels = [&](std::size_t number, double value) {
    Board board(rig);
    Engine plain(board.rig, file_settings());
    Engine live(board.rig, board.settings);
    board.send(number, value);
    for (Engine* engine : {&plain, &live}) {
      render(*engine, 4800);
      engine->schedule({bubble(0.01F), 4800});
    }
    const auto whole = render(plain, 2400);
    const auto turned = render(live, 2400);
    std::vector<double> ratios;
    for (std::size_t c = 0; c < 3; ++c) ratios.push_back(loudest(turned[c]) / loudest(whole[c]));
    return ratios;
  };
  const auto expect = [](const std::vector<double>& found, const std::vector<double>& wanted) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 1e-5) << c;
  };
  const Layout layout{2, 3};
  expect(levels(Layout::of_output(1, Layout::gain_db), -20.0), {1.0, 0.1, 0.1});
  expect(levels(Layout::of_output(1, Layout::output_mute), 1.0), {1.0, 0.0, 0.0});
  expect(levels(Layout::of_output(1, Layout::output_solo), 1.0), {0.0, 1.0, 1.0});
  expect(levels(layout.of_channel(2, Layout::trim_db), 20.0 * std::log10(2.0)), {1.0, 1.0, 2.0});
  expect(levels(layout.of_channel(2, Layout::channel_mute), 1.0), {1.0, 1.0, 0.0});
  expect(levels(layout.of_channel(1, Layout::channel_solo), 1.0), {0.0, 1.0, 0.0});
}

TEST(LiveControls, ALoweredCeilingIsNotPassed) {
  Board board(open_rig());
  board.rig.outputs[0].ceiling = 0.9;
  board.rig.outputs[0].band.low = 20.0;  // so that the limiter comes back soon
  Engine engine(board.rig, board.settings);
  for (int i = 0; i < 30; ++i) engine.schedule({cavity(0.1F), i * 480});
  EXPECT_GT(loudest(render(engine, 24000)[0]), 0.85);
  board.send(Layout::of_output(0, Layout::ceiling), 0.2);
  const auto lowered = render(engine, 24000)[0];
  EXPECT_LE(loudest(lowered), 0.9);
  EXPECT_LE(loudest(lowered, 1200), 0.2);
  EXPECT_GT(loudest(lowered, 1200), 0.19);
}

TEST(LiveControls, MovesEvenlyInDecibelsAndInTheLogarithmOfFrequencies) {
  Board board(open_rig(), kImpactFrequency);
  LiveControls controls(board.rig, {}, kRate, &board.box);
  board.send(kCavityGain, -20.0, 1.0);
  board.send(kImpactFrequency, 105.0, 1.0);
  for (int cell = 0; cell < 375; ++cell) controls.begin_cell();  // half of 750
  EXPECT_NEAR(controls.sound().cavity.gain_db, -10.0, 1e-9);
  EXPECT_NEAR(controls.sound().impact.frequency, 210.0, 1e-9);
  board.send(kCavityGain, -40.0, 0.02);  // another way is taken from where it is
  for (int cell = 0; cell < 15; ++cell) controls.begin_cell();
  EXPECT_EQ(controls.sound().cavity.gain_db, -40.0);
  for (int cell = 0; cell < 361; ++cell) controls.begin_cell();
  EXPECT_EQ(controls.sound().impact.frequency, 105.0) << "exactly what was asked for";
  EXPECT_EQ(controls.component(2).begin, controls.component(2).end) << "and steady";
}

TEST(LiveControls, WhatStartsIsAsTheSoundIsThen) {
  Board board(open_rig());
  Engine live(board.rig, board.settings);
  board.send(number_of([](Sound& s) { s.bubble.pitch = 2.0; }), 0.5);
  render(live, 4800);
  live.schedule({bubble(0.005F), 4800});
  auto settings = file_settings();
  settings.sound.bubble.pitch = 0.5;
  Engine low(board.rig, settings);
  render(low, 4800);
  low.schedule({bubble(0.005F), 4800});
  EXPECT_EQ(render(live, 4800), render(low, 4800));
}

// Turned up, an output needs voices that would not be felt at the rig's level.
TEST(LiveControls, AnOutputThatIsTurnedUpGetsWeakerVoices) {
  Rig rig = open_rig();
  rig.outputs[0].threshold = {Sense::touch, -52.0};
  Board board(rig);
  Engine engine(rig, board.settings);
  const auto started = [&] {
    const std::uint64_t before = engine.counters().started.of<protocol::Bubble>();
    engine.schedule({bubble(0.005F, 0.0005F), engine.clock()});
    render(engine, 4800);
    return engine.counters().started.of<protocol::Bubble>() - before;
  };
  EXPECT_EQ(started(), 0U);
  board.send(Layout::of_output(0, Layout::gain_db), 40.0);
  render(engine, 4800);
  EXPECT_EQ(started(), 1U);
}

// A reader never sees a part of one message and a part of another.
TEST(ControlBox, HandsOverWhole) {
  constexpr int kMessages = 20000;
  constexpr std::size_t kNumbers = 4000;  // it takes a while to write or read them
  ControlTargets targets{std::vector<double>(kNumbers, 0.0), std::vector<float>(kNumbers, 0.0F)};
  ControlBox box(targets, std::vector<char>(kNumbers, 0));
  const std::jthread writer([&] {
    for (int message = 1; message <= kMessages; ++message) {
      std::fill(targets.values.begin(), targets.values.end(), message);
      box.send(targets);
    }
  });
  double last = 0.0;
  int taken = 0;
  while (last < kMessages) {
    const ControlTargets* const found = box.take();
    if (found == nullptr) continue;
    ++taken;
    for (const double value : found->values) ASSERT_EQ(value, found->values[0]);
    ASSERT_GT(found->values[0], last) << "in their order";
    last = found->values[0];
  }
  EXPECT_GT(taken, 1);
  EXPECT_EQ(box.take(), nullptr);
}

}  // namespace
}  // namespace splash::synth
