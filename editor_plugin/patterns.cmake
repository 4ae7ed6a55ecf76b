# Writes the renderer's patterns (shaders/render) as an include of Godot's shaders: the same stone and bricks everywhere.
#
#   cmake -DSHADERS=FOLDER_OF_render -DOUTPUT=FILE.gdshaderinc -P editor_plugin/patterns.cmake
#
# Godot's shading language is GLSL without a conversion of whole numbers in constructors, and without #include of ours.
cmake_minimum_required(VERSION 3.25)
set(text "")
# take(FILE): appends it, and first what it includes, each once.
set(taken "")
function(take file)
  if(file IN_LIST taken)
    return()
  endif()
  list(APPEND taken ${file})
  # Semicolons and brackets mean something in CMake's lists: they go by other names until the end.
  file(READ ${SHADERS}/${file} source)
  string(REPLACE ";" "@semicolon@" source "${source}")
  string(REPLACE "[" "@open@" source "${source}")
  string(REPLACE "]" "@close@" source "${source}")
  string(REPLACE "\n" ";" lines "${source}")
  foreach(line IN LISTS lines)
    if(line MATCHES "^#include \"(.*)\"$")
      take(${CMAKE_MATCH_1})
      continue()
    endif()
    # A pattern is compiled where a material of the world has it.
    if(line MATCHES "^(.*)if \\(pattern == ([0-9]+)u && has\\([0-9]+u\\)\\) (return .*)$")
      string(APPEND text "#if !defined(SGM_PATTERNS_CHOSEN) || defined(SGM_PATTERN_${CMAKE_MATCH_2})\n"
        "${CMAKE_MATCH_1}if (pattern == ${CMAKE_MATCH_2}u) {\n${CMAKE_MATCH_1}${CMAKE_MATCH_1}${CMAKE_MATCH_3}\n"
        "${CMAKE_MATCH_1}}\n#endif\n")
      continue()
    elseif(line MATCHES "^(.*)if \\(has\\(([0-9]+)u\\)\\) (return .*)$")
      string(APPEND text "#if !defined(SGM_PATTERNS_CHOSEN) || defined(SGM_PATTERN_${CMAKE_MATCH_2})\n"
        "${CMAKE_MATCH_1}if (pattern == ${CMAKE_MATCH_2}u) {\n${CMAKE_MATCH_1}${CMAKE_MATCH_1}${CMAKE_MATCH_3}\n"
        "${CMAKE_MATCH_1}}\n#endif\n")
      continue()
    elseif(line MATCHES "kPatterns")
      continue()
    endif()
    string(REGEX REPLACE "([^i]vec2)\\(x, y\\)" "\\1(ivec2(x, y))" line "${line}")
    string(REGEX REPLACE "([^i]vec3)\\(([0-9]+), ([0-9]+), ([0-9]+)\\)" "\\1(\\2.0, \\3.0, \\4.0)" line "${line}")
    string(REGEX REPLACE ">> 8\\)" ">> 8u)" line "${line}")
    string(APPEND text "${line}\n")
  endforeach()
  set(text "${text}" PARENT_SCOPE)
  set(taken "${taken}" PARENT_SCOPE)
endfunction()
take(render/noise.glsl)
take(render/materials.glsl)
string(REPLACE "@semicolon@" ";" text "${text}")
string(REPLACE "@open@" "[" text "${text}")
string(REPLACE "@close@" "]" text "${text}")
file(WRITE ${OUTPUT} "// Made by editor_plugin/patterns.cmake of shaders/render: what materials look like.\n//\n"
  "// Where SGM_PATTERNS_CHOSEN is defined, only the patterns are compiled whose SGM_PATTERN_NUMBER is.\n\n${text}")
