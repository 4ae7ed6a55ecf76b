# sgm_install_part(COMPONENT TARGET): the first of a folder's install rules, which all are COMPONENT's. Where TARGET is
# not built the folder's other rules are passed over, and that is said; a component that is asked for by name must be
# built. So a tree in which some targets were built installs these, and nothing that refers to what is not there.
function(sgm_install_part component target)
  set_property(GLOBAL APPEND PROPERTY SGM_COMPONENTS ${component})
  # A rule's code stands as it is in the folder's install script, which return() leaves.
  install(CODE "
if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
  set(sgm_lack \"sgm: the ${component} is not built (cmake --build '${PROJECT_BINARY_DIR}' --target ${target})\")
  if(CMAKE_INSTALL_COMPONENT)
    message(FATAL_ERROR \"\${sgm_lack}\")
  endif()
  message(STATUS \"\${sgm_lack}: left out\")
  return()
endif()
set(SGM_PART_INSTALLED ON)" COMPONENT ${component})
endfunction()
