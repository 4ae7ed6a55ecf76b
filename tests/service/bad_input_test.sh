# Tests every row of the table of bad input over real sockets: each must get the documented response, and the service
# must keep working. (The status of a service without a validator cannot be tested with the command, which always sets
# itself as the validator: unit tests cover it.)
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

# Creates grammars that an upload must not import: one in the service's working folder, one in its parent.
ball >x.sgm
mkdir inner && cd inner || exit 1
cp ../x.sgm .
echo 0123456789abcdefXYZ >token
# Makes a mesh of a million triangles: a ball of 10 m in cells of 3 cm.
expect 0 "$SGM" mesh "$SOURCE/samples/grammars/sphere.sgm" --cell 0.03 --max-chunks 200000 --out million.glb
group http --upload-mb 1
group uploads
group token --token-file token
group masters --masters masters.db
group full --inspect-jobs 1 --inspect-waiting 1
group late --inspect-seconds 1
group cramped --inspect-mb 128
finish
