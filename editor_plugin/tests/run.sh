#!/usr/bin/env bash
# Runs the plugin's tests in the real engine, after editor_plugin/build.sh.
#
#   bash editor_plugin/tests/run.sh [FOLDER/NAME...]     headless/flight, rendered/pictures, ...; none: all of them
#
# pictures/readme draws the pictures of the README at 1920x1080, which takes long (SGM_GODOT_TIMEOUT, seconds). It must
# be named to run. SGM_PLACES names the pictures to draw.
#
# Tests are scripts in copies of the demo project, build/godot/projects, so that nothing in the checkout changes. Tests
# in headless/ run without a display, those in rendered/ on a virtual display with software Vulkan, those in opengl/
# there with OpenGL, and those in editor/ there in the editor.
# Pictures are written to $SGM_PICTURES (build/godot/pictures).
#
# A test passes if it ends with status 0 and its marker `SGM TEST PASSED: N checks`, and the engine's log contains no
# errors or leaks except those that the test has announced (`SGM TEST EXPECTS: REGEX`), each of which must occur.
set -euo pipefail
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$tests/../.." && pwd)
out=${SGM_GODOT_OUT:-$root/build/godot}
demo=${SGM_GODOT_DEMO:-$root/editor_plugin/demo}
die() { echo "editor_plugin/tests/run.sh: error: $1" >&2; exit 2; }
godot=$(bash "$root/editor_plugin/get_godot.sh" 2>/dev/null) || die "no Godot (bash editor_plugin/get_godot.sh says why)"

names=("$@")
if ((${#names[@]} == 0)); then
  mapfile -t names < <(cd "$tests" && ls {headless,rendered,opengl,editor}/*.gd 2>/dev/null | sed 's/\.gd$//')
fi
mkdir -p "$out/home" "$out/tests" "${SGM_PICTURES:=$out/pictures}"
export GODOT=$godot SGM_PICTURES HOME=$out/home SGM_COMMAND=${SGM_COMMAND:-$out/prefix/bin/sgm}
export XDG_DATA_HOME=$HOME/data XDG_CONFIG_HOME=$HOME/config XDG_CACHE_HOME=$HOME/cache

# Makes one copy of the project for each test, so that tests can run concurrently. Files are hard links where possible.
project_of() {
  local project=$out/projects/$1
  rm -rf "$project"
  mkdir -p "$project"
  cp -a "$demo/." "$project/"
  mkdir -p "$project/tests"
  cp -a "$tests"/{lib,headless,rendered,opengl,editor,pictures} "$tests"/../native/doc "$project/tests/" 2>/dev/null || true
  # Worlds of tests use grammars that do not change: the demo's grammars change with the samples.
  mkdir -p "$project/tests/grammars"
  cp "$root"/tests/bench/grammars/{cave,city,cloud}.sgm "$project/tests/grammars/"
  echo "$project"
}

# Whether a test of this kind can use the project as editor_plugin/build.sh has imported it. This saves time: a new
# import takes longer than most tests. Editor tests must import again, because the editor loads its plugins twice if it
# finds new files, such as the test's.
is_imported() {
  local kind=$1 known=$demo/.godot/sgm_imported
  [[ $kind != editor && -e $known && -z $(find "$demo" -path "$demo/.godot" -prune -o -type f -newer "$known" -print -quit) ]]
}

failures='^((USER |SCRIPT |USER SCRIPT |SHADER )?ERROR|Parse Error)|[Ll]eaked|still in use at exit|Orphan|ObjectDB instances'

# judge LOG STATUS: prints the faults of a run; prints nothing if it passed.
judge() {
  local log=$1 status=$2 expected=() line pattern
  grep -q '^SGM TEST PASSED: [1-9][0-9]* checks$' "$log" || echo "there is no marker: the test did not come to its end"
  ((status == 0)) || echo "it ended with status $status"
  mapfile -t expected < <(sed -n 's/^SGM TEST EXPECTS: //p' "$log")
  while IFS= read -r line; do
    for pattern in ${expected[@]+"${expected[@]}"}; do
      [[ $line =~ $pattern ]] && continue 2
    done
    echo "the engine's log: $line"
  done < <(grep -E "$failures" "$log")
  for pattern in ${expected[@]+"${expected[@]}"}; do
    grep -qE "^(ERROR|WARNING|SCRIPT ERROR|USER).*($pattern)" "$log" ||
      echo "it was to provoke an error, which did not come: $pattern"
  done
}

run_one() {
  local name=$1 kind=${1%%/*} project log status=0 resolution command
  # The software renderer compiles shaders in less time if it does not optimise them, but then it draws more slowly. So
  # only tests that draw few pictures ask for this.
  local fast_compiler=(env GALLIVM_PERF=nopt)
  [[ -e $tests/$name.gd ]] || die "there is no test $name"
  project=$(project_of "${name//\//_}")
  log=$out/tests/${name//\//_}.log
  case $kind in
    headless) command=("$godot" --headless --path "$project" --script "tests/$name.gd") ;;
    rendered)
      # Only the test `closed`, which searches for holes, needs many pixels. Other tests draw fewer, because a software
      # device needs long for each pixel.
      resolution=640x360
      [[ $name != */closed ]] || { resolution=1280x720 && fast_compiler=(); }
      command=(${fast_compiler[@]+"${fast_compiler[@]}"} xvfb-run -a -s "-screen 0 1600x900x24" "$godot"
        --rendering-driver vulkan --resolution $resolution --path "$project" --script "tests/$name.gd")
      ;;
    pictures) command=(xvfb-run -a -s "-screen 0 1920x1200x24" "$godot" --rendering-driver vulkan --resolution 1920x1080
      --path "$project" --script "tests/$name.gd") ;;
    opengl) command=(xvfb-run -a -s "-screen 0 1600x900x24" "$godot" --rendering-method gl_compatibility
      --rendering-driver opengl3 --resolution 1280x720 --path "$project" --script "tests/$name.gd") ;;
    editor)
      # The editor keeps the shaders that it has compiled in the project; tests share them, because compiling takes long.
      mkdir -p "$out/editor_shaders"
      [[ -e $project/.godot/shader_cache ]] || ln -s "$out/editor_shaders" "$project/.godot/shader_cache"
      # Adds a plugin to the project's copy, which loads the test into the editor.
      cp -a "$tests/lib/driver" "$project/addons/sgm_test"
      sed -i "s#^enabled=PackedStringArray(#&\"res://addons/sgm_test/plugin.cfg\", #" "$project/project.godot"
      export SGM_EDITOR_TEST="res://tests/$name.gd"
      command=("${fast_compiler[@]}" xvfb-run -a -s "-screen 0 1600x900x24" "$godot" --rendering-driver vulkan
        --resolution 1600x900 --editor --path "$project")
      ;;
    *) die "tests lie in headless, rendered, opengl, editor and pictures, not in '$kind'" ;;
  esac
  is_imported "$kind" || timeout 300 "$godot" --headless --path "$project" --import >"$log.import" 2>&1 </dev/null || true
  timeout "${SGM_GODOT_TIMEOUT:-600}" "${command[@]}" >"$log" 2>&1 </dev/null || status=$?
  local wrong
  wrong=$(judge "$log" "$status")
  if [[ -z $wrong ]]; then
    grep -E '^(SGM TEST PASSED|main thread|resident|SGM NOTE)' "$log" | sed "s#^#$name: #"
    rm -rf "$project"
    return 0
  fi
  echo "$name FAILED (its log: $log)"
  sed 's/^/  /' <<<"$wrong" | head -n 30
  grep '^SGM CHECK FAILED' "$log" | sed 's/^/  /' || true
  return 1
}

failed=0
for name in "${names[@]}"; do run_one "$name" || failed=1; done
exit "$failed"
