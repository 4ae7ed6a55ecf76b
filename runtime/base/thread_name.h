#pragma once
// Names of threads, as debuggers and the system's tools show them.

#include <string>

#if defined(__linux__)
#include <pthread.h>
#endif

namespace sgm {

/// Names the calling thread; the name is cut after 15 bytes. Has no effect on systems other than Linux.
inline void nameThread(const std::string& name) {
#if defined(__linux__)
  pthread_setname_np(pthread_self(), name.substr(0, 15).c_str());
#else
  static_cast<void>(name);
#endif
}

}  // namespace sgm
