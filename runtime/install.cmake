# sgm::sgm, the library that others use: the objects of every module in one library, shared or static as
# BUILD_SHARED_LIBS says, with the C interface as its only face; and its installation for find_package and pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(SGM_MODULES base asset grammar derive field mesh measure texture cuda backend stream store api)
if(SGM_VULKAN)
  list(APPEND SGM_MODULES vulkan)
endif()

add_library(sgm)
add_library(sgm::sgm ALIAS sgm)
set_target_properties(sgm PROPERTIES LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # the interface may change with each 0.x
target_include_directories(sgm INTERFACE
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
foreach(module IN LISTS SGM_MODULES)
  target_sources(sgm PRIVATE $<TARGET_OBJECTS:sgm_${module}>)
  get_target_property(libraries sgm_${module} LINK_LIBRARIES)
  list(FILTER libraries EXCLUDE REGEX "^(sgm_.*|libraries-NOTFOUND)$")
  target_link_libraries(sgm PRIVATE ${libraries})
endforeach()
if(SGM_SANITIZE)
  target_link_options(sgm PUBLIC -fsanitize=${SGM_SANITIZE})
endif()
get_target_property(SGM_LIBRARY_TYPE sgm TYPE)
if(SGM_LIBRARY_TYPE STREQUAL "STATIC_LIBRARY")
  target_compile_definitions(sgm INTERFACE SGM_STATIC)
else()
  # Hidden visibility leaves template instances of the standard library in the open; the map leaves the interface alone.
  target_link_options(sgm PRIVATE LINKER:--version-script=${CMAKE_CURRENT_SOURCE_DIR}/exports.map)
  set_property(TARGET sgm APPEND PROPERTY LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/exports.map)
endif()

if(NOT SGM_INSTALL)
  return()
endif()
install(TARGETS sgm EXPORT sgmTargets COMPONENT library)
set(headers include/sgm/sgm.h include/sgm/sgm_cuda.h)
if(SGM_VULKAN)
  list(APPEND headers include/sgm/sgm_vulkan.h)
endif()
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sgm COMPONENT library)
install(EXPORT sgmTargets NAMESPACE sgm:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sgm COMPONENT library)

# Whoever links the shared library needs nothing else; a static one takes our dependencies along.
if(NOT SGM_LIBRARY_TYPE STREQUAL "STATIC_LIBRARY")
  unset(SGM_CONFIG_DEPENDENCIES)
  unset(SGM_SERVICE_CONFIG_DEPENDENCIES)
  unset(SGM_PC_REQUIRES)
else()
  set(SGM_SERVICE_CONFIG_DEPENDENCIES "find_dependency(prometheus-cpp CONFIG)")
  string(APPEND SGM_CONFIG_AFTER "# A project in C alone does not link what the library needs of C++.\n"
    "get_property(_sgm_languages GLOBAL PROPERTY ENABLED_LANGUAGES)\n"
    "if(NOT \"CXX\" IN_LIST _sgm_languages)\n"
    "  set_property(TARGET sgm::sgm APPEND PROPERTY INTERFACE_LINK_LIBRARIES stdc++ m)\nendif()")
  set(SGM_PC_CFLAGS "-DSGM_STATIC")
  set(SGM_PC_LIBS "-lstdc++ -lm -ldl -pthread")
endif()
configure_package_config_file(sgmConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/sgmConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sgm NO_SET_AND_CHECK_MACRO)
# SameMinorVersion: while the major version is 0, each minor one may change the interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/sgmConfigVersion.cmake COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH SGM_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(sgm.pc.in ${CMAKE_CURRENT_BINARY_DIR}/sgm.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sgmConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/sgmConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sgm COMPONENT library)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sgm.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
