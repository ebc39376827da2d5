// Counts what a program takes from the heap, Eigen's own calls of malloc included. Weak, so that any file of a
// program may include it.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>

// Sanitizers bring a malloc of their own and allow no other; other C libraries have no second name for
// theirs.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FEELER_TEST_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define FEELER_TEST_COUNTS_ALLOCATIONS 0
#endif
#endif
#ifndef FEELER_TEST_COUNTS_ALLOCATIONS
#ifdef __GLIBC__
#define FEELER_TEST_COUNTS_ALLOCATIONS 1
#else
#define FEELER_TEST_COUNTS_ALLOCATIONS 0
#endif
#endif

#if FEELER_TEST_COUNTS_ALLOCATIONS
#include <malloc.h>

namespace feeler_test {
inline thread_local std::int64_t allocations = 0;
}

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
[[gnu::weak]] void* malloc(std::size_t size) {
  ++feeler_test::allocations;
  return __libc_malloc(size);
}
[[gnu::weak]] void* calloc(std::size_t count, std::size_t size) {
  ++feeler_test::allocations;
  return __libc_calloc(count, size);
}
[[gnu::weak]] void* realloc(void* memory, std::size_t size) {
  ++feeler_test::allocations;
  return __libc_realloc(memory, size);
}
[[gnu::weak]] void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++feeler_test::allocations;
  return __libc_memalign(alignment, size);
}
}

namespace feeler_test {

/// Allocations of this thread during a call.
template <class Call>
std::int64_t allocations_during(const Call& call) {
  const std::int64_t before = allocations;
  call();
  return allocations - before;
}

/// Bytes that the program has from the heap now.
inline std::int64_t kept_bytes() {
  const auto now = mallinfo2();
  return std::int64_t(now.uordblks + now.hblkhd);
}

/// Whether the count sees what `new` and what Eigen take.
inline bool count_works() {
  const auto by_new = allocations_during([] {
    int* volatile canary = new int(1);
    delete canary;
  });
  const auto by_eigen = allocations_during([] {
    const Eigen::VectorXd canary(1000);
    const volatile auto* data = canary.data();
    static_cast<void>(data);
  });
  return by_new == 1 && by_eigen >= 1;
}

}  // namespace feeler_test

#endif
