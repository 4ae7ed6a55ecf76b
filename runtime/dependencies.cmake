# What the library needs from outside, found once for every folder. A missing package is named as Debian calls it.
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
