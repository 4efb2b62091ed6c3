// SPDX-License-Identifier: MIT
// The audio callback under guard: while it runs, every allocation, release and lock is counted.
// glibc's functions are replaced in this program only.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <vector>

#include "synth-server/output/rig_reader.hpp"
#include "synth-server/player.hpp"

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* pointer, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* pointer);
}

namespace {

thread_local bool guarded = false;
thread_local int offences = 0;

void note() noexcept {
  if (guarded) ++offences;
}

}  // namespace

extern "C" {
void* malloc(std::size_t size) {
  note();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  note();
  return __libc_calloc(count, size);
}
void* realloc(void* pointer, std::size_t size) {
  note();
  return __libc_realloc(pointer, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  note();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** pointer, std::size_t alignment, std::size_t size) {
  note();
  *pointer = __libc_memalign(alignment, size);
  return *pointer == nullptr ? ENOMEM : 0;
}
void free(void* pointer) {
  note();
  __libc_free(pointer);
}
int pthread_mutex_lock(pthread_mutex_t* mutex) {
  note();
  using Lock = int (*)(pthread_mutex_t*);
  static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  return real(mutex);
}
}

namespace splash::synth {
namespace {

/// What `action` does that a real-time thread must not.
template <class Action>
int offences_of(Action action) {
  offences = 0;
  guarded = true;
  action();
  guarded = false;
  return offences;
}

TEST(Realtime, TheGuardSeesWhatItIsFor) {
  std::vector<int> numbers;
  EXPECT_GE(offences_of([&] { numbers.push_back(1); }), 1);
  EXPECT_GE(offences_of([&] { std::vector<int>().swap(numbers); }), 1);
  std::mutex mutex;
  EXPECT_GE(offences_of([&] { const std::lock_guard lock(mutex); }), 1);
  EXPECT_EQ(offences_of([&] { numbers.clear(); }), 0);
}

/// All that can happen in a callback: events of every kind, late and early, floods beyond pool and
/// queue, clearing, silence, xruns, odd block sizes, recording into a ring that overflows.
TEST(Realtime, TheCallbackNeverAllocatesNorLocks) {
  const Rig rig = read_rig(std::string(SPLASH_SOURCE_DIR) + "/configs/rigs/tiles36.yaml");
  Engine engine(rig, {});
  static CommandQueue queue;
  Recorder recorder(36, 48000, 4096, 0.1, [](const float* const*, int) {});
  Player player(engine, queue, &recorder, 48000.0, 4096, {0.010, 0.050, 2.0});

  std::vector<std::vector<float>> samples(36, std::vector<float>(8192));
  std::vector<float*> channels;
  for (auto& channel : samples) channels.push_back(channel.data());

  double time = 5000.0;
  int total = 0;
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
    Command command;
    command.kind = call % 50 == 20   ? Command::Kind::clear_scheduled
                   : call % 50 == 30 ? Command::Kind::silence
                                     : Command::Kind::resume;
    (void)queue.push(command);
    const int frames = call % 10 == 0 ? 8192 : 256;
    total += offences_of([&] {
      player.render({channels.data(), frames, time, call % 40 == 3, call % 300 == 0});
    });
    time += frames / 48000.0;
  }
  EXPECT_EQ(total, 0);
  EXPECT_GT(engine.counters().impacts, 0U);
  EXPECT_GT(engine.counters().bubbles, 0U);
  EXPECT_GT(engine.counters().cavities, 0U);
  EXPECT_GT(engine.counters().dropped_pool + engine.counters().stolen, 0U);
}

}  // namespace
}  // namespace splash::synth
