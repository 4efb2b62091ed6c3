// SPDX-License-Identifier: MIT
// When its server dies, libjack cancels the thread that asks for blocks, at any instruction. This
// does so at each one of our callback in turn, by single steps: the program must go on, and a block
// that was begun must be finished. C++ ends the program where a function with something to clean up
// is left between two calls; ThreadSanitizer adds such things, so this is built with it.
#include <gtest/gtest.h>
#include <pthread.h>
#include <ucontext.h>
#include <unwind.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>

#include "synth-server/audio/rtaudio_output.hpp"
#include "synth-server/audio/rtaudio_port.hpp"

namespace splash::synth {
namespace {

constexpr int kTrapFlag = 0x100;        ///< of the processor's flags: stop after each instruction
constexpr std::uintptr_t kNear = 4096;  ///< no function of ours is longer [bytes]

/// Counts blocks.
struct Counting final : BlockSource {
  void render(const AudioBlock& /*block*/) noexcept override {
    ++begun;
    pthread_testcancel();
    ++finished;
  }
  std::atomic<int> begun{0};
  std::atomic<int> finished{0};
};

std::atomic<int> instructions_left{0};  ///< of the callback, before it is cancelled

/// Whether the instruction is the callback's own, not one of what it calls.
bool in_callback(std::uintptr_t instruction) {
  const auto callback = reinterpret_cast<std::uintptr_t>(RtAudio::stage().callback);
  if (instruction < callback || instruction > callback + kNear) return false;
  void* const where = reinterpret_cast<void*>(instruction);
  return reinterpret_cast<std::uintptr_t>(_Unwind_FindEnclosingFunction(where)) == callback;
}

void on_step(int /*signal*/, siginfo_t* /*info*/, void* context) {
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  if (!in_callback(static_cast<std::uintptr_t>(registers[REG_RIP]))) return;
  if (instructions_left.fetch_sub(1) > 0) return;
  registers[REG_EFL] &= ~kTrapFlag;
  pthread_cancel(pthread_self());
}

/// As libjack's thread: may be cancelled anywhere, and asks for one block.
void* ask_for_a_block(void* /*nothing*/) {
  std::array<float, 8> block{};
  pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, nullptr);
  const auto& stage = RtAudio::stage();
  asm volatile("pushfq\n orq %0, (%%rsp)\n popfq" ::"i"(kTrapFlag) : "memory", "cc");
  stage.callback(block.data(), nullptr, 4, 0.0, 0, stage.context);
  asm volatile("pushfq\n andq %0, (%%rsp)\n popfq" ::"i"(~kTrapFlag) : "memory", "cc");
  pthread_setcanceltype(PTHREAD_CANCEL_DEFERRED, nullptr);
  return nullptr;
}

void* cancel_myself(void* /*nothing*/) {
  pthread_cancel(pthread_self());
  pthread_testcancel();
  return nullptr;
}

/// Whether the thread was cancelled.
bool run(void* (*thread)(void*)) {
  pthread_t id{};
  void* result = nullptr;
  EXPECT_EQ(pthread_create(&id, nullptr, thread, nullptr), 0);
  EXPECT_EQ(pthread_join(id, &result), 0);
  return result == PTHREAD_CANCELED;
}

void listen_to_steps() {
  struct sigaction stepping {};
  stepping.sa_sigaction = on_step;
  stepping.sa_flags = SA_SIGINFO;
  ASSERT_EQ(sigaction(SIGTRAP, &stepping, nullptr), 0);
}

TEST(CancelledBlock, LeavesTheProgramAndTheBlockWholeAtEachInstruction) {
  RtAudio::stage() = {};
  RtAudio::stage().devices = {{1, "floor", 2, true, 48000}};
  Counting source;
  RtAudioOutput output({"alsa", "", 2, 0, 4});
  output.start(source);
  listen_to_steps();
  ASSERT_TRUE(run(cancel_myself)) << "loads what unwinds, which allocates";
  int instructions = 0;
  for (bool cancelled = true; cancelled; ++instructions) {
    instructions_left = instructions;
    cancelled = run(ask_for_a_block);
    EXPECT_EQ(source.begun, source.finished) << "cancelled at instruction " << instructions;
  }
  EXPECT_GT(instructions, 10);
  EXPECT_GT(source.finished, 1);
  EXPECT_LT(source.finished, instructions) << "some of them lie before the block";
}

}  // namespace
}  // namespace splash::synth
