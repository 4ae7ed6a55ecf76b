# Tests a mixed load during a flight: for 45 s, or with SGM_LONG=1 for half an hour.
#   soak_test.sh SGM SOURCE NODE_MODULES FOLDER_FOR_THE_PLOT
plots=$4
source "$(dirname "$0")/common.sh"
need node nodejs

expect 0 "$SGM" mesh "$SOURCE/samples/grammars/sphere.sgm" --out sphere.glb
# Use a small world, which is complete after a few seconds, so that its memory is constant afterwards.
start_flight "$SOURCE/samples/grammars/sphere.sgm" --measure --frames 60 --keep-serving
checked "mixed load" node "$tests/soak_test.mjs" "$base" "$operations" "$service" sphere.glb \
  "${SGM_SOAK_SECONDS:-$([[ -n ${SGM_LONG:-} ]] && echo 1800 || echo 45)}" "$plots"
stop_service
finish
