# Translates the renderer's patterns and clouds (shaders/render) to include files of Godot's shaders,
# patterns.gdshaderinc and clouds.gdshaderinc, so that stone, bricks and sky look the same in both renderers.
#
#   cmake -DSHADERS=FOLDER_OF_render -DOUTPUT=FOLDER -P editor_plugin/patterns.cmake
#
# Godot's shading language is GLSL without integer conversions in constructors, and without our #include. A line that
# cannot be translated is an error, so that a change of the patterns fails here and not in the engine.
#
# A file is written only if it changes, and atomically: several builds may share it, and a running engine never reads an
# incomplete file.
cmake_minimum_required(VERSION 3.25)
set(text "")
# fail(FILE LINE WHAT): reports a line that this script cannot translate.
function(fail file line what)
  string(REPLACE "@semicolon@" ";" line "${line}")
  string(REPLACE "@open@" "[" line "${line}")
  string(REPLACE "@close@" "]" line "${line}")
  message(FATAL_ERROR "${SHADERS}/${file}: ${what}:\n  ${line}\nWrite it as the lines around it are written, or teach "
    "editor_plugin/patterns.cmake to translate it.")
endfunction()
# take(FILE): appends the file's includes and then the file itself, each once.
set(taken "")
function(take file)
  if(file IN_LIST taken)
    return()
  endif()
  list(APPEND taken ${file})
  # Semicolons and brackets have a meaning in CMake's lists. They are therefore replaced by words here, and put back at
  # the end.
  file(READ ${SHADERS}/${file} source)
  if(source MATCHES "\\\\")
    fail(${file} "\\" "backslashes mean something in CMake's lists and are not translated")
  endif()
  string(REPLACE ";" "@semicolon@" source "${source}")
  string(REPLACE "[" "@open@" source "${source}")
  string(REPLACE "]" "@close@" source "${source}")
  string(REPLACE "\n" ";" lines "${source}")
  foreach(line IN LISTS lines)
    if(line MATCHES "^#include \"(.*)\"$")
      take(${CMAKE_MATCH_1})
      continue()
    endif()
    # A pattern is compiled only if a material of the world uses it.
    if(line MATCHES "^( *)if \\(has\\(([0-9]+)u\\)\\) { if \\(pattern == ([0-9]+)u\\) (return .*) }$")
      if(NOT CMAKE_MATCH_2 EQUAL CMAKE_MATCH_3)
        fail(${file} "${line}" "it asks for two different patterns")
      endif()
      string(APPEND text "#if !defined(SGM_PATTERNS_CHOSEN) || defined(SGM_PATTERN_${CMAKE_MATCH_2})\n"
        "${CMAKE_MATCH_1}if (pattern == ${CMAKE_MATCH_2}u) {\n${CMAKE_MATCH_1}${CMAKE_MATCH_1}${CMAKE_MATCH_4}\n"
        "${CMAKE_MATCH_1}}\n#endif\n")
      continue()
    elseif(line MATCHES "^(.*)if \\(has\\(([0-9]+)u\\)\\) (return .*)$")
      string(APPEND text "#if !defined(SGM_PATTERNS_CHOSEN) || defined(SGM_PATTERN_${CMAKE_MATCH_2})\n"
        "${CMAKE_MATCH_1}if (pattern == ${CMAKE_MATCH_2}u) {\n${CMAKE_MATCH_1}${CMAKE_MATCH_1}${CMAKE_MATCH_3}\n"
        "${CMAKE_MATCH_1}}\n#endif\n")
      continue()
    elseif(line MATCHES "^layout\\(constant_id = 0\\) const uint kPatterns = [^@]*@semicolon@$" OR
        line MATCHES "^#define has\\(pattern\\) \\(\\(kPatterns ")
      continue()
    elseif(file STREQUAL "render/patterns.h" AND line MATCHES "^const uint k([A-Za-z]+) = ([0-9]+)u@semicolon@$")
      # For a pattern with a name: shaders test SGM_HAS_NAME to know whether the pattern is compiled.
      string(TOUPPER ${CMAKE_MATCH_1} name)
      string(APPEND text "#if !defined(SGM_PATTERNS_CHOSEN) || defined(SGM_PATTERN_${CMAKE_MATCH_2})\n"
        "#define SGM_HAS_${name}\n#endif\n")
    endif()
    # Godot's shading language has no attribute dont_unroll for loops. Instead, multiply the loop's bound by
    # whole_loops: a compiler does not unroll a loop whose bound it does not know.
    string(REGEX REPLACE "@open@@open@dont_unroll@close@@close@ for \\(int ([a-z]) = 0@semicolon@ [a-z] < ([0-9]+)@semicolon@"
      "for (int \\1 = 0@semicolon@ \\1 < \\2 * whole_loops@semicolon@" line "${line}")
    string(REGEX REPLACE "([^i]vec3)\\(([0-9]+), ([0-9]+), ([0-9]+)\\)" "\\1(\\2.0, \\3.0, \\4.0)" line "${line}")
    string(REGEX REPLACE ">> 8\\)" ">> 8u)" line "${line}")
    string(REGEX REPLACE "//.*$" "" code "${line}")
    if(code MATCHES "(^|[^a-zA-Z_])has\\(|kPatterns")
      fail(${file} "${line}" "it asks for a pattern in another way than \"if (has(7u)) { if (pattern == 7u) return\"")
    elseif(code MATCHES "^ *#(include|version|extension)|^ *layout|(^|[^a-zA-Z_])(buffer|texelFetch|shared)[^a-zA-Z_]" OR
        code MATCHES "@open@@open@")
      fail(${file} "${line}" "Godot's shading language has nothing like it")
    elseif(code MATCHES "(^|[^a-zA-Z_])vec[234]\\(([^()]*, *)?-?[0-9]+ *[,)]")
      fail(${file} "${line}" "a vector of whole numbers, which Godot does not convert")
    endif()
    string(APPEND text "${line}\n")
  endforeach()
  set(text "${text}" PARENT_SCOPE)
  set(taken "${taken}" PARENT_SCOPE)
endfunction()
# put(NAME WHAT): writes the collected text to a file, and empties the text.
function(put name what)
  string(REPLACE "@semicolon@" ";" text "${text}")
  string(REPLACE "@open@" "[" text "${text}")
  string(REPLACE "@close@" "]" text "${text}")
  string(PREPEND text "// Made by editor_plugin/patterns.cmake of shaders/render: ${what}\n\n"
    "// A factor of 1. Compilers of SPIR-V must not know it, so that they do not unroll loops, which takes minutes; compilers\n"
    "// of OpenGL take minutes if they do not know it.\n"
    "#if defined(CURRENT_RENDERER) && CURRENT_RENDERER == RENDERER_COMPATIBILITY\nconst int whole_loops = 1;\n#else\n"
    "group_uniforms sgm;\nuniform int whole_loops = 1;\ngroup_uniforms;\n#endif\n\n")
  set(before "")
  if(EXISTS ${OUTPUT}/${name})
    file(READ ${OUTPUT}/${name} before)
  endif()
  if(NOT text STREQUAL before)
    string(RANDOM LENGTH 12 random)
    file(WRITE ${OUTPUT}/${name}.${random} "${text}")
    file(RENAME ${OUTPUT}/${name}.${random} ${OUTPUT}/${name})
  endif()
  set(text "" PARENT_SCOPE)
  set(taken "" PARENT_SCOPE)
endfunction()
take(render/noise.glsl)
take(render/patterns.h)
take(render/materials.glsl)
if(NOT text MATCHES "#define SGM_HAS_LEAFY")
  message(FATAL_ERROR "${SHADERS}/render/patterns.h names no pattern kLeafy, which triplanar.gdshader asks for: write "
    "\"const uint kLeafy = NUMBER;\" on a line of its own.")
endif()
put(patterns.gdshaderinc "what materials look like.\n//\n// Where SGM_PATTERNS_CHOSEN is defined, only the patterns are \
compiled whose SGM_PATTERN_NUMBER is.")
take(render/noise.glsl)
take(render/cloud_layer.glsl)
put(clouds.gdshaderinc "clouds of fair weather, in the direction d of the eye.")
