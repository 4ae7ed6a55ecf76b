# Builds the library static and without vector units (to be quick) and installs it into an empty prefix:
# cmake -DSOURCE=... -DBINARY=... -DPREFIX=... -DOPTIONS=... -P static_install.cmake
file(REMOVE ${BINARY}/CMakeCache.txt)
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G Ninja ${OPTIONS} -DCMAKE_BUILD_TYPE=Debug
  -DBUILD_SHARED_LIBS=OFF -DSGM_SCALAR=ON -DSGM_BUILD_CLI=OFF -DSGM_BUILD_TESTS=OFF -DSGM_BUILD_SAMPLES=OFF
  -DSGM_BUILD_BENCH=OFF COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BINARY} --prefix ${PREFIX} COMMAND_ERROR_IS_FATAL ANY)
