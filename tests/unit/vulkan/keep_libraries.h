#pragma once

#include <dlfcn.h>
#include <link.h>

namespace sgm::vulkan {

/// Keeps every library that is loaded now in memory until the process ends: drivers and layers leave allocations behind
/// when they are unloaded, which a leak checker could not distinguish from ours.
inline void keepLibraries() {
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void*) {
        if (info->dlpi_name && *info->dlpi_name) dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        return 0;
      },
      nullptr);
}

}  // namespace sgm::vulkan
