#!/usr/bin/env bash
# Builds the Godot plugin against the installed package of libsgm, into demo/addons/sgm/bin, and imports the demo
# project.
#
#   bash editor_plugin/build.sh [PREFIX]
#
#   PREFIX  folder in which libsgm is installed; by default build/release is installed into build/godot/prefix
#
# The engine's headers come from the Godot that get_godot.sh finds. Everything else is written to build/godot.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")
out=$root/build/godot
die() { echo "editor_plugin/build.sh: error: $1" >&2; exit 1; }

mkdir -p "$out"
# quietly WHAT COMMAND...: runs a command, and prints its output only if it fails.
quietly() {
  local what=$1
  shift
  "$@" >"$out/build.log" 2>&1 </dev/null || { cat "$out/build.log" >&2; die "$what failed"; }
}

prefix=${1:-$out/prefix}
if (($# == 0)); then
  [[ -e $root/build/release/runtime/cmake_install.cmake ]] ||
    die "build/release is not built: cmake --preset release && cmake --build --preset release, or name a PREFIX"
  grep -q '^SGM_TOOLS:[A-Z]*=all' "$root/build/release/CMakeCache.txt" ||
    die "build/release has only the core commands: cmake --preset release && cmake --build --preset release"
  quietly "installing build/release" cmake --install "$root/build/release" --prefix "$prefix" --component library
  # The plugin's tests bake worlds with the command `sgm`, so install it too.
  quietly "installing the command" cmake --install "$root/build/release" --prefix "$prefix" --component command
fi
godot=$(bash "$here/get_godot.sh")

# The engine generates the headers of its C interface. They depend only on its version, so they are kept until it
# changes.
api=$out/api
version=$("$godot" --headless --version 2>/dev/null </dev/null | tail -n 1)
if [[ $(cat "$api/version" 2>/dev/null) != "$version" ]]; then
  rm -rf "$api"
  mkdir -p "$api"
  (cd "$api" && quietly "writing the engine's headers" "$godot" --headless --dump-gdextension-interface)
  [[ -s $api/gdextension_interface.h ]] || die "$godot wrote no gdextension_interface.h"
  echo "$version" >"$api/version"
fi

options=()
! command -v ccache >/dev/null || options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
quietly "configuring" cmake -S "$here" -B "$out/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DSGM_GODOT_API="$api" \
  ${options[@]+"${options[@]}"}
quietly "building" cmake --build "$out/build"
# Import the project, so that it also runs without having been opened in the editor. An engine that discovers a native
# library only during the import crashes when it quits (godotengine/godot#111048), so list the library beforehand.
[[ -e $here/demo/.godot/extension_list.cfg ]] ||
  { mkdir -p "$here/demo/.godot" && echo "res://addons/sgm/sgm.gdextension" >"$here/demo/.godot/extension_list.cfg"; }
HOME=$out/home quietly "importing the demo project" timeout 300 "$godot" --headless --path "$here/demo" --import
! grep -E '^(ERROR|SCRIPT ERROR)' "$out/build.log" >&2 || die "the demo project was imported with errors"
# Records the time of the import: tests/run.sh imports the project again if one of its files is newer.
touch "$here/demo/.godot/sgm_imported"
echo "the plugin is in editor_plugin/demo/addons/sgm, built with the headers of Godot $version"
