// SPDX-License-Identifier: MIT
// Scheduling and rendering neither allocate, lock, wait nor throw, under all the load they may
// meet.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>

#include "synth-server/render/live_controls.hpp"
#include "tests/synth-server/render/forbidden_calls.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

ForbiddenCalls count(const std::function<void()>& work) {
  const RealtimeScope scope;
  work();
  return RealtimeScope::calls();
}

TEST(ForbiddenCalls, AreSeen) {
  std::vector<int> list;
  std::mutex mutex;
  EXPECT_GT(count([&] { list.resize(1000); }).allocations, 0);
  EXPECT_GT(count([&] { const std::lock_guard lock(mutex); }).locks, 0);
  EXPECT_GT(count([&] { mutex.try_lock(); }).locks, 0);
  mutex.unlock();
  const auto throw_within_the_library = [] {
    try {
      (void)std::string().at(1);
    } catch (const std::out_of_range&) {
    }
  };
  EXPECT_EQ(count(throw_within_the_library).exceptions, 1);
  double sum = 0.0;
  EXPECT_EQ(count([&] { sum += 1.0; }), ForbiddenCalls{});
}

TEST(ForbiddenCalls, AreSeenWhereTheyWaitAndInTheKernel) {
  const timespec moment{0, 1000};
  timeval time{0, 1};
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  char letter = 'x';
  EXPECT_EQ(count([&] { nanosleep(&moment, nullptr); }).waits, 1);
  EXPECT_EQ(count([&] { clock_nanosleep(CLOCK_MONOTONIC, 0, &moment, nullptr); }).waits, 1);
  EXPECT_EQ(count([&] { poll(nullptr, 0, 1); }).waits, 1);
  EXPECT_EQ(count([&] { select(0, nullptr, nullptr, nullptr, &time); }).waits, 1);
  EXPECT_EQ(count([&] { (void)!write(ends[1], &letter, 1); }).waits, 1);
  EXPECT_EQ(count([&] { (void)!read(ends[0], &letter, 1); }).waits, 1);
  close(ends[0]);
  close(ends[1]);
  if (!SystemCallScope::works()) GTEST_SKIP() << "this kernel does not tell of system calls";
  pid_t mine = 0;
  EXPECT_EQ(count([&] { mine = static_cast<pid_t>(syscall(SYS_getpid)); }).system_calls, 1);
  EXPECT_EQ(mine, getpid()) << "it is made all the same";
}

TEST(Realtime, ScheduleAndRenderDoNothingForbidden) {
  auto settings = file_settings();
  settings.max_voices = 100;
  settings.max_scheduled = 500;
  settings.max_block = 256;
  settings.sound.cloud.singles = 500.0;
  Rig rig = floor_rig();
  rig.outputs.push_back(open_rig().outputs.front());
  ControlTargets targets{control_values(rig, settings.sound), {}};
  targets.seconds.assign(targets.values.size(), 0.02F);
  ControlBox box(targets, std::vector<char>(targets.values.size(), 0));
  settings.controls = &box;
  Engine engine(rig, settings);
  const auto events = splashes(4000, 48000);
  Channels out(37, std::vector<float>(256));
  std::vector<float*> pointers;
  for (auto& channel : out) pointers.push_back(channel.data());
  std::size_t next = 0;
  const ForbiddenCalls calls = count([&] {
    for (int block = 0; block < 400; ++block) {
      for (int i = 0; i < 10; ++i) engine.schedule(events[next++ % events.size()]);
      if (block == 200) engine.clear();
      // Every number moves a little, and back. The copy is the sender's; nothing of it grows.
      for (double& value : targets.values) value *= block % 2 == 0 ? 0.99 : 1.0 / 0.99;
      box.send(targets);
      engine.silence(block % 50 == 49);
      engine.render(pointers.data(), block % 3 == 0 ? 256 : 100);
    }
  });
  EXPECT_EQ(calls, ForbiddenCalls{});
  const auto counters = engine.counters();
  EXPECT_GT(counters.stolen, 0U) << "the load was too light to prove anything";
  EXPECT_GT(counters.started.of<protocol::Impact>(), 0U);
  EXPECT_GT(counters.started.of<protocol::Cavity>(), 0U);
  EXPECT_GT(counters.late, 0U);
  EXPECT_GT(counters.crowded, 0U);
}

/// How long a full pool is rendered: a second, or as SPLASH_REALTIME_SECONDS says [s].
int seconds_of_flood() {
  const char* asked = std::getenv("SPLASH_REALTIME_SECONDS");
  return asked == nullptr ? 1 : std::max(std::atoi(asked), 1);
}

/// A full pool on 36 channels, with a flood on top: 300 events in every cell.
void flood_full_pool(double physical) {
  auto settings = file_settings();
  settings.sound.bubble.physical = settings.sound.cavity.physical = physical;
  settings.max_voices = 2000;
  Rig rig = floor_rig();
  rig.outputs[0].threshold = {Sense::touch, -70.0};
  Engine engine(rig, settings);
  const auto events = splashes(4000, 1);
  Channels out(36, std::vector<float>(kCell));
  std::vector<float*> pointers;
  for (auto& channel : out) pointers.push_back(channel.data());
  std::size_t next = 0;
  const int cells = 750 * seconds_of_flood();
  std::uint64_t least = 1U << 20U;
  const ForbiddenCalls calls = count([&] {
    for (int cell = 0; cell < cells; ++cell) {
      for (int i = 0; i < 300; ++i) {
        TimedEvent event = events[next++ % events.size()];
        event.sample = engine.clock() + i % kCell;
        engine.schedule(event);
      }
      // Whole cells and cut ones.
      engine.render(pointers.data(), cell % 3 == 0 ? 40 : kCell);
      if (cell % 3 == 0) engine.render(pointers.data(), kCell - 40);
      if (cell > 100) least = std::min(least, engine.counters().voices);
    }
  });
  EXPECT_EQ(calls, ForbiddenCalls{});
  EXPECT_GE(least, 2000U) << "the pool was not full";
  EXPECT_GT(engine.counters().stolen, 10000U);
}

TEST(Realtime, AFullPoolOn36ChannelsDoesNothingForbidden) {
  flood_full_pool(0.0);
  flood_full_pool(1.0);
}

}  // namespace
}  // namespace splash::synth
