# sgm_install_part(COMPONENT TARGET): must be the first install rule of a folder whose rules all belong to COMPONENT. If
# TARGET is not built, skips the folder's other rules with a message; if COMPONENT was requested explicitly, this is an
# error. So a tree in which only some targets were built installs only these, and refers to no missing files.
function(sgm_install_part component target)
  set_property(GLOBAL APPEND PROPERTY SGM_COMPONENTS ${component})
  # The code below becomes part of the folder's install script. Its return() ends that script, so the folder's other
  # install rules are skipped.
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
