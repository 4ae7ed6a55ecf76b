#pragma once
// Names threads for debuggers and the system's tools.

#include <string>

#if defined(__linux__)
#include <pthread.h>
#endif

namespace sgm {

/// Names the calling thread; the name is truncated to 15 bytes. Has no effect on systems other than Linux.
inline void nameThread(const std::string& name) {
#if defined(__linux__)
  pthread_setname_np(pthread_self(), name.substr(0, 15).c_str());
#else
  static_cast<void>(name);
#endif
}

}  // namespace sgm
