# Defines the common compiler flags of all our targets, and sgm_module(): one CMake target for each folder.

set(SGM_RUNTIME ${CMAKE_CURRENT_LIST_DIR})

set(SGM_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
  -Woverloaded-virtual -Wold-style-cast
  # These warnings are off for g++ 12, which reports them falsely inside its own inlined std::string and std::vector:
  # -Wrestrict for overlaps (GCC bug 105651), -Wnull-dereference for null pointers. -Wdouble-promotion is off for
  # clang++, which reports an explicit double{f} as an implicit promotion.
  $<IF:$<CXX_COMPILER_ID:GNU>,-Wdouble-promotion;-Wno-restrict,-Wnull-dereference>)

if(SGM_WERROR)
  list(APPEND SGM_WARNINGS -Werror)
endif()

# Flags that fulfil the arithmetic contract in every target: no contraction into fma, no value-changing optimisation.
set(SGM_EXACT_FLAGS -ffp-contract=off -fno-fast-math)

function(sgm_target_flags target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:${SGM_WARNINGS}> ${SGM_EXACT_FLAGS})
  if(SGM_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${SGM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # g++ reports false positives in instrumented code
    target_link_options(${target} PUBLIC -fsanitize=${SGM_SANITIZE})
  endif()
endfunction()

# sgm_source_properties(FILES... PROPERTIES ...): same as set_source_files_properties, but a missing file is an error;
# otherwise the properties would have no effect without notice.
function(sgm_source_properties)
  cmake_parse_arguments(ARG "" "" "PROPERTIES" ${ARGN})
  foreach(file IN LISTS ARG_UNPARSED_ARGUMENTS)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
      message(FATAL_ERROR "sgm_source_properties: ${CMAKE_CURRENT_SOURCE_DIR} has no ${file}")
    endif()
    set_property(SOURCE ${file} DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} APPEND PROPERTY ${ARG_PROPERTIES})
  endforeach()
endfunction()

# sgm_include_root(TARGET): adds an include path for the headers of the caller's folder. Files include these headers by
# their path below runtime/ (for the folder cuda: by its name). Subfolders with their own CMakeLists.txt are separate
# modules, so their headers are not visible.
function(sgm_include_root target)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${SGM_RUNTIME} OUTPUT_VARIABLE path)
  if(path MATCHES "^\\.\\./")
    cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME path)
  endif()
  set(include_root ${CMAKE_CURRENT_BINARY_DIR}/include_root)
  file(GLOB modules ${CMAKE_CURRENT_SOURCE_DIR}/*/CMakeLists.txt)
  if(modules)
    # If this build folder was configured before the folder had submodules, ${include_root}/${path} is a link to the
    # source folder. Remove it: links created below it would replace the sources.
    if(IS_SYMLINK ${include_root}/${path})
      file(REMOVE ${include_root}/${path})
    endif()
    file(MAKE_DIRECTORY ${include_root}/${path})
    file(GLOB entries CONFIGURE_DEPENDS LIST_DIRECTORIES true ${CMAKE_CURRENT_SOURCE_DIR}/*)
    foreach(entry IN LISTS entries)
      cmake_path(GET entry FILENAME name)
      if(NOT EXISTS ${entry}/CMakeLists.txt AND (IS_DIRECTORY ${entry} OR name MATCHES "\\.(h|inl|def|inc)$"))
        file(CREATE_LINK ${entry} ${include_root}/${path}/${name} SYMBOLIC)
      endif()
    endforeach()
  else()
    cmake_path(GET path PARENT_PATH parent)
    file(MAKE_DIRECTORY ${include_root}/${parent})
    # If this build folder was configured when the folder still had submodules, ${include_root}/${path} is a folder of
    # links. Replace it.
    if(NOT IS_SYMLINK ${include_root}/${path})
      file(REMOVE_RECURSE ${include_root}/${path})
    endif()
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/${path} SYMBOLIC)
  endif()
  target_include_directories(${target} PUBLIC ${include_root})
endfunction()

# sgm_module(NAME [BATCH count] SOURCES ... [LINK private libraries ...] [PUBLIC libraries whose headers ours include
# ...]): makes the static library sgm_NAME from the caller's folder. Headers are included by their path below runtime/;
# a folder sees only its own headers and those of the modules that it names.
#
# BATCH: number of files per unit of a unity build, for modules where shared headers dominate the compile time; names in
# unnamed namespaces must then be unique. mesh has no BATCH, because more functions in a unit change inlining.
function(sgm_module name)
  cmake_parse_arguments(ARG "" "BATCH" "SOURCES;LINK;PUBLIC" ${ARGN})
  add_library(sgm_${name} STATIC ${ARG_SOURCES})
  if(ARG_BATCH)
    set_target_properties(sgm_${name} PROPERTIES UNITY_BUILD_BATCH_SIZE ${ARG_BATCH})
  endif()
  sgm_include_root(sgm_${name})
  target_link_libraries(sgm_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_LINK})
  sgm_target_flags(sgm_${name})
endfunction()
