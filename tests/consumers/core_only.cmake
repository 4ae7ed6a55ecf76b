# Configures the core commands as samples/demo.sh does, but hides all packages that these commands do not need:
# cmake -DSOURCE=... -DBINARY=... "-DOPTIONS=..." -P core_only.cmake
file(REMOVE_RECURSE ${BINARY})
set(hidden)
foreach(package Boost CGAL Catch2 PkgConfig SQLite3 Vulkan glfw3 prometheus-cpp)
  list(APPEND hidden -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} --preset release -B ${BINARY} -D SGM_TOOLS=core -D SGM_CUDA=OFF -D SGM_SERVICE=OFF
    -D SGM_BUILD_TESTS=OFF -D SGM_BUILD_BENCH=OFF -D SGM_BUILD_SAMPLES=OFF ${hidden} ${OPTIONS}
  WORKING_DIRECTORY ${SOURCE} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY} --target help OUTPUT_VARIABLE targets COMMAND_ERROR_IS_FATAL ANY)
if(NOT targets MATCHES "\nsgm_cli: " OR NOT targets MATCHES "\nsgm: "
    OR targets MATCHES "\n(sgm_service[a-z_]*|sgm_http|sgm_classify|sgm_paper|sgm_preview|sgm_language|minimal_c|test_[a-z]+): ")
  message(FATAL_ERROR "the core commands and the library alone are not what is built:\n${targets}")
endif()
