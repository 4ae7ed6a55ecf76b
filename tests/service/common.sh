# Sourced by the tests of the metrics service: what tests/cli/common.sh has, and a service to test.
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$tests/../cli/common.sh"
started=()
cleanup() {
  ((${#started[@]} == 0)) || { kill "${started[@]}"; wait "${started[@]}"; } 2>/dev/null
  rm -rf "$work"
}

# need COMMAND PACKAGE: a skip where it is not there, an error where the machine was set up for it.
need() {
  command -v "$1" >/dev/null && return
  echo "$1 is not there: install the package $2"
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || exit 1
  exit 77
}

# url_in FILE WORD: waits for the line "WORD http://..." that a service prints, and prints the address without its path.
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

# start_service OPTIONS...: `sgm serve` on free ports; its addresses in `base` and `operations`, its process in `service`.
start_service() {
  rm -f service.out  # of an earlier one, whose addresses are not these
  "$SGM" serve --port 0 --operations-port 0 "$@" >service.out 2>service.err </dev/null &
  service=$!
  started+=("$service")
  base=$(url_in service.out page) && operations=$(url_in service.out metrics) || { cat service.err >&2; exit 1; }
}

# start_flight GRAMMAR OPTIONS...: the same of `sgm fly`, whose report comes to flight.out.
start_flight() {
  rm -f flight.err
  "$SGM" fly "$@" --serve --port 0 --operations-port 0 >flight.out 2>flight.err </dev/null &
  service=$!
  started+=("$service")
  base=$(url_in flight.err page) && operations=$(url_in flight.err metrics) || exit 1
}

# stop_service: as an operator does; it must end well.
stop_service() {
  local status=0
  kill -TERM "$service"
  wait "$service" || status=$?
  [[ $status == 0 ]] || { failures=$((failures + 1)); echo "FAILED: the service ended with status $status" >&2; }
}

# checked NAME COMMAND...: its output is shown; counts as one test.
checked() {
  local name=$1
  shift
  echo "-- $name"
  "$@" || { failures=$((failures + 1)); echo "FAILED: $name" >&2; }
}
