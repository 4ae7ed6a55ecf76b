# The library sgm::service, for find_package(sgm COMPONENTS service). It is separate from sgm::sgm, so that a game can
# ship without it.
find_package(prometheus-cpp CONFIG REQUIRED)
add_library(sgm_service_library)
add_library(sgm::service ALIAS sgm_service_library)
set_target_properties(sgm_service_library PROPERTIES OUTPUT_NAME sgm_service EXPORT_NAME service LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
foreach(module http service_judge service_watch service_ports service)
  target_sources(sgm_service_library PRIVATE $<TARGET_OBJECTS:sgm_${module}>)
endforeach()
target_link_libraries(sgm_service_library PUBLIC sgm PRIVATE prometheus-cpp::core Threads::Threads)
if(NOT SGM_LIBRARY_TYPE STREQUAL "STATIC_LIBRARY")
  # The shared library libsgm does not export the symbols of the module base, so this library links its own copy of the
  # objects that it needs from there.
  target_link_libraries(sgm_service_library PRIVATE sgm_base)
  target_link_options(sgm_service_library PRIVATE LINKER:--version-script=${CMAKE_CURRENT_SOURCE_DIR}/exports.map
    ${SGM_NO_UNDEFINED})
  set_property(TARGET sgm_service_library APPEND PROPERTY LINK_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/exports.map)
endif()
