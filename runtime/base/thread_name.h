#pragma once
// Names of threads, as debuggers and the system's tools show them.

#include <string>

#if defined(__linux__)
#include <pthread.h>
#endif

namespace sgm {

/// Of the calling thread; cut off after 15 bytes. Where the system has no such names nothing happens.
inline void nameThread(const std::string& name) {
#if defined(__linux__)
  pthread_setname_np(pthread_self(), name.substr(0, 15).c_str());
#else
  static_cast<void>(name);
#endif
}

}  // namespace sgm
