# Sourced by all tests of the command. A test's first two arguments are SGM (the command) and SOURCE (the project
# folder).
set -uo pipefail
SGM=$1
SOURCE=$2
work=$(mktemp -d)
cleanup() { rm -rf "$work"; }
trap cleanup EXIT
cd "$work"
# Leaves the user's cache folder untouched, except for Mesa's shader cache, which is shared because compiling shaders
# takes long.
export MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-${XDG_CACHE_HOME:-${HOME:-}/.cache}} XDG_CACHE_HOME=$work/.cache
failures=0
status=0 out= err= last=

# run COMMAND...: runs the command; sets `status`, `out` (standard output) and `err` (standard error).
run() {
  "$@" >"$work/.out" 2>"$work/.err" </dev/null
  status=$?
  out=$(<"$work/.out")
  err=$(<"$work/.err")
  last="$*"
}
failed() {
  failures=$((failures + 1))
  printf 'FAILED: %s\n  command: %s\n  status: %s\n  stdout: %.600s\n  stderr: %.600s\n' "$1" "$last" "$status" "$out" "$err" >&2
}
# expect STATUS COMMAND...: runs the command and fails unless its exit status is STATUS.
expect() {
  local wanted=$1
  shift
  run "$@"
  [[ $status == "$wanted" ]] || failed "status $wanted expected"
}
out_has() { [[ $out =~ $1 ]] || failed "standard output lacks /$1/"; }
err_has() { [[ $err =~ $1 ]] || failed "standard error lacks /$1/"; }
out_empty() { [[ -z $out ]] || failed "standard output is not empty"; }
err_empty() { [[ -z $err ]] || failed "standard error is not empty"; }
# one_line: fails unless standard error is exactly one line.
one_line() { [[ $(grep -c . <<<"$err") == 1 ]] || failed "standard error is not one line"; }
# json EXPRESSION: fails unless this JavaScript expression is true, where j is the object parsed from standard output.
json() {
  node -e 'const j = JSON.parse(require("fs").readFileSync(process.argv[1], "utf8")); process.exit(eval(process.argv[2]) ? 0 : 1)' \
    "$work/.out" "$1" || failed "the JSON does not satisfy $1"
}
# only FILE...: fails unless the working folder contains exactly these files, not counting .out, .err and .cache.
only() {
  local wanted have
  wanted=$(printf '%s\n' "$@" | sort)
  have=$(find . -mindepth 1 -maxdepth 1 ! -name .out ! -name .err ! -name .cache -printf '%f\n' | sort)
  [[ $wanted == "$have" ]] || failed "the folder holds: ${have//$'\n'/ }; expected: ${wanted//$'\n'/ }"
}
finish() {
  ((failures == 0)) || { echo "$failures failed" >&2; exit 1; }
  echo "all passed"
}

ball() { printf 'sgm 1;\nunits m;\nparam radius = 3m in 1m..3.5m "radius";\nstart Ball;\nrule Ball { sphere(radius); mat marble; }\n'; }
