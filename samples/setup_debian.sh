# Sourced by samples/demo.sh and tests/run.sh: installs the packages with which the project can be built on a bare
# Debian 12.
#
#   source samples/setup_debian.sh
#   sgm_setup "${SGM_BUILD_PACKAGES[@]}"                              # for the library, the command, the samples
#   sgm_setup "${SGM_BUILD_PACKAGES[@]}" "${SGM_TEST_PACKAGES[@]}"    # also for all tests
#   sgm_need PACKAGE...                                               # installs nothing: fails, and names missing
#   packages
#   sgm_setup_npm DIRECTORY PACKAGE VERSION [PACKAGE VERSION]...        # npm packages in DIRECTORY, which holds no
#   others
#
# These functions install only missing packages, and print their names. On failure a function returns non-zero, after a
# line on stderr that names the missing packages. They do not read standard input.

# An entry is a Debian package, or PACKAGE=COMMAND if the command may also come from elsewhere.
# Packages for the library alone: cmake --preset library.
SGM_LIBRARY_PACKAGES=(
  g++ cmake ninja-build libhwy-dev libzstd-dev libxxhash-dev libcurl4-openssl-dev libvulkan-dev
  glslang-tools spirv-tools
)
SGM_BUILD_PACKAGES=(
  g++ cmake ninja-build ccache pkg-config
  libhwy-dev libzstd-dev libxxhash-dev libcurl4-openssl-dev
  libvulkan-dev libvulkan-volk-dev mesa-vulkan-drivers glslang-tools spirv-tools libglm-dev
  libcli11-dev libembree-dev libfmt-dev libglfw3-dev libimgui-dev libmeshoptimizer-dev libstb-dev nlohmann-json3-dev
  libsqlite3-dev libboost-dev prometheus-cpp-dev
)
# Packages for the quick tests: tests/run.sh without options.
SGM_QUICK_TEST_PACKAGES=(catch2 librecast-dev vulkan-validationlayers git=git nodejs=node)
SGM_TEST_PACKAGES=(
  catch2 libcgal-dev librecast-dev clang libclang-rt-14-dev vulkan-validationlayers valgrind
  git=git ca-certificates nodejs=node npm=npm curl=curl prometheus chromium xvfb xauth xdotool slurm-wlm=sbatch munge=munged
  nginx-light=nginx
)
# Packages to emulate AVX-512 if the processor lacks it: tests/scripts/avx512_emulated.sh.
SGM_EMULATION_PACKAGES=(bochs bochs-term bochsbios vgabios isolinux syslinux-common xorriso busybox-static)

# Prints the package of each entry that is missing: neither its package is installed, nor its command (if any) exists.
sgm_missing() {
  local entry present
  present=" $(dpkg-query -W -f='${db:Status-Status} ${Package}\n' 2>/dev/null | sed -n 's/^installed //p' | tr '\n' ' ')"
  for entry in "$@"; do
    [[ $entry == *=* ]] && command -v "${entry#*=}" >/dev/null && continue
    [[ $present == *" ${entry%%=*} "* ]] || printf '%s\n' "${entry%%=*}"
  done
}

sgm_setup() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "setup: this is not a Debian system; continuing without installing packages (needed: ${*%%=*})" >&2
    return 0
  fi
  local missing as_root=()
  mapfile -t missing < <(sgm_missing "$@")
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "setup: error: run this as root, or install by hand: apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
    [[ -t 0 ]] || as_root=(sudo -n)
  fi
  echo "setup: installing ${missing[*]}"
  local log
  log=$(mktemp)
  # If updating the package lists fails, the old lists may still suffice; the installation below decides.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q >"$log" 2>&1 </dev/null || true
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}" >>"$log" 2>&1 </dev/null; then
    mapfile -t missing < <(sgm_missing "$@")
    echo "setup: error: could not install ${missing[*]} (is the network available? the output of apt-get is in $log)" >&2
    return 1
  fi
  rm -f "$log"
}

sgm_need() {
  local missing
  command -v dpkg-query >/dev/null || return 0
  mapfile -t missing < <(sgm_missing "$@")
  ((${#missing[@]})) || return 0
  echo "setup: error: packages are missing: apt-get install ${missing[*]}" >&2
  return 1
}

sgm_setup_npm() {
  local directory=$1 log wanted=() missing=()
  shift
  while (($# > 1)); do
    wanted+=("$1@$2")
    grep -qs "\"version\": \"$2\"" "$directory/node_modules/$1/package.json" || missing+=("$1 $2")
    shift 2
  done
  ((${#missing[@]} > 0)) || return 0
  printf -v missing '%s, ' "${missing[@]}"
  echo "setup: installing npm packages ${missing%, } into $directory"
  mkdir -p "$directory"
  log=$(mktemp)
  # All packages are passed in one call, because npm removes packages that a call does not name.
  if ! npm install --prefix "$directory" --no-fund --no-audit --no-save --prefer-offline --fetch-retries=1 \
    --fetch-retry-mintimeout=1000 --loglevel=error "${wanted[@]}" >"$log" 2>&1 </dev/null; then
    echo "setup: error: could not install npm packages ${missing%, } (is the network available? the output of npm is in $log)" >&2
    return 1
  fi
  rm -f "$log"
}
