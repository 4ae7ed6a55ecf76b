#!/usr/bin/env bash
# Tests samples/setup_debian.sh with fake versions of apt and other commands: it must not touch installed packages, must
# install and report missing ones, and must report an unavailable package in one line, with a non-zero status.
#
#   bash tests/scripts/setup_test.sh [ROOT]
set -euo pipefail
root=$(cd "${1:-.}" && pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
mkdir "$place/bin"

cat >"$place/bin/dpkg-query" <<'END'
#!/bin/sh
sed 's/^/installed /' "$PLACE/installed"
echo "config-files half"
END
cat >"$place/bin/apt-get" <<'END'
#!/bin/sh
echo "$DEBIAN_FRONTEND $*" >>"$PLACE/calls"
[ "$1" = update ] && exit "${NETWORK:-0}"
[ "${NETWORK:-0}" = 0 ] || { echo "E: Unable to fetch some archives"; exit 100; }
for word; do case $word in -*|install) ;; *) echo "$word" >>"$PLACE/installed" ;; esac; done
END
printf '#!/bin/sh\nexec "$@"\n' >"$place/bin/sudo"
printf '#!/bin/sh\nexit 0\n' >"$place/bin/sometool"
cat >"$place/bin/npm" <<'END'
#!/bin/sh
[ "${NETWORK:-0}" = 0 ] || { echo "npm ERR! network"; exit 1; }
mkdir -p "$3/node_modules/validator"
echo '  "version": "1.0.0",' >"$3/node_modules/validator/package.json"
END
chmod +x "$place"/bin/*

export PLACE=$place PATH=$place/bin:$PATH
source "$root/samples/setup_debian.sh"
fail() { echo "setup_test: $1" >&2; exit 1; }
calls() { cat "$place/calls" 2>/dev/null || true; }

echo here >"$place/installed"
out=$(sgm_setup here absent=sometool </dev/null)
[[ -z $out && -z $(calls) ]] || fail "asked for packages that are there"

out=$(sgm_setup here one two=nosuchtool half </dev/null)
[[ $out == "setup: installing one two half" ]] || fail "said: $out"
grep -q "^noninteractive install .*--no-install-recommends one two half$" "$place/calls" || fail "apt-get was called with: $(calls)"

rm "$place/calls"
out=$(sgm_setup here one two half </dev/null)
[[ -z $out && -z $(calls) ]] || fail "a second call installed again"

if NETWORK=1 sgm_setup here lost </dev/null >"$place/out" 2>"$place/err"; then fail "no error without network"; fi
tail -n 1 "$place/err" | grep -q 'error: could not install lost ' || fail "the error was: $(cat "$place/err")"

rm -f "$place/calls"
out=$(sgm_need here one absent=sometool 2>&1) || fail "sgm_need wants what is there"
[[ -z $out ]] || fail "sgm_need said: $out"
if out=$(sgm_need here gone two lost=nosuchtool 2>&1); then fail "sgm_need goes on without packages"; fi
[[ $out == "setup: error: packages are missing: apt-get install gone lost" ]] || fail "sgm_need said: $out"
[[ -z $(calls) ]] || fail "sgm_need called apt-get"

out=$(sgm_setup_npm "$place/tools" validator 1.0.0)
[[ $out == *"validator 1.0.0"* ]] || fail "npm said: $out"
out=$(sgm_setup_npm "$place/tools" validator 1.0.0)
[[ -z $out ]] || fail "npm installed again"
if NETWORK=1 sgm_setup_npm "$place/tools" validator 2.0.0 >"$place/out" 2>"$place/err"; then
  fail "no error from npm without network"
fi
tail -n 1 "$place/err" | grep -q 'npm packages validator 2.0.0' || fail "the npm error was: $(cat "$place/err")"
echo "setup_test: all as it should be"
