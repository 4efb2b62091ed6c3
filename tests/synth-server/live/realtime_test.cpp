// SPDX-License-Identifier: MIT
// The audio callback under guard: while it runs, every allocation, lock, wait and exception counts.
#include <gtest/gtest.h>

#include <vector>

#include "synth-server/play/player.hpp"
#include "tests/synth-server/render/forbidden_calls.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

/// All that can happen in a callback: events of every kind, late and early, floods beyond pool and
/// queue, forces, clearing, silence, xruns, odd block sizes, recording into a ring that overflows.
TEST(Realtime, TheCallbackDoesNothingForbidden) {
  const Rig rig = shipped_rig("tiles36");
  EngineSettings settings;
  settings.sound.cloud.coupling = 1.0;
  settings.sound.foot.texture = settings.sound.foot.wash = 1e-4;
  Engine engine(rig, settings);
  static CommandQueue queue;
  Recorder recorder(36, 48000, 4096, 0.1, [](const float* const*, int) {});
  Player player(engine, queue, &recorder, {48000.0, 4096, 2.0, false, {0.010, 0.050, 2.0}});

  std::vector<std::vector<float>> samples(36, std::vector<float>(8192));
  std::vector<float*> channels;
  for (auto& channel : samples) channels.push_back(channel.data());

  double time = 5000.0;
  ForbiddenCalls total;
  for (int call = 0; call < 600; ++call) {
    for (int event = 0; event < (call % 100 == 7 ? 8000 : 20); ++event) {
      Command command;
      const auto x = 0.01F * static_cast<float>(event % 180);
      const protocol::Vec3 place{x, x, 0.0F};
      command.moment = time + (event % 3 == 0 ? -0.03 : 0.02) + (event % 17 == 0 ? 100.0 : 0.0);
      command.by_arrival = time;
      if (event % 3 == 0) command.event = protocol::Impact{event, 0, 1.0F, 1.0F, place, 0.0F};
      if (event % 3 == 1) command.event = protocol::Bubble{event, 0, 0.01F, 0.1F, place, 0.0F};
      if (event % 3 == 2) command.event = protocol::Cavity{event, 0, 0.1F, 0.1F, place, 0.0F};
      (void)queue.push(command);
    }
    for (int push = 0; push < (call % 100 == 9 ? 2000 : 2); ++push) {
      Command command;
      command.kind = Command::Kind::push;
      command.moment = time + 0.02;
      command.push = {{1.0F, 1.0F, 0.0F}, push % 256, 1e4};
      (void)queue.push(command);
    }
    Command command;
    command.kind = call % 50 == 20   ? Command::Kind::clear_scheduled
                   : call % 50 == 30 ? Command::Kind::mute
                                     : Command::Kind::unmute;
    (void)queue.push(command);
    const int frames = call % 10 == 0 ? 8192 : 256;
    {
      const RealtimeScope scope;
      player.render({channels.data(), frames, time, call % 40 == 3, call % 300 == 0});
      total += RealtimeScope::calls();
    }
    time += frames / 48000.0;
  }
  EXPECT_EQ(total, ForbiddenCalls{});
  EXPECT_GT(engine.counters().started.of<protocol::Impact>(), 0U);
  EXPECT_GT(engine.counters().started.of<protocol::Bubble>(), 0U);
  EXPECT_GT(engine.counters().started.of<protocol::Cavity>(), 0U);
  EXPECT_GT(engine.counters().dropped_pool + engine.counters().stolen, 0U);
}

}  // namespace
}  // namespace splash::synth
