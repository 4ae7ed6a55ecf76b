# Flags that every target of ours shares, and sgm_module(): one CMake target a folder.

set(SGM_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
  -Woverloaded-virtual -Wold-style-cast
  # g++ 12 sees overlaps (GCC bug 105651) and null pointers in its own std::string and std::vector, once inlined.
  # clang++ takes an explicit double{f} for a silent promotion.
  $<IF:$<CXX_COMPILER_ID:GNU>,-Wdouble-promotion;-Wno-restrict,-Wnull-dereference>)

if(SGM_WERROR)
  list(APPEND SGM_WARNINGS -Werror)
endif()

# The arithmetic contract: no contraction into fma, no value-changing optimisation, in any target.
set(SGM_EXACT_FLAGS -ffp-contract=off -fno-fast-math)

function(sgm_target_flags target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:${SGM_WARNINGS}> ${SGM_EXACT_FLAGS})
  if(SGM_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${SGM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # instrumentation makes them cry wolf
    target_link_options(${target} PUBLIC -fsanitize=${SGM_SANITIZE})
  endif()
endfunction()

# sgm_module(NAME [AS path] [BATCH count] SOURCES ... [LINK private libraries ...] [PUBLIC libraries whose headers ours
# include ...]) makes the static library sgm_NAME from the caller's folder. Headers are included as "NAME/file.h", or
# "path/file.h". BATCH: so many files are one unit of a unity build, where most of a unit's time goes to headers that they
# share; names in their unnamed namespaces differ then. mesh does without: more functions in a unit change what is inlined.
function(sgm_module name)
  cmake_parse_arguments(ARG "" "AS;BATCH" "SOURCES;LINK;PUBLIC" ${ARGN})
  if(NOT ARG_AS)
    set(ARG_AS ${name})
  endif()
  add_library(sgm_${name} STATIC ${ARG_SOURCES})
  if(ARG_BATCH)
    set_target_properties(sgm_${name} PROPERTIES UNITY_BUILD_BATCH_SIZE ${ARG_BATCH})
  endif()
  # A folder sees its own headers and those of the modules it names, nothing else.
  set(include_root ${CMAKE_CURRENT_BINARY_DIR}/include_root)
  cmake_path(GET ARG_AS PARENT_PATH parent)
  file(MAKE_DIRECTORY ${include_root}/${parent})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${include_root}/${ARG_AS} SYMBOLIC)
  target_include_directories(sgm_${name} PUBLIC ${include_root})
  target_link_libraries(sgm_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_LINK})
  sgm_target_flags(sgm_${name})
endfunction()
