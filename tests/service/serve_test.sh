# Tests starting and ending sgm serve and sgm fly --serve, as users do.
source "$(dirname "$0")/common.sh"
need curl curl

get() { curl -sS --max-time 20 "$@"; }

start_service
[[ $(get "$operations/healthz") == ok ]] || failed "/healthz"
run get "$operations/readyz"
json 'j.ready === true && j.checks.some((c) => c.name === "validator" && c.ok)'
run get "$base/"
out_has '<!doctype html>'
run get "$base/api/v1/summary"
json 'j.worlds.length === 0 && j.service.validator === true'
ball >ball.sgm
expect 0 "$SGM" mesh ball.sgm --cell 0.25 --out ball.glb
run get --data-binary @ball.glb -H 'Content-Type: model/gltf-binary' "$base/api/v1/validate?name=ball.glb"
json 'j.state === "done" && j.valid === true && j.name === "ball.glb" && j.measures.watertight === true'
run get --data-binary @ball.sgm -H 'Content-Type: text/x-sgm' "$base/api/v1/validate?cell=0.25&set=radius=2m"
json 'j.state === "done" && j.valid === true && j.measures.volume > 30 && j.measures.volume < 35'
# If the ports are already in use, there must be an error.
work_port=${base##*:}
expect 4 "$SGM" serve --port "$work_port" --operations-port 0
one_line
err_has "$work_port"
stop_service
run get "$base/"
[[ $status != 0 ]] || failed "it still listens"

# A service that listens on other addresses than localhost must have a token.
expect 1 "$SGM" serve --listen 0.0.0.0 --port 0 --operations-port 0
one_line
err_has token
expect 4 "$SGM" serve --token-file nowhere --port 0 --operations-port 0
one_line
echo >empty
expect 1 "$SGM" serve --token-file empty --port 0 --operations-port 0
one_line
err_has token
echo 'too short' >short
expect 1 "$SGM" serve --token-file short --port 0 --operations-port 0
one_line
echo 0123456789abcdefXYZ >token
"$SGM" serve --port 0 --operations-port 0 --json >said </dev/null &
service=$!
started+=("$service")
for ((i = 0; i < 100; ++i)); do [[ -s said ]] && break || sleep 0.1; done
run cat said
json 'j.work.startsWith("http://127.0.0.1:") && j.operations.startsWith("http://127.0.0.1:") && j.work !== j.operations'
stop_service
start_service --token-file token
[[ $(curl -s -o answer -w '%{http_code}' "$base/api/v1/summary") == 401 ]] || failed "no token was asked for"
[[ $(curl -s -o answer -w '%{http_code}' "$operations/metrics") == 401 ]] || failed "no token was asked for /metrics"
[[ $(curl -s -o answer -w '%{http_code}' "$operations/healthz") == 200 ]] || failed "/healthz asked for a token"
run get -H 'Authorization: Bearer 0123456789abcdefXYZ' "$base/api/v1/summary"
json 'j.version'
stop_service

# Sends requests during a flight; the flight's report must be printed at its end.
start_flight "$SOURCE/tests/bench/grammars/cave.sgm" --measure --frames 240 --keep-serving --json
for ((i = 0; i < 300; ++i)); do
  run get "$operations/metrics"
  [[ $out =~ sgm_world_update_seconds_count\{world=\"cave\"\}\ ([0-9]+) && ${BASH_REMATCH[1]} -ge 240 ]] && break
  sleep 0.2
done
run get "$base/api/v1/summary"
json 'j.worlds.length === 1 && j.worlds[0].chunks.meshed > 10 && j.worlds[0].measures.defects_total === 0'
json 'j.worlds[0].update.count >= 240 && j.worlds[0].viewers.length === 1'
run get "$base/api/v1/worlds/cave/chunks"
json 'j.total === j.chunks.length && j.total > 10 && !j.truncated'
run get "$operations/metrics"
out_has 'sgm_chunks_built_total\{world="cave",backend="cpu",result="meshed"\} [1-9]'
out_has 'sgm_world_update_seconds_count\{world="cave"\} [1-9]'
stop_service
cp flight.out .out
json 'j.frames === 240'

# A signal must end a flight before its last frame.
start_flight "$SOURCE/tests/bench/grammars/cave.sgm" --frames 3000 --keep-serving --json
for ((i = 0; i < 300; ++i)); do
  run get "$operations/metrics"
  [[ $out =~ sgm_world_update_seconds_count\{world=\"cave\"\}\ ([0-9]+) && ${BASH_REMATCH[1]} -ge 10 ]] && break
  sleep 0.1
done
stop_service
grep -q 'no report' flight.err || failed "it does not say that there is no report"
[[ ! -s flight.out ]] || failed "there is a report of a flight that was not flown"

# --keep-serving and --port must be refused without --serve.
expect 2 "$SGM" fly "$SOURCE/tests/bench/grammars/cave.sgm" --keep-serving
expect 2 "$SGM" fly "$SOURCE/tests/bench/grammars/cave.sgm" --port 1
finish
