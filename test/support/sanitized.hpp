// How much of a long test runs where a sanitizer makes it slow.
#pragma once

namespace feeler::test {

#if defined(__SANITIZE_ADDRESS__)
#define FEELER_TEST_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FEELER_TEST_SANITIZED 1
#endif
#endif
#ifndef FEELER_TEST_SANITIZED
#define FEELER_TEST_SANITIZED 0
#endif

/// Ticks to run: all of them, or a part where a sanitizer makes each of them slow.
constexpr int ticks_to_run(int count, int part = 10) { return FEELER_TEST_SANITIZED != 0 ? count / part : count; }

/// The same of random trials, and of what they must meet at least.
constexpr int trials_to_run(int count) { return ticks_to_run(count, 4); }

}  // namespace feeler::test
