// SPDX-License-Identifier: MIT
#include "tests/synth-server/render/forbidden_calls.hpp"

#include <dlfcn.h>
#include <pthread.h>

#include <cerrno>
#include <cstddef>

namespace {

thread_local bool watching = false;
thread_local int allocation_count = 0;
thread_local int lock_count = 0;

void count_allocation() noexcept {
  allocation_count += watching ? 1 : 0;
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
int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  lock_count += watching ? 1 : 0;
  return real(mutex);
}
}

namespace splash::synth {

RealtimeScope::RealtimeScope() noexcept {
  allocation_count = 0;
  lock_count = 0;
  watching = true;
}
RealtimeScope::~RealtimeScope() {
  watching = false;
}
int RealtimeScope::allocations() noexcept {
  return allocation_count;
}
int RealtimeScope::locks() noexcept {
  return lock_count;
}

}  // namespace splash::synth
