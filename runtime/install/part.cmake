# sgm_install_part(COMPONENT TARGET): the first of a folder's install rules, which all belong to COMPONENT. If TARGET is
# not built, skips the folder's other rules with a message; for an explicitly requested component this is an error. So a
# tree in which only some targets were built installs these, without references to missing files.
function(sgm_install_part component target)
  set_property(GLOBAL APPEND PROPERTY SGM_COMPONENTS ${component})
  # The code is inserted into the folder's install script, which return() leaves.
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
