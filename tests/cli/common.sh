# Sourced by the tests of the command: SGM and SOURCE come as the first two arguments of each.
set -uo pipefail
SGM=$1
SOURCE=$2
work=$(mktemp -d)
cleanup() { rm -rf "$work"; }
trap cleanup EXIT
cd "$work"
# What the command keeps for its user is not the user's here; what the driver keeps is, for it takes long to make.
export MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-${XDG_CACHE_HOME:-${HOME:-}/.cache}} XDG_CACHE_HOME=$work/.cache
failures=0
status=0 out= err= last=

# run COMMAND...: its status, standard output and standard error in `status`, `out`, `err`.
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
# expect STATUS COMMAND...
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
# One line that says what is wrong, and no more.
one_line() { [[ $(grep -c . <<<"$err") == 1 ]] || failed "standard error is not one line"; }
# json EXPRESSION: of the object on standard output, called j, must be true.
json() {
  node -e 'const j = JSON.parse(require("fs").readFileSync(process.argv[1], "utf8")); process.exit(eval(process.argv[2]) ? 0 : 1)' \
    "$work/.out" "$1" || failed "the JSON does not satisfy $1"
}
# only FILE...: nothing else is in the working folder (but for what these functions keep).
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
