// SPDX-License-Identifier: MIT
#include "tests/synth-server/render/system_calls.hpp"

#include <sys/prctl.h>
#include <ucontext.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#if defined(__x86_64__) && defined(PR_SET_SYSCALL_USER_DISPATCH)
#define SPLASH_CATCHES_SYSTEM_CALLS
#endif

namespace splash::synth {
namespace {

thread_local volatile char dispatch = 0;  // SYSCALL_DISPATCH_FILTER_ALLOW; 1: BLOCK
thread_local volatile int first_call = -1;

#ifdef SPLASH_CATCHES_SYSTEM_CALLS

/// Notes the call, lets all further ones pass, and makes this one in the thread's name.
void on_system_call(int /*signal*/, siginfo_t* info, void* context) {
  dispatch = 0;
  first_call = info->si_syscall;
  const int error = errno;
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const long result =
      syscall(info->si_syscall, registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
              registers[REG_R10], registers[REG_R8], registers[REG_R9]);
  registers[REG_RAX] = result == -1 ? -errno : result;
  errno = error;
}

bool watch(bool on) noexcept {
  return prctl(PR_SET_SYSCALL_USER_DISPATCH, on ? PR_SYS_DISPATCH_ON : PR_SYS_DISPATCH_OFF, 0UL,
               0UL, on ? &dispatch : nullptr) == 0;
}

bool install() noexcept {
  struct sigaction action {};
  action.sa_sigaction = on_system_call;
  action.sa_flags = SA_SIGINFO;
  return sigaction(SIGSYS, &action, nullptr) == 0 && watch(true) && watch(false);
}

#else

bool watch(bool /*on*/) noexcept {
  return false;
}
bool install() noexcept {
  return false;
}

#endif

}  // namespace

bool SystemCallScope::works() noexcept {
  static const bool kInstalled = install();
  return kInstalled;
}

SystemCallScope::SystemCallScope() noexcept {
  first_call = -1;
  if (!works() || !watch(true)) return;
  dispatch = 1;  // from here on
}

SystemCallScope::~SystemCallScope() {
  dispatch = 0;
  if (works()) watch(false);
}

bool SystemCallScope::any() noexcept {
  return first_call >= 0;
}
int SystemCallScope::first() noexcept {
  return first_call;
}

}  // namespace splash::synth
