# Tests every bad input of the interface's table over real sockets: each gets the answer it should, and the service
# keeps working. (The status for a service without a validator cannot be tested with the command, which always sets
# itself as validator: unit tests cover it.)
source "$(dirname "$0")/common.sh"
need node nodejs

# group NAME OPTIONS...: starts a service with these options and runs this group of checks against it.
group() {
  local name=$1
  shift
  start_service "$@"
  checked "$name: sgm serve $*" node "$tests/bad_input_test.mjs" "$name" "$base" "$operations" "$service" "$PWD"
  stop_service
}

# Grammars that an upload must not import: one in the service's working folder, one in its parent.
ball >x.sgm
mkdir inner && cd inner || exit 1
cp ../x.sgm .
echo 0123456789abcdefXYZ >token
# A ball of 10 m in cells of 3 cm: a million triangles.
expect 0 "$SGM" mesh "$SOURCE/samples/grammars/sphere.sgm" --cell 0.03 --max-chunks 200000 --out million.glb
group http --upload-mb 1
group uploads
group token --token-file token
group masters --masters masters.db
group full --inspect-jobs 1 --inspect-waiting 1
group late --inspect-seconds 1
group cramped --inspect-mb 128
finish
