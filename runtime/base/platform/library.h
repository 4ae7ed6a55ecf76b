#pragma once
// Loads shared libraries (dlopen) at run time. Each operating system has one source file that implements this header.

namespace sgm::platform {

/// Loads a shared library by file name from the system's search path. It is never unloaded, since graphics drivers keep
/// per-thread data until the process ends. Returns null if the library does not exist. Thread-safe.
void* openLibrary(const char* name);

/// Returns the address of the library's function with this name; null if there is none.
void* symbolOf(void* library, const char* name);

}  // namespace sgm::platform
