#pragma once
// Shared libraries that the process loads while it runs. Each system has one source file that implements this header.

namespace sgm::platform {

/// Loads a shared library by its file name, from the system's folders, and keeps it until the process ends: drivers
/// keep data for threads that outlive any owner here. Null if there is none of that name. Thread-safe.
void* openLibrary(const char* name);

/// The address of a function of the library, or null.
void* symbolOf(void* library, const char* name);

}  // namespace sgm::platform
