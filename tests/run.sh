#!/usr/bin/env bash
# Builds and runs the tests, on a bare Debian 12 as root or with sudo. Installs missing packages, and prints their names.
#
#   bash tests/run.sh                 the quick tests: one optimised build, the library's own tests
#   bash tests/run.sh --module NAME   the tests of one module (grammar, derive, field, mesh, stream, ...)
#   bash tests/run.sh --all           every test, in four builds; run this before merging a change
#   bash tests/run.sh --long          as --all with far longer property tests and fuzzers, which begin from new random
#                                     seeds, three more builds, and AVX-512 under emulation (label emulated; installs an
#                                     emulator)
#
#   --label LABEL   only tests with this ctest label (unit, cpu, vulkan, cli, judges, style, gltf, threads, fuzz, godot, slurm,
#                   ...); implies --all
#   --without NAME  leave out a build (fuzz, plain, tsan) or a label; each is named in the summary
#   --require-cuda  fail if nvcc or an NVIDIA GPU is missing, which some tests of label cuda need; without this option
#                   they are skipped then, and the summary names them; implies --all
#   --jobs N        at most N compilers and tests at once (default: one for each processor)
#
# A failed test prints its seed, and SGM_SEED=n repeats the test with that seed (after --long: SGM_LONG=1 SGM_SEED=n).
#
# The quick tests need neither Godot nor a browser; if Godot is installed (editor_plugin/get_godot.sh), one script runs in
# it. Their output ends with the names of the tests that were left out, and the command that runs them.
#
# --all tests the Godot plugin in a real Godot, which editor_plugin/get_godot.sh finds or unpacks, unless --without godot
# is given. It needs a Vulkan device (software Vulkan suffices, and is installed), unless --without vulkan is given.
#
# The four builds: release runs every test; fuzz (clang++, address and undefined-behaviour sanitizers) runs the unit tests
# again, and the fuzzers; plain (clang++, optimised, without vector instructions; also the static package) runs the tests
# that compare bits; tsan (thread sanitizer) runs the tests with threads. --long adds dev (g++, the sanitizers of fuzz, no
# unity build), scalar (g++, without vector instructions) and clang (clang++, with them). The last lines are the summary
# of ctest over all builds. Exit status: 0 if every test passed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

tier=quick module= variants=(fuzz plain tsan)
labels=() without=() jobs=$(nproc) timeout=900
usage() { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}"; }
die() { echo "tests/run.sh: error: $1" >&2; exit "${2:-1}"; }
while (($#)); do
  case $1 in
    --all) tier=all ;;
    --long) export SGM_LONG=1 && tier=all timeout=7200 variants+=(dev scalar clang) ;;
    --require-cuda) export SGM_REQUIRE_CUDA=1 && tier=all ;;
    --module | --label | --without | --jobs)
      (($# > 1)) || die "$1 needs a value" 2
      case $1 in
        --module) module=$2 ;;
        --label) labels+=("$2") && tier=all ;;
        --without) without+=("$2") ;;
        --jobs) jobs=$2 ;;
      esac
      shift
      ;;
    -h | --help) usage && exit 0 ;;
    *) die "unknown option $1 (--help lists them)" 2 ;;
  esac
  shift
done
modules=$(grep -l sgm_unit_test tests/*/CMakeLists.txt tests/unit/*/CMakeLists.txt | xargs -n 1 dirname | xargs -n 1 basename)
[[ -z $module || " ${modules//$'\n'/ } " == *" $module "* ]] || die "there is no module '$module'; the modules are: ${modules//$'\n'/ }" 2
[[ -z $module || $tier == quick ]] || die "--module runs one module's tests in the release build: leave the other options out" 2
[[ $tier == all || ${#without[@]} == 0 ]] || die "--without needs --all or --long" 2
[[ " ${without[*]-} " == *" vulkan "* ]] || export SGM_REQUIRE_VULKAN=1
[[ $jobs =~ ^[1-9][0-9]*$ ]] || die "--jobs needs a number, not '$jobs'" 2

# Make ccache hash paths within the checkout as relative paths, so that a clone in another folder finds the compiled
# objects in the cache.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1

started=$SECONDS
step() { printf '\n== %s (after %d s)\n' "$1" $((SECONDS - started)); }

# build PRESET [TARGET]: builds the preset; prints the log only if the build fails.
build() {
  step "build $1"
  local log=build/$1.configure.log options=() target=()
  [[ $1 != release || -z ${SGM_REQUIRE_CUDA:-} ]] || options=(-DSGM_CUDA=ON)
  [[ -z ${2:-} ]] || target=(--target "$2")
  mkdir -p build
  cmake --preset "$1" ${options[@]+"${options[@]}"} >"$log" 2>&1 || { cat "$log" >&2; die "configuring $1 failed"; }
  grep -i -A3 'warning' "$log" || true
  cmake --build --preset "$1" -j "$jobs" ${target[@]+"${target[@]}"} -- --quiet || die "building $1 failed"
}

step "packages"
source samples/setup_debian.sh
if [[ $tier == quick ]]; then
  sgm_setup "${SGM_BUILD_PACKAGES[@]}" "${SGM_QUICK_TEST_PACKAGES[@]}"
  label=quick target=sgm_quick_tests
  if [[ -n $module ]]; then
    label=module_$module target=sgm_tests_$module
  fi
  build release "$target"
  step "tests"
  status=0
  ctest --test-dir build/release --output-on-failure --no-tests=error --no-label-summary --timeout "$timeout" -j "$jobs" \
    -L "^$label\$" </dev/null || status=$?
  if [[ -z $module ]]; then
    # If Godot is installed, runs one script in it.
    if bash editor_plugin/get_godot.sh --no-download >/dev/null 2>&1; then
      step "the Godot plugin"
      bash editor_plugin/build.sh && bash editor_plugin/tests/run.sh headless/grammars || status=1
    fi
    echo
    echo "Left out (bash tests/run.sh --all runs everything):"
    ctest --test-dir build/release --show-only -LE '^quick$' | sed -n 's/^ *Test *#[0-9]*: //p' | paste -sd ' ' | fold -s -w 110 | sed 's/^/  /; s/ *$//'
    echo "  and all unit tests with sanitizers (fuzz, tsan) and with another compiler (plain)"
  fi
  exit "$status"
fi
sgm_setup "${SGM_BUILD_PACKAGES[@]}" "${SGM_TEST_PACKAGES[@]}"
sgm_setup_npm build/tools gltf-validator 2.0.0-dev.3.10 manifold-3d 3.5.4 vscode-languageserver-protocol 3.17.5 \
  vscode-textmate 9.3.2 vscode-oniguruma 2.0.1 playwright-core 1.65.1 ajv 8.20.0 ajv-formats 3.0.1 \
  @seriousme/openapi-schema-validator 2.11.0

if [[ " ${without[*]-} " != *" godot "* ]]; then
  step "Godot"
  bash editor_plugin/get_godot.sh >/dev/null || die "the plugin cannot be tested; --without godot leaves its tests out"
fi

chosen=(release) left_out_labels=()
for variant in "${variants[@]}"; do
  [[ " ${without[*]-} " == *" $variant "* ]] || chosen+=("$variant")
done
for name in ${without[@]+"${without[@]}"}; do
  [[ " ${variants[*]} " == *" $name "* ]] || left_out_labels+=("$name")
done
for preset in "${chosen[@]}"; do build "$preset"; done

# A single ctest runs the tests of all builds, so that its summary and exit status cover all of them.
mkdir -p build/all
{
  for preset in "${chosen[@]}"; do echo "subdirs(\"$root/build/$preset\")"; done
  for name in ${without[@]+"${without[@]}"}; do
    echo "add_test(\"LEFT OUT by --without: $name\" false)"
    echo "set_tests_properties(\"LEFT OUT by --without: $name\" PROPERTIES DISABLED TRUE LABELS left_out)"
  done
} >build/all/CTestTestfile.cmake

step "tests"
known=" $(ctest --test-dir build/all --print-labels | sed -n 's/^  //p' | tr '\n' ' ') "
for name in ${labels[@]+"${labels[@]}"} ${left_out_labels[@]+"${left_out_labels[@]}"}; do
  [[ $known == *" $name "* ]] || die "no test has the label '$name'; the labels are:${known% }" 2
done
joined() { local IFS='|'; echo "^($*)\$"; }
filter=()
((${#labels[@]})) && filter+=(-L "$(joined "${labels[@]}" left_out)")
((${#left_out_labels[@]})) && filter+=(-LE "$(joined "${left_out_labels[@]}")")
for name in ${without[@]+"${without[@]}"}; do echo "LEFT OUT by --without: $name"; done
# Tests must fail rather than be skipped if a device or tool is missing, since the setup above has installed all of
# them.
export SGM_REQUIRE_ALL=1
ctest --test-dir build/all --output-on-failure --no-tests=error --no-label-summary --timeout "$timeout" -j "$jobs" \
  ${filter[@]+"${filter[@]}"} </dev/null
