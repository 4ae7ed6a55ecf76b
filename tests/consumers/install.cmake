# Installs the library, and the metrics service on request, into an empty prefix:
# cmake -DBUILD=... -DPREFIX=... -DSERVICE=... -P install.cmake
file(REMOVE_RECURSE ${PREFIX})
set(components library)
if(SERVICE)
  list(APPEND components service)
endif()
foreach(component IN LISTS components)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} --component ${component}
    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
