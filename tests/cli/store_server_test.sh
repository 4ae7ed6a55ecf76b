#!/usr/bin/env bash
# Tests a world streamed from a store on a real web server: the world must be the same whether the server works,
# disappears, or never existed.
source "$(dirname "$0")/common.sh"
nginx=$(PATH=$PATH:/usr/sbin command -v nginx) || {
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || { echo "nginx is missing: install the package nginx-light" >&2; exit 1; }
  echo "skipped: nginx is not installed"
  exit 77
}
# Connect to this machine directly, without a proxy.
unset http_proxy https_proxy all_proxy HTTP_PROXY HTTPS_PROXY ALL_PROXY
cave=$SOURCE/tests/bench/grammars/cave.sgm
expect 0 "$SGM" bake "$cave" --seed 3 --region 0,0,0:192,160,192 --levels 0..5 --backend cpu --out public/caves/store

stop_serving() { kill -TERM "$server" 2>/dev/null; wait "$server" 2>/dev/null; }
# serve: starts nginx on a free port; sets `address` to the store's URL.
serve() {
  local user='' port try i
  ((EUID != 0)) || user='user root;'  # nginx runs as root, too, since only root may read the folder
  for ((try = 0; try < 5; ++try)); do
    port=$((20000 + RANDOM % 20000))
    cat >"$work/nginx.conf" <<END
$user daemon off; pid $work/nginx.pid; error_log $work/nginx.log; worker_processes 1;
events { worker_connections 64; }
http {
  access_log $work/access.log; default_type application/octet-stream;
  client_body_temp_path $work/t1; proxy_temp_path $work/t2; fastcgi_temp_path $work/t3; uwsgi_temp_path $work/t4; scgi_temp_path $work/t5;
  server { listen 127.0.0.1:$port; root $work/public;
    location /moved/ { rewrite ^/moved/(.*)$ /caves/store/\$1 redirect; }
    location /secret/ { return 401; } }
}
END
    "$nginx" -p "$work" -c "$work/nginx.conf" 2>"$work/nginx.err" &
    server=$!
    for ((i = 0; i < 100; ++i)); do
      kill -0 "$server" 2>/dev/null || break
      curl -fs -o /dev/null "http://127.0.0.1:$port/caves/store/format" && address=http://127.0.0.1:$port/caves/store && return
      sleep 0.05
    done
    stop_serving
  done
  failed "nginx does not start: $(cat "$work/nginx.err")"
  finish
  exit 1
}
server=
cleanup() { [[ -z $server ]] || stop_serving; rm -rf "$work"; }
serve

printf '{"points": [[40, 60, 60], [110, 96, 96], [120, 96, 100]]}' >path.json
flight=(fly "$cave" --seed 3 --path path.json --speed 60 --frames 150 --finest 16 --top-level 5 --view 120 --unpaced --check
  --backend cpu --json)
hash_of() { node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).world_hash' "$work/.out"; }
expect 0 "$SGM" "${flight[@]}" --edits 4 --store public/caves/store
json 'j.open_edges === 0 && j.stores.hits > 500'
hash=$(hash_of)
hits=$(node -p 'JSON.parse(require("fs").readFileSync(process.argv[1])).stores.hits' "$work/.out")

# While the server works, parts must load as from a folder, with far fewer requests than parts.
expect 0 "$SGM" "${flight[@]}" --edits 4 --store "$address/"
json "j.world_hash === '$hash' && j.open_edges === 0 && j.stores.hits > $hits * 0.9 && j.stores.damaged === 0"
err_empty
[[ $(grep -c ' 206 ' access.log) -gt 5 && $(grep -c ' 206 ' access.log) -lt $((hits / 4)) ]] ||
  failed "$(grep -c ' 206 ' access.log) requests for $hits parts"
# If the store has moved, redirections must be followed.
expect 0 "$SGM" "${flight[@]}" --edits 4 --store "${address%/caves/store}/moved"
json "j.world_hash === '$hash' && j.stores.hits > 500"
err_empty

# If the store is missing or forbidden, one line must be reported, and the world must be the same.
for place in "${address%/store}/nothing" "${address%/caves/store}/secret"; do
  expect 0 "$SGM" "${flight[@]}" --edits 4 --store "$place"
  json "j.world_hash === '$hash' && j.open_edges === 0 && j.stores.hits === 0"
  err_has 'chunks are derived instead'
  one_line
done

# With a cache folder, parts that were loaded once must be read from there.
expect 0 "$SGM" "${flight[@]}" --edits 4 --store "$address" --cache cache
json "j.world_hash === '$hash' && j.stores.hits > 500"
stop_serving
expect 0 "$SGM" "${flight[@]}" --edits 4 --store "$address" --cache cache
json "j.world_hash === '$hash' && j.open_edges === 0 && j.stores.hits === 0 && j.cache.hits > 100"
err_has 'cannot be read \(.*chunks are derived instead; the server is asked again'
one_line
# Here the server never runs, so all chunks must be derived.
expect 0 "$SGM" "${flight[@]}" --edits 4 --store "$address"
json "j.world_hash === '$hash' && j.open_edges === 0 && j.stores.hits === 0 && j.stores.damaged === 0"
one_line
# The server disappears and comes back during a flight that has begun to read from it.
serve
: >access.log
paced=()
for word in "${flight[@]}"; do [[ $word == --unpaced ]] || paced+=("$word"); done
"$SGM" "${paced[@]}" --edits 4 --store "$address" >"$work/.out" 2>"$work/.err" </dev/null &
flying=$!
for ((i = 0; i < 200; ++i)); do
  [[ $(grep -c ' 206 ' access.log) -gt 4 ]] && break
  sleep 0.02
done
stop_serving
wait "$flying"
status=$? out=$(<"$work/.out") err=$(<"$work/.err") last="a flight whose server goes"
[[ $status == 0 ]] || failed "status 0 expected"
json "j.world_hash === '$hash' && j.open_edges === 0 && j.stores.hits > 0"

# Invalid addresses must be refused with a one-line message.
for place in http:// "http://host/a?b" "https://me:secret@host/ä" "HTTPS://me:secret@host/#" ftp://me:secret@host/x; do
  expect 1 "$SGM" fly "$cave" --frames 1 --unpaced --store "$place"
  err_has 'is not an address of a store'
  one_line
  [[ $err != *secret* ]] || failed "a password is told"
done
for command in "store verify" "store gc" "bake $cave --region 0,0,0:8,8,8 --out"; do
  # shellcheck disable=SC2086
  expect 1 "$SGM" $command https://me:secret@host/x
  err_has 'is on a server: pass a folder'
  one_line
  [[ $err != *secret* ]] || failed "a password is told"
done
[[ ! -e https: ]] || failed "a folder was made"
finish
