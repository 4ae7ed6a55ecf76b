#pragma once
// Simulates a machine on which threads cannot be started. Not available with sanitizers, which reserve memory of their
// own for every thread.

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SGM_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SGM_SANITIZED
#endif

#if defined(__GLIBC__) && !defined(SGM_SANITIZED)
#define SGM_SCARCE_THREADS

#include <pthread.h>
#include <sys/resource.h>

#include <cstdio>

#include "catch.h"

/// During this object's lifetime, the address space has room for the stacks of about `threads` more threads, so that
/// starting further threads fails.
class FailingThreads {
 public:
  explicit FailingThreads(unsigned threads) {
    // The stacks are so large that glibc does not reuse a cached stack of an earlier thread.
    constexpr size_t kStack = size_t{256} << 20;
    pthread_attr_t large;
    REQUIRE(pthread_getattr_default_np(&usual_) == 0);
    REQUIRE(pthread_getattr_default_np(&large) == 0);
    REQUIRE(pthread_attr_setstacksize(&large, kStack) == 0);
    REQUIRE(pthread_setattr_default_np(&large) == 0);
    pthread_attr_destroy(&large);
    REQUIRE(getrlimit(RLIMIT_AS, &before_) == 0);
    rlimit scarce = before_;
    scarce.rlim_cur = pages() * 4096 + (threads * kStack + kStack / 2);
    REQUIRE(setrlimit(RLIMIT_AS, &scarce) == 0);
  }
  FailingThreads(const FailingThreads&) = delete;
  FailingThreads& operator=(const FailingThreads&) = delete;
  ~FailingThreads() {
    setrlimit(RLIMIT_AS, &before_);
    pthread_setattr_default_np(&usual_);
    pthread_attr_destroy(&usual_);
  }

 private:
  static size_t pages() {
    size_t count = 0;
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    REQUIRE(file != nullptr);
    const int read = std::fscanf(file, "%zu", &count);
    std::fclose(file);
    REQUIRE(read == 1);
    return count;
  }

  pthread_attr_t usual_{};
  rlimit before_{};
};
#endif
