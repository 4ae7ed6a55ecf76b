#!/usr/bin/env bash
# Prints the path of a Godot engine for which the plugin can be built and tested; prints its version to stderr.
#
#   bash editor_plugin/get_godot.sh [--no-download]
#
# Uses the first engine that exists: $GODOT; godot4 or godot in PATH, 4.3 or newer; one that this script has unpacked
# before into build/tools/godot (or $SGM_GODOT_CACHE). Otherwise unpacks one there, with its libraries and a software
# Vulkan device, from a newer suite of Debian (amd64; about 900 MB; nothing is installed), unless --no-download is
# given. Exit status: 0, or 1 after a line that says what to do.
set -euo pipefail
[[ ${1:-} != --help ]] || { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//;p}' "${BASH_SOURCE[0]}"; exit 0; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cache=${SGM_GODOT_CACHE:-$root/build/tools/godot}
suite=sid

die() { echo "get_godot: error: $1" >&2; exit 1; }

# version PROGRAM: prints "4.6.3.stable...", or nothing if the program does not run.
version() { timeout 60 "$1" --headless --version 2>/dev/null </dev/null | tail -n 1 | tr -d '\r' || true; }
new_enough() { [[ $1 =~ ^4\.([0-9]+) ]] && ((BASH_REMATCH[1] >= 3)); }
found() { echo "get_godot: $2 ($1)" >&2; echo "$1"; exit 0; }

if [[ -n ${GODOT:-} ]]; then
  program=$(command -v "$GODOT" || true)
  [[ -n $program ]] || die "GODOT names '$GODOT', which is not a program"
  is=$(version "$program")
  new_enough "$is" || die "GODOT names '$GODOT', which is '${is:-not a working Godot}'; the plugin needs Godot 4.3 or newer"
  found "$program" "$is"
fi
for name in godot4 godot; do
  program=$(command -v "$name" || true)
  [[ -n $program ]] || continue
  is=$(version "$program")
  new_enough "$is" && found "$program" "$is"
  echo "get_godot: $program is '${is:-not a working Godot}': ignored" >&2
done

unpacked() {
  [[ -x $cache/godot ]] || return 1
  local is
  is=$(version "$cache/godot")
  new_enough "$is" && found "$cache/godot" "$is"
  return 1
}
unpacked || true
[[ ${1:-} != --no-download ]] || die "there is no Godot; without --no-download this script unpacks one"
help="set GODOT to a Godot 4.3 or newer (from godotengine.org), or leave its tests out: tests/run.sh --without godot"
[[ $(dpkg --print-architecture 2>/dev/null) == amd64 ]] && command -v apt-get >/dev/null ||
  die "there is no Godot, and this script can unpack one only on Debian amd64; $help"

mkdir -p "$(dirname "$cache")"
exec 9>"$cache.lock"
flock -w 900 9 || die "another run has been unpacking Godot for 15 minutes; $help"
unpacked || true

sources=(/etc/apt/sources.list /etc/apt/sources.list.d/*)
mirror=$(cat "${sources[@]}" 2>/dev/null | sed -n 's/^URIs: *\([^ ]*\).*/\1/p; s/^deb  *\(\[[^]]*\] *\)\{0,1\}\([^ ]*\).*/\2/p' |
  grep debian | grep -v security | head -n 1 || true)
[[ -n $mirror ]] || die "the sources of apt name no mirror of Debian; $help"
new=$cache.unfinished
trap 'rm -rf "$new"' EXIT
rm -rf "$new"
mkdir -p "$new"/apt/lists/partial "$new"/apt/cache/archives/partial "$new"/root
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" >"$new/apt/sources.list"
: >"$new/apt/status"
apt() {
  apt-get -qq -o "Dir::State::Lists=$new/apt/lists" -o "Dir::Etc::SourceList=$new/apt/sources.list" \
    -o Dir::Etc::SourceParts=/dev/null -o "Dir::Cache=$new/apt/cache" -o "Dir::State::status=$new/apt/status" \
    -o APT::Sandbox::User=root -o Acquire::Retries=2 -o Acquire::http::Timeout=30 "$@" >"$new/apt/log" 2>&1 </dev/null
}
echo "get_godot: unpacking Godot below $cache" >&2
apt update && apt install --no-install-recommends --download-only -y godot mesa-vulkan-drivers libgl1-mesa-dri ||
  die "Godot could not be downloaded (is the network available? apt's last message: $(tail -n 1 "$new/apt/log")); $help"
for package in "$new"/apt/cache/archives/*.deb; do
  dpkg-deb -x "$package" "$new/root" || die "a package could not be unpacked (is the disk full?); $help"
done
rm -rf "$new/apt"

# The wrapper starts the engine with the dynamic loader and the libraries of the wrapper's own folder. The folder may
# thus be moved.
cat >"$new/godot" <<'WRAPPER'
#!/bin/sh
here=$(dirname "$(readlink -f "$0")")
lib=$here/root/usr/lib/x86_64-linux-gnu
sed "s#\"library_path\": *\"[^\"]*#\"library_path\": \"$lib/libvulkan_lvp.so#" \
  "$here/root/usr/share/vulkan/icd.d/"lvp_icd*.json >"$here/lavapipe.json.$$" &&
  mv "$here/lavapipe.json.$$" "$here/lavapipe.json"
[ -n "$SGM_GODOT_GPU" ] || export VK_DRIVER_FILES="$here/lavapipe.json"
exec "$lib/ld-linux-x86-64.so.2" --library-path "$lib:$lib/pulseaudio:$lib/blas:$lib/lapack" \
  "$here/root/usr/bin/godot" --audio-driver Dummy "$@"
WRAPPER
chmod +x "$new/godot"
is=$(version "$new/godot")
new_enough "$is" || die "the unpacked program is '${is:-not a working Godot}'; $help"
rm -rf "$cache"
mv "$new" "$cache"
found "$cache/godot" "$is"
