# Sourced by all tests of the metrics service: adds functions that start and stop a service to those of
# tests/cli/common.sh.
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$tests/../cli/common.sh"
started=()
cleanup() {
  ((${#started[@]} == 0)) || { kill "${started[@]}"; wait "${started[@]}"; } 2>/dev/null
  rm -rf "$work"
}

# need COMMAND PACKAGE: if the command is missing, skips the test, or fails if SGM_REQUIRE_ALL is set.
need() {
  command -v "$1" >/dev/null && return
  echo "$1 is not there: install the package $2"
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || exit 1
  exit 77
}

# url_in FILE WORD: waits until FILE contains the line "WORD http://..." of a service, and prints the address without
# its path.
url_in() {
  local url
  for ((i = 0; i < 600; ++i)); do
    url=$(sed -n "s#^$2 \(http://[^/]*\)/.*#\1#p" "$1" 2>/dev/null)
    [[ -z $url ]] || { echo "$url"; return; }
    sleep 0.1
  done
  echo "FAILED: no service came up; it said: $(head -c 600 "$1")" >&2
  return 1
}

# start_service OPTIONS...: starts `sgm serve` on free ports; sets `base` and `operations` to its addresses, and
# `service` to its process.
start_service() {
  rm -f service.out  # removes the output of an earlier service, which has other addresses
  "$SGM" serve --port 0 --operations-port 0 "$@" >service.out 2>service.err </dev/null &
  service=$!
  started+=("$service")
  base=$(url_in service.out page) && operations=$(url_in service.out metrics) || { cat service.err >&2; exit 1; }
}

# start_flight GRAMMAR OPTIONS...: same as start_service, for `sgm fly --serve`, whose standard output goes to
# flight.out.
start_flight() {
  rm -f flight.err
  "$SGM" fly "$@" --serve --port 0 --operations-port 0 >flight.out 2>flight.err </dev/null &
  service=$!
  started+=("$service")
  base=$(url_in flight.err page) && operations=$(url_in flight.err metrics) || exit 1
}

# stop_service: ends the service by a signal, as an operator would; fails unless it exits normally.
stop_service() {
  local status=0
  kill -TERM "$service"
  wait "$service" || status=$?
  [[ $status == 0 ]] || { failures=$((failures + 1)); echo "FAILED: the service ended with status $status" >&2; }
}

# checked NAME COMMAND...: runs the command as one test, which passes if the command succeeds, and shows its output.
checked() {
  local name=$1
  shift
  echo "-- $name"
  "$@" || { failures=$((failures + 1)); echo "FAILED: $name" >&2; }
}
