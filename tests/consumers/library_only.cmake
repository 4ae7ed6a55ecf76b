# Configures the library alone, with no other packages available than those it needs: cmake -DSOURCE=... -DBINARY=...
# "-DOPTIONS=..." -P library_only.cmake
#
# Hides the packages that the rest of the tree needs from find_package; checks afterwards that none was found by
# find_path.
file(REMOVE_RECURSE ${BINARY})
set(hidden)
foreach(package Boost CGAL CLI11 Catch2 PkgConfig SQLite3 Vulkan fmt glm meshoptimizer nlohmann_json prometheus-cpp)
  list(APPEND hidden -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} --preset library -B ${BINARY} ${hidden} ${OPTIONS} WORKING_DIRECTORY ${SOURCE}
  COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${BINARY}/CMakeCache.txt found REGEX "^SGM_[A-Z_]*(INCLUDE|GLM|STB|VOLK)[A-Z_]*:PATH=")
foreach(entry IN LISTS found)
  if(NOT entry MATCHES "^SGM_(XXHASH|VULKAN|CURL)_INCLUDE:")
    message(FATAL_ERROR "the library alone looks for ${entry}")
  endif()
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY} --target help OUTPUT_VARIABLE targets COMMAND_ERROR_IS_FATAL ANY)
if(NOT targets MATCHES "\nsgm: " OR targets MATCHES "\n(sgm_cli|sgm_render|sgm_service[a-z_]*|sgm_classify|minimal_c|test_[a-z]+): ")
  message(FATAL_ERROR "the library alone is not what is built:\n${targets}")
endif()
