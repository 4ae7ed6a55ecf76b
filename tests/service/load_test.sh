# Tests a service with 1,000 concurrent clients, most of them hostile.
source "$(dirname "$0")/common.sh"
need node nodejs

expect 0 "$SGM" mesh "$SOURCE/samples/grammars/sphere.sgm" --out sphere.glb
start_service --upload-mb 1
checked "1,000 clients" node "$tests/load_test.mjs" "$base" "$operations" "$service" sphere.glb
stop_service
finish
