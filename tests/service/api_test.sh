# Tests that the service's HTTP interface matches its OpenAPI description.
#   api_test.sh SGM SOURCE NODE_MODULES
modules=$3
source "$(dirname "$0")/common.sh"
need node nodejs
for package in ajv ajv-formats @seriousme/openapi-schema-validator; do
  [[ -d $modules/$package ]] && continue
  echo "$package is not there: npm install --prefix ${modules%/node_modules} $package"
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || exit 1
  exit 77
done

expect 0 "$SGM" mesh "$SOURCE/samples/grammars/sphere.sgm" --out sphere.glb
echo 0123456789abcdef >token
start_service --token-file token
guarded=$service token_base=$base token_operations=$operations
start_flight "$SOURCE/tests/bench/grammars/cave.sgm" --measure --frames 600 --keep-serving --masters masters.db
for ((i = 0; i < 100; ++i)); do
  run curl -sS "$operations/metrics"
  [[ $out == *'sgm_worlds 1'* ]] && break
  sleep 0.1
done
checked "the interface" node "$tests/api_test.mjs" "$base" "$operations" "$token_base" "$token_operations" sphere.glb "$modules"
stop_service
service=$guarded
stop_service
finish
