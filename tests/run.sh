#!/usr/bin/env bash
# Builds everything and runs every test, on a bare Debian 12 as root or with sudo. Installs what is missing, and says so.
#
#   bash tests/run.sh [--long] [--require-cuda] [--label LABEL]... [--without NAME]... [--jobs N]
#
#   --long          run property tests and fuzzers far longer, make three builds more, and run AVX-512 under emulation (label
#                   emulated; installs an emulator; without --long that test is skipped, and named so in the summary)
#   --label LABEL   only tests with this ctest label (unit, cpu, vulkan, cli, judges, style, gltf, threads, fuzz, godot, slurm, ...)
#   --without NAME  leave out a build (fuzz, plain, tsan) or a label; each is named in the summary
#   --require-cuda  nvcc and an NVIDIA GPU must be there, for the tests of label cuda that run on one; without it those are
#                   skipped, and named so in the summary
#   --jobs N        at most N compilers and tests at one time (default: one for each processor)
#
# The Godot plugin is tested in a real Godot, which editor_plugin/get_godot.sh finds or unpacks, unless --without godot
# leaves it out. A Vulkan device must be there (software Vulkan is installed, and will do), unless --without vulkan leaves it out.
#
# Four builds: release has every test; fuzz (clang++, both sanitizers) runs the unit tests again, and the fuzzers; plain
# (clang++ again, optimised, but no vector unit; also the static package) those that compare bits; tsan those with
# threads. --long adds dev (both sanitizers, g++, each file by itself), scalar (g++, no vector unit) and clang (clang++,
# vectors). The last lines are ctest's summary over all of them. Exit status: 0 when all passed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

variants=(fuzz plain tsan)
labels=() without=() jobs=$(nproc) timeout=900
usage() { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}"; }
die() { echo "tests/run.sh: error: $1" >&2; exit "${2:-1}"; }
while (($#)); do
  case $1 in
    --long) export SGM_LONG=1 && timeout=7200 variants+=(dev scalar clang) ;;
    --require-cuda) export SGM_REQUIRE_CUDA=1 ;;
    --label | --without | --jobs)
      (($# > 1)) || die "$1 needs a value" 2
      case $1 in --label) labels+=("$2") ;; --without) without+=("$2") ;; --jobs) jobs=$2 ;; esac
      shift
      ;;
    -h | --help) usage && exit 0 ;;
    *) die "unknown option $1 (--help lists them)" 2 ;;
  esac
  shift
done
[[ " ${without[*]-} " == *" vulkan "* ]] || export SGM_REQUIRE_VULKAN=1
[[ $jobs =~ ^[1-9][0-9]*$ ]] || die "--jobs needs a number, not '$jobs'" 2

# Paths within the checkout are hashed as relative ones, so that a clone elsewhere finds what another has compiled.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1

started=$SECONDS
step() { printf '\n== %s (after %d s)\n' "$1" $((SECONDS - started)); }

step "packages"
source samples/setup_debian.sh
sgm_setup "${SGM_BUILD_PACKAGES[@]}" "${SGM_TEST_PACKAGES[@]}"
sgm_setup_npm build/tools gltf-validator 2.0.0-dev.3.10 manifold-3d 3.5.4 vscode-languageserver-protocol 3.17.5 \
  vscode-textmate 9.3.2 vscode-oniguruma 2.0.1 playwright-core 1.65.1 ajv 8.20.0 ajv-formats 3.0.1 \
  @seriousme/openapi-schema-validator 2.11.0

if [[ " ${without[*]-} " != *" godot "* ]]; then
  step "Godot"
  bash editor_plugin/get_godot.sh >/dev/null || die "the plugin cannot be tested; --without godot leaves its tests out"
fi

# build PRESET: quiet while all is well, the whole story when not.
build() {
  step "build $1"
  local log=build/$1.configure.log options=()
  [[ $1 != release || -z ${SGM_REQUIRE_CUDA:-} ]] || options=(-DSGM_CUDA=ON)
  cmake --preset "$1" ${options[@]+"${options[@]}"} >"$log" 2>&1 || { cat "$log" >&2; die "configuring $1 failed"; }
  grep -i -A3 'warning' "$log" || true
  cmake --build --preset "$1" -j "$jobs" -- --quiet || die "building $1 failed"
}

chosen=(release) left_out_labels=()
for variant in "${variants[@]}"; do
  [[ " ${without[*]-} " == *" $variant "* ]] || chosen+=("$variant")
done
for name in ${without[@]+"${without[@]}"}; do
  [[ " ${variants[*]} " == *" $name "* ]] || left_out_labels+=("$name")
done
for preset in "${chosen[@]}"; do build "$preset"; done

# One ctest over all builds: its summary is the verdict.
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
  [[ $known == *" $name "* ]] || die "no test has the label '$name'; there are:${known% }" 2
done
joined() { local IFS='|'; echo "^($*)\$"; }
filter=()
((${#labels[@]})) && filter+=(-L "$(joined "${labels[@]}" left_out)")
((${#left_out_labels[@]})) && filter+=(-LE "$(joined "${left_out_labels[@]}")")
for name in ${without[@]+"${without[@]}"}; do echo "LEFT OUT by --without: $name"; done
# A device or a tool that is not there is an error here, not a skip: the machine was set up for it.
export SGM_REQUIRE_ALL=1
ctest --test-dir build/all --output-on-failure --no-tests=error --no-label-summary --timeout "$timeout" -j "$jobs" \
  ${filter[@]+"${filter[@]}"} </dev/null
