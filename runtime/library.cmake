# sgm::sgm, the public library: contains the objects of all modules, is shared or static as BUILD_SHARED_LIBS says, and
# exports only the C interface.
include(GNUInstallDirs)

set(SGM_MODULES base asset asset_read grammar_text grammar_std grammar_syntax grammar_range grammar_parse grammar_print
  grammar_identity grammar_check grammar_reach grammar derive derive_layout derive_interpret field mesh measure texture
  backend backend_cpu cuda cuda_backend backend_open world chunk query region store_cache stream_edits stream_plan
  stream_make stream store api)
if(SGM_VULKAN)
  list(APPEND SGM_MODULES vulkan backend_vulkan)
endif()

add_library(sgm)
add_library(sgm::sgm ALIAS sgm)
set_target_properties(sgm PROPERTIES LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # the C interface may change with each minor version 0.x
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
  # Hidden visibility does not hide template instances of the standard library; the linker's version script hides them.
  # --no-undefined makes a missing module an error here, not only in a user's link. It is not used with sanitizers,
  # whose functions are undefined in a library.
  if(NOT SGM_SANITIZE)
    set(SGM_NO_UNDEFINED LINKER:--no-undefined)
  endif()
  target_link_options(sgm PRIVATE LINKER:--version-script=${CMAKE_CURRENT_SOURCE_DIR}/exports.map ${SGM_NO_UNDEFINED})
  set_property(TARGET sgm APPEND PROPERTY LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/exports.map)
endif()
