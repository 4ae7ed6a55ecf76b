# Finds the library's dependencies, once for all folders. The error for a missing package names its Debian package.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
set(SGM_CONFIG_DEPENDENCIES "find_dependency(Threads)")

if(NOT SGM_SCALAR)
  find_package(hwy CONFIG QUIET)
  if(NOT TARGET hwy::hwy)
    message(FATAL_ERROR "Highway is missing: install the package libhwy-dev, or set SGM_SCALAR=ON to do without")
  endif()
  string(APPEND SGM_CONFIG_DEPENDENCIES "\nfind_dependency(hwy CONFIG)")
  set(SGM_PC_REQUIRES libhwy)
endif()

# xxHash is used as a header-only library, so there is nothing to link.
find_path(SGM_XXHASH_INCLUDE xxhash.h)
if(NOT SGM_XXHASH_INCLUDE)
  message(FATAL_ERROR "xxhash.h is missing: install the package libxxhash-dev")
endif()

# Only the Vulkan headers are needed: the Vulkan loader is opened at run time. The command also draws pictures with
# Vulkan.
if(SGM_VULKAN OR NOT SGM_TOOLS STREQUAL "off")
  find_path(SGM_VULKAN_INCLUDE vulkan/vulkan.h)
  if(NOT SGM_VULKAN_INCLUDE)
    message(FATAL_ERROR "vulkan/vulkan.h is missing: install the package libvulkan-dev, or set SGM_VULKAN=OFF and SGM_TOOLS=off to do without")
  endif()
endif()

# Only the headers are needed: libcurl is opened at run time, when a store on a server is first read.
if(SGM_HTTP_STORES)
  find_path(SGM_CURL_INCLUDE curl/curl.h)
  if(NOT SGM_CURL_INCLUDE)
    message(FATAL_ERROR "curl/curl.h is missing: install the package libcurl4-openssl-dev, or set SGM_HTTP_STORES=OFF to do without stores on servers")
  endif()
endif()

if(SGM_DISK_CACHE)
  find_package(zstd CONFIG QUIET)
  if(NOT TARGET zstd::libzstd_shared)
    message(FATAL_ERROR "zstd is missing: install the package libzstd-dev, or set SGM_DISK_CACHE=OFF to do without the cache")
  endif()
  string(APPEND SGM_CONFIG_DEPENDENCIES "\nfind_dependency(zstd CONFIG)")
  list(APPEND SGM_PC_REQUIRES libzstd)
endif()
list(JOIN SGM_PC_REQUIRES ", " SGM_PC_REQUIRES)
