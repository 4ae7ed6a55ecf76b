#include <dlfcn.h>

#include "base/platform/library.h"

namespace sgm::platform {

void* openLibrary(const char* name) { return dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE); }

void* symbolOf(void* library, const char* name) { return dlsym(library, name); }

}  // namespace sgm::platform
