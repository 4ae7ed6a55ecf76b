# Tests a real Prometheus, with the configuration of samples/monitoring, which monitors a real flight.
source "$(dirname "$0")/common.sh"
need prometheus prometheus
need curl curl
need node nodejs
samples=$SOURCE/samples/monitoring
frames=900

# ask EXPRESSION: queries Prometheus; writes the answer to .out, as
# {"status":"success","data":{"result":[{"metric":{},"value":[time,"1"]}]}}.
ask() { run curl -sS --max-time 20 -G "$prometheus/api/v1/query" --data-urlencode "query=$1"; }
# value EXPRESSION: prints the value if the result has exactly one series, otherwise an empty line.
value() {
  ask "$1"
  node -pe 'const r = JSON.parse(require("fs").readFileSync(0)).data.result; r.length === 1 ? r[0].value[1] : ""' <.out
}
# wait_for EXPRESSION: waits up to two minutes until the expression has a value in Prometheus.
wait_for() {
  for ((i = 0; i < 240; ++i)); do
    [[ -n $(value "$1") ]] && return
    sleep 0.5
  done
  failed "Prometheus never saw $1"
  return 1
}
same() { [[ $2 == "$3" ]] || failed "$1: $2 is not $3"; }
# now_in FILE EXPRESSION: prints the value of a JavaScript expression, where j is the JSON in FILE.
now_in() {
  node -pe 'const j = JSON.parse(require("fs").readFileSync(process.argv[1])); eval(process.argv[2])' "$1" "$2"
}

start_flight "$SOURCE/tests/bench/grammars/cave.sgm" --measure --frames "$frames" --speed 60 --keep-serving --json
# Makes Prometheus scrape every second instead of every 5 s, and alert after 2 s without an answer.
sed "s/127\.0\.0\.1:9464/${operations#http://}/; s/: 5s$/: 1s/" "$samples/prometheus.yml" >prometheus.yml
sed '/up{job="sgm"}/,/for:/s/for: 1m/for: 2s/' "$samples/alerts.yml" >alerts.yml
for file in prometheus.yml alerts.yml; do cmp -s $file "$samples/$file" && failed "$file was not adjusted"; done
prometheus --config.file prometheus.yml --storage.tsdb.path data --web.listen-address 127.0.0.1:0 --log.level debug \
  >prometheus.out 2>&1 </dev/null &
started+=("$!")
for ((i = 0; i < 600; ++i)); do
  prometheus=$(sed -n 's/.*msg="Listening on" address=\(127[0-9.:]*\).*/http:\/\/\1/p' prometheus.out)
  [[ -n $prometheus ]] && curl -sf "$prometheus/-/ready" >ready && break
  sleep 0.1
done
[[ -s ready ]] || { cat prometheus.out >&2; exit 1; }

# These checks run during the flight.
wait_for 'up{job="sgm"} == 1'
wait_for 'sum(rate(sgm_chunks_built_total{result="meshed"}[5s])) > 0'
ball >ball.sgm
run curl -sS --max-time 60 --data-binary @ball.sgm -H 'Content-Type: text/x-sgm' "$base/api/v1/validate?cell=0.25"
json 'j.state === "done" && j.valid === true'

# These checks run after the flight, when all chunks are complete.
wait_for "sgm_world_update_seconds_count{world=\"cave\"} >= $frames"
wait_for 'sgm_world_idle == 1 and on (world) sum by (world) (sgm_queue_depth) == 0'
run curl -sS --max-time 20 "$base/api/v1/summary"
cp .out summary
wait_for "sgm_chunks_built_total{result=\"meshed\"} == $(now_in summary 'j.worlds[0].chunks.meshed')"
of_world() { same "$1" "$(value "$1")" "$(now_in summary "j.worlds[0].$2")"; }
of_world sgm_chunks_drawn chunks.drawn
of_world sgm_chunks_kept chunks.kept
of_world 'sgm_chunks_built_total{result="in_vain"}' chunks.in_vain
of_world 'sgm_chunks_built_total{result="failed"}' chunks.failed
of_world sgm_frames_total frame
of_world sgm_world_update_seconds_count update.count
of_world sgm_mesh_bytes memory.mesh_bytes
of_world sgm_mesh_peak_bytes memory.peak_mesh_bytes
of_world sgm_mesh_limit_bytes memory.mesh_limit_bytes
of_world sgm_detail_ratio detail
of_world sgm_triangles measures.triangles
of_world 'sum(sgm_mesh_defects_total)' measures.defects_total
same "defects" "$(value 'sum(sgm_mesh_defects_total)')" 0
same "kinds of defects" "$(value 'count(sgm_mesh_defects_total)')" 13
of_world 'sum(sgm_chunk_build_seconds_count)' chunks.meshed
same area "$(value 'round(sgm_surface_area_square_meters)')" \
  "$(now_in summary 'Math.round(j.worlds[0].measures.area_square_meters)')"
wait_for 'sgm_validations_total{result="valid"} == 1 and on () sgm_validation_seconds_count == 1'
# A busy machine may exceed a scrape's deadline of a second; no other error of a scrape is allowed.
grep -a "Scrape failed" prometheus.out | grep -v "context deadline exceeded" >broken
[[ ! -s broken ]] || failed "scrapes broke off: $(<broken)"
[[ -n $(value 'avg_over_time(up{job="sgm"}[10m]) > 0.8') ]] || failed "more than one scrape in five came too late"
[[ $(value 'max_over_time(sum(rate(sgm_chunks_built_total{result="meshed"}[5s]))[10m:1s])') != 0 ]] || failed "no rate"

# All expressions of the dashboard must have values.
count=0
while IFS= read -r expression; do
  ask "$expression"
  json 'j.status === "success" && j.data.result.length > 0'
  count=$((count + 1))
done < <(node "$tests/dashboard.mjs" expressions "$samples/dashboard.json" 30s)
((count > 40)) || failed "only $count expressions were asked"

# All alerts must be loaded without errors, and none may fire.
run curl -sS --max-time 20 "$prometheus/api/v1/rules?type=alert"
json "j.data.groups.flatMap((g) => g.rules).length === $(grep -c -- '- alert:' "$samples/alerts.yml")"
json 'j.data.groups.flatMap((g) => g.rules).every((r) => r.health === "ok" && r.state !== "firing")'

# Prometheus' last values must equal those in the flight's own report. After the flight has ended, the alert for a
# missing service must fire.
meshed=$(value 'sgm_chunks_built_total{result="meshed"}')
updates=$(value sgm_world_update_seconds_count)
stop_service
same "chunks of the report" "$meshed" "$(now_in flight.out j.chunks_meshed)"
same "frames of the report" "$updates" "$(now_in flight.out j.frames)"
same "defects of the report" 0 \
  "$(now_in flight.out 'Object.values(j.measures.made.defects).reduce((a, b) => a + b)')"
wait_for 'ALERTS{alertname="SgmServiceDown",alertstate="firing"}'
run curl -sS --max-time 20 "$prometheus/api/v1/alerts"
json 'j.data.alerts.filter((a) => a.state === "firing").every((a) => a.labels.alertname === "SgmServiceDown")'
json "j.data.alerts.some((a) => a.annotations.summary === '${operations#http://} does not answer')"
finish
