# Tests samples/monitoring: with promtool, and that its expressions use only metrics that exist.
source "$(dirname "$0")/common.sh"
need promtool prometheus
need curl curl
need node nodejs
samples=$SOURCE/samples/monitoring

checked "configuration" promtool check config "$samples/prometheus.yml"
checked "alerts" promtool check rules "$samples/alerts.yml"
checked "alerts fire and do not fire" promtool test rules "$tests/alerts_test.yml"
for alert in $(sed -n 's/.*- alert: //p' "$samples/alerts.yml"); do
  grep -q "alertname=\"$alert\"" "$tests/alerts_test.yml" || failed "nobody tests that $alert fires"
done
node "$tests/dashboard.mjs" rules "$samples/dashboard.json" >dashboard_rules.yml || failed "the dashboard is not read"
checked "the dashboard's expressions" promtool check rules dashboard_rules.yml

# Gets /metrics of a real flight, after requests on both of its ports.
start_flight "$SOURCE/tests/bench/grammars/cave.sgm" --measure --frames 60 --keep-serving
for ((i = 0; i < 300; ++i)); do
  curl -sS --max-time 20 "$base/api/v1/summary" -o summary && curl -sS --max-time 20 "$operations/metrics" -o metrics
  grep -q '^sgm_parallel_speedup_ratio' metrics && grep -q '^sgm_http_requests_total{port="operations"' metrics && break
  sleep 0.2
done
checked "/metrics" promtool check metrics <metrics
checked "what is asked for is there" \
  node "$tests/dashboard.mjs" check metrics "$samples/dashboard.json" "$samples/alerts.yml"
# The dashboard uses some metrics that only worlds on a GPU have. Check that the service's source contains their names.
for name in sgm_gpu_memory_bytes sgm_device_lost_total; do
  grep -q "\"$name\"" "$SOURCE/runtime/tools/service/watch/metrics_text.cpp" || failed "the service has no $name"
done
stop_service

# Negative test: the check must find errors in a damaged dashboard.
wrong() {  # wrong SED_SCRIPT WHAT: damages the dashboard by SED_SCRIPT; the check must report WHAT
  sed "$1" "$samples/dashboard.json" >wrong.json
  cmp -s wrong.json "$samples/dashboard.json" && failed "$1 changes nothing"
  expect 1 node "$tests/dashboard.mjs" check metrics wrong.json "$samples/alerts.yml"
  out_has "$2"
}
wrong 's/sgm_queue_depth/sgm_queue_length/' 'no sgm_queue_length'
wrong 's/result=\\"failed/result=\\"broken/' 'no result broken'
wrong 's/by (world, kind)/by (world, sort)/' 'no label sort'
wrong 's/{{stage}}/{{step}}/' "legend's step"
wrong 's/"x": 8,/"x": 7,/' 'lies on'
wrong 's/"id": 7,/"id": 6,/' "another panel's"
wrong 's/,world=~\\"$world\\"/,world=~\\"$planet\\"/' 'no variable planet'
wrong 's/sgm_edits/sgm_triangles/' 'sgm_edits: is in /metrics, but nobody'
finish
