// SPDX-License-Identifier: MIT
#include "tests/synth-server/render/forbidden_calls.hpp"

#include <dlfcn.h>
#include <poll.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/select.h>
#include <ucontext.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <ctime>
#include <ostream>
#include <typeinfo>

#if defined(__x86_64__) && defined(PR_SET_SYSCALL_USER_DISPATCH)
#define SPLASH_CATCHES_SYSTEM_CALLS
#endif

namespace {

thread_local bool watching = false;
thread_local splash::synth::ForbiddenCalls seen;

void count_allocation() noexcept {
  seen.allocations += watching ? 1 : 0;
}
void count_wait() noexcept {
  seen.waits += watching ? 1 : 0;
}

/// The function that stands behind ours.
template <class Function>
Function* next(const char* name) noexcept {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  count_allocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  count_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  count_allocation();
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_allocation();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  count_allocation();
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
void free(void* block) {
  count_allocation();
  __libc_free(block);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  static const auto real = next<int(pthread_mutex_t*)>("pthread_mutex_lock");
  seen.locks += watching ? 1 : 0;
  return real(mutex);
}
int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
  static const auto real = next<int(pthread_mutex_t*)>("pthread_mutex_trylock");
  seen.locks += watching ? 1 : 0;
  return real(mutex);
}

int nanosleep(const timespec* time, timespec* left) {
  static const auto real = next<int(const timespec*, timespec*)>("nanosleep");
  count_wait();
  return real(time, left);
}
int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  static const auto real = next<int(clockid_t, int, const timespec*, timespec*)>("clock_nanosleep");
  count_wait();
  return real(clock, flags, time, left);
}
int poll(pollfd* files, nfds_t count, int timeout) {
  static const auto real = next<int(pollfd*, nfds_t, int)>("poll");
  count_wait();
  return real(files, count, timeout);
}
int select(int count, fd_set* in, fd_set* out, fd_set* other, timeval* timeout) {
  static const auto real = next<int(int, fd_set*, fd_set*, fd_set*, timeval*)>("select");
  count_wait();
  return real(count, in, out, other, timeout);
}
ssize_t read(int file, void* data, std::size_t size) {
  static const auto real = next<ssize_t(int, void*, std::size_t)>("read");
  count_wait();
  return real(file, data, size);
}
ssize_t write(int file, const void* data, std::size_t size) {
  static const auto real = next<ssize_t(int, const void*, std::size_t)>("write");
  count_wait();
  return real(file, data, size);
}

[[noreturn]] void __cxa_throw(void* thrown, std::type_info* type, void (*destroy)(void*)) {
  static const auto real = next<void(void*, std::type_info*, void (*)(void*))>("__cxa_throw");
  seen.exceptions += watching ? 1 : 0;
  real(thrown, type, destroy);
  __builtin_unreachable();
}
}

namespace splash::synth {
namespace {

thread_local volatile char dispatch = 0;  // SYSCALL_DISPATCH_FILTER_ALLOW; 1: BLOCK
thread_local volatile bool called = false;

#ifdef SPLASH_CATCHES_SYSTEM_CALLS

/// Notes the call, lets all further ones pass, and makes this one in the thread's name.
void on_system_call(int /*signal*/, siginfo_t* info, void* context) {
  dispatch = 0;
  called = true;
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
  called = false;
  if (!works() || !watch(true)) return;
  dispatch = 1;  // from here on
}

SystemCallScope::~SystemCallScope() {
  dispatch = 0;
  if (works()) watch(false);
}

bool SystemCallScope::any() noexcept {
  return called;
}

ForbiddenCalls& ForbiddenCalls::operator+=(const ForbiddenCalls& other) noexcept {
  allocations += other.allocations;
  locks += other.locks;
  waits += other.waits;
  exceptions += other.exceptions;
  system_calls += other.system_calls;
  return *this;
}

std::ostream& operator<<(std::ostream& out, const ForbiddenCalls& calls) {
  return out << calls.allocations << " allocations, " << calls.locks << " locks, " << calls.waits
             << " waits, " << calls.exceptions << " exceptions, " << calls.system_calls
             << " sections with system calls";
}

RealtimeScope::RealtimeScope() noexcept {
  seen = {};
  watching = true;
}
RealtimeScope::~RealtimeScope() {
  watching = false;
}
ForbiddenCalls RealtimeScope::calls() noexcept {
  ForbiddenCalls calls = seen;
  calls.system_calls = SystemCallScope::any() ? 1 : 0;
  return calls;
}

}  // namespace splash::synth
