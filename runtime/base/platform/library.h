#pragma once
// Loads shared libraries at run time. Each operating system has one source file that implements this header.

namespace sgm::platform {

/// Loads a shared library by file name from the system's folders. It is never unloaded, since drivers keep data for
/// threads that may run until the process ends. Returns null if the library does not exist. Thread-safe.
void* openLibrary(const char* name);

/// Returns the address of a function in the library; null if it has none with this name.
void* symbolOf(void* library, const char* name);

}  // namespace sgm::platform
