#!/usr/bin/env bash
# Tests that an existing build folder still works after a module's folder gets a submodule (a subfolder with its own
# CMakeLists.txt), and after this submodule is removed. CMake makes symbolic links to the headers in the build folder:
# the compiler must find the headers, and no file in the source folder may be replaced by a link.
#
#   bash tests/scripts/include_root_test.sh CMAKE ROOT
set -euo pipefail
cmake=$1 root=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/m"
cat >"$work/CMakeLists.txt" <<PROJECT
cmake_minimum_required(VERSION 3.20)
project(include_roots CXX)
include($root/runtime/module.cmake)
set(SGM_RUNTIME \${CMAKE_CURRENT_SOURCE_DIR})
add_subdirectory(m)
PROJECT
echo 'sgm_module(m SOURCES a.cpp)' >"$work/m/CMakeLists.txt"
echo 'int a();' >"$work/m/a.h"
printf '#include "m/a.h"\nint a() { return 1; }\n' >"$work/m/a.cpp"

# built STEP: configures and builds; fails if the header in the source folder was replaced.
built() {
  { "$cmake" -S "$work" -B "$work/build" && "$cmake" --build "$work/build"; } >"$work/log" 2>&1 ||
    { cat "$work/log"; echo "$1: the build failed" >&2; exit 1; }
  [[ -f $work/m/a.h && ! -L $work/m/a.h && $(<"$work/m/a.h") == 'int a();' ]] ||
    { echo "$1: m/a.h is no longer the source" >&2; exit 1; }
}
built "without modules"
mkdir "$work/m/part"
touch "$work/m/part/CMakeLists.txt"
built "with a module"
rm -r "$work/m/part"
built "without modules again"
echo "headers are found and sources untouched in a build folder that was configured before"
