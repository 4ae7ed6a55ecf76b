#!/usr/bin/env bash
# Tests sgm inspect, the process that validates an upload for the metrics service: its report must equal those of
# measure and classify, and for unreadable input it must name the place of the error.
source "$(dirname "$0")/common.sh"
export XDG_DATA_HOME=$work/.data

# judge FILE OPTIONS...: runs sgm inspect on FILE; writes the JSON to .out (for the function json) and the preview to
# .preview.
judge() {
  last="inspect ${*:2} <$1"
  "$SGM" inspect "${@:2}" <"$1" >.frame 2>.err
  status=$?
  err=$(<.err)
  [[ $status == 0 && -z $err ]] || failed "status 0 and no complaint expected"
  node -e '
    const fs = require("fs"), all = fs.readFileSync(".frame"), json = Number(all.readBigUInt64LE(0));
    const preview = Number(all.readBigUInt64LE(8 + json));
    if (all.length !== 16 + json + preview) process.exit(1);
    fs.writeFileSync(".out", all.subarray(8, 8 + json));
    fs.writeFileSync(".preview", all.subarray(16 + json));' || failed "the answer is not framed"
  out=$(<.out)
}
# judged FILE OPTIONS...: expects a report, and that its description of the preview matches the preview's bytes.
judged() {
  judge "$@"
  json 'typeof j.valid === "boolean" && j.status === undefined && j.measures.histogram.mode === "corrected" && j.measures.histogram.bins === 33'
  node -e '
    const fs = require("fs"), j = JSON.parse(fs.readFileSync(".out")), b = fs.readFileSync(".preview"), p = j.preview;
    if (p === null) process.exit(b.length === 0 ? 0 : 1);
    let fine = b.toString("latin1", 0, 8) === "SGMPREV1" && b.readUInt32LE(8) === p.points && b.readUInt32LE(12) === p.triangles;
    fine &&= b.length === 16 + 12 * p.points + 12 * p.triangles && p.triangles <= 60000 && p.of_triangles === j.measures.triangles;
    for (let i = 0; i < 3 * p.points; ++i) {
      const x = b.readFloatLE(16 + 4 * i);
      fine &&= x >= p.low[i % 3] && x <= p.high[i % 3];
    }
    for (let i = 0; i < 3 * p.triangles; ++i) fine &&= b.readUInt32LE(16 + 12 * p.points + 4 * i) < p.points;
    process.exit(fine ? 0 : 1);' || failed "the preview is not what the report says"
}
# refused FILE EXPRESSION OPTIONS...: expects a problem, as JSON, for which the JavaScript expression is true.
refused() {
  judge "$1" "${@:3}"
  json "j.type === 'about:blank' && j.title.length > 0 && j.detail.length > 0 && ($2)"
  [[ -s .preview ]] && failed "a problem has a preview"
}
# same FILE KIND OPTIONS...: checks that each member of the report equals the output of measure and classify.
same() {
  judged "$1" --kind "$2" --name "$1" "${@:3}"
  cp .out report.json
  expect 0 "$SGM" measure "$1" --json "${@:3}"
  cp .out measured.json
  expect 0 "$SGM" classify "$1" --json "${@:3}"
  cp .out classified.json
  last="same $*"
  node -e '
    const assert = require("assert"), read = (name) => JSON.parse(require("fs").readFileSync(name));
    const report = read("report.json"), measured = read("measured.json"), classified = read("classified.json");
    delete measured.seconds;
    delete report.measures.seconds;
    // Which backend was taken is not what it is about; a region says the same of itself to both.
    for (const json of [measured, report.measures]) delete json.backend;
    assert.deepStrictEqual(report.measures, measured);
    assert.deepStrictEqual(Object.keys(report.classification), Object.keys(classified).filter((k) => k in report.classification));
    for (const [name, value] of Object.entries(report.classification)) assert.deepStrictEqual(value, classified[name]);
    for (const name of ["class", "shares", "key", "classes", "limits", "masters"]) assert(name in report.classification);
    assert.strictEqual(report.classification_error, null);
    assert.deepStrictEqual(report.nearest_masters.map((m) => [m.class, m.name]), classified.classes.map((c) => [c.class, c.nearest]));
    for (const m of report.nearest_masters) assert(m.shares.length === classified.key.bins);' 2>&1 | head -c 1500 >.diff
  [[ -s .diff ]] && failed "the report differs: $(<.diff)"
}

ball >ball.sgm
for format in glb obj ply stl; do expect 0 "$SGM" mesh ball.sgm --cell 0.25 --out ball.$format; done
for format in glb obj ply stl; do
  same ball.$format $format
  last="report of ball.$format"
  cp report.json .out
  json 'j.valid && j.measures.watertight && j.preview.triangles === j.measures.triangles && j.preview.of_triangles > 1000'
done
# The mesh of a region whose border cuts the ball is open at the cut. Apart from that, it must be valid.
same ball.sgm sgm --cell 0.25
cp report.json .out
json 'j.valid && j.measures.cell === 0.25 && j.diagnostics.length === 0'
same ball.sgm sgm --cell 0.5 --region 0,0,0:16,16,16 --seed 3 --set radius=2.5m
cp report.json .out
json 'j.valid && !j.measures.valid && j.measures.cut_edges > 0 && j.measures.seed === 3'
same "$SOURCE/tests/bench/grammars/cave.sgm" sgm --region 64,64,64:128,128,128
judged ball.sgm --kind sgm --region 32,32,32:48,48,48
json '!j.valid && j.measures.triangles === 0 && j.preview === null && j.empty_because.length > 0'

# For a readable mesh that is no closed solid, defects must be reported with places.
awk '/^f / && !gone { gone = 1; next } { print }' ball.obj >hole.obj
judged hole.obj --kind obj
json '!j.valid && j.measures.open_edges === 3 && j.measures.places.length === 3 && j.measures.places.every(p => p.kind === "open_edge")'
: >empty.obj
printf 'v 0 0 0\n' >point.obj
for file in empty point; do
  judge $file.obj --kind obj
  json 'j.valid === false || j.status === 422'
done

# Writes and checks hand-made binary glTF files.
node "$SOURCE/tests/cli/make_glb.js"
judged good.glb --kind glb
json 'j.valid && j.measures.triangles === 4 && Math.abs(j.measures.volume - 1 / 6) < 1e-6'
judged hole.glb --kind glb
json '!j.valid && j.measures.open_edges === 3'
refused truncated.glb 'j.status === 422 && j.code === "bad_input" && /byte/.test(j.detail)' --kind glb
refused out_of_bounds.glb 'j.status === 422 && j.pointer === "/accessors/1" && /corner/.test(j.detail)' --kind glb
refused nan.glb 'j.status === 422 && j.pointer === "/accessors/0" && /not a number/.test(j.detail)' --kind glb
refused nan_bounds.glb 'j.status === 422' --kind glb
refused external.glb 'j.status === 422 && j.pointer === "/buffers/1"' --kind glb
refused elsewhere.glb 'j.status === 422 && j.pointer === "/buffers/0"' --kind glb
refused sparse_range.glb 'j.status === 422 && j.pointer.startsWith("/accessors/0/sparse")' --kind glb
refused count.glb 'j.status === 422 && j.pointer.startsWith("/accessors/1")' --kind glb

# Checks broken files of the other formats.
sed '5s/.*/v 1 nonsense 2/' ball.obj >bad.obj
refused bad.obj 'j.status === 422 && j.line === 5' --kind obj
printf 'v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n' >nan.obj
refused nan.obj 'j.status === 422 && j.line === 2' --kind obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >index.obj
refused index.obj 'j.status === 422 && j.line === 4' --kind obj
head -c 2000 ball.ply >bad.ply
refused bad.ply 'j.status === 422' --kind ply
head -c 2000 ball.stl >bad.stl
refused bad.stl 'j.status === 422' --kind stl
for kind in glb obj ply stl; do
  head -c 5000 /dev/urandom >noise
  judge noise --kind $kind
  json 'j.status === 422'
done
refused good.glb 'j.status === 422 && /for grammars/.test(j.detail)' --kind glb --cell 1

# Checks invalid grammars, and grammars that import files that they may not read.
printf 'sgm 1;\nunits m;\nstart Ball;\nrule Ball { sphere(3); }\n' >wrong.sgm
refused wrong.sgm 'j.status === 422 && j.line === 4 && j.column > 0 && j.diagnostics[0].line === 4 && j.diagnostics[0].severity === "error" && j.diagnostics[0].message.length > 0' --kind sgm
# These files are named pipes: a process that opened one of them would block for ever.
mkfifo secret.sgm asset.glb
for path in /etc/passwd ../x.sgm secret.sgm "$work/secret.sgm" asset.glb "$work/asset.glb" ../asset.glb nothing.sgm; do
  printf 'sgm 1;\nunits m;\nimport "%s" as A;\nstart Ball;\nrule Ball { sphere(3m); }\n' "$path" >import.sgm
  refused import.sgm 'j.status === 422 && j.line === 3 && /import/.test(j.detail) && j.diagnostics.length === 1' --kind sgm --name import.sgm
done
rm secret.sgm asset.glb
printf 'sgm 1;\nunits m;\nimport "std/rock.sgm" as rock;\nstart Ball;\nrule Ball { sphere(3m); }\n' >standard.sgm
judged standard.sgm --kind sgm
for wrong in --region=1,2 --region=0,0,0:0,1,1 --cell=0 --cell=-1 --cell=nan --cell=x --seed=-1 --seed=x --set=radius --set=radius=9m \
  --set=none=1 '--set=[radius=1m,x=2]' --region=0,0,0:90000,90000,90000 --region=-9e9,0,0:1,1,1; do
  refused ball.sgm 'j.status === 422 && j.code === "bad_input" && !/--/.test(j.detail)' --kind sgm "$wrong"
done
printf 'sgm 1;\nunits m;\ndomain infinite solid limestone;\nlayer maze cell 32m reach 4m { start Maze; }\nrule Maze { cut { sphere(3m); } }\n' >endless.sgm
judged endless.sgm --kind sgm --cell 1

# Exceeding a memory limit must be reported as an error of the service, not of the upload.
judge ball.obj --kind obj --memory 64
json 'j.valid || (j.status === 500 && j.code === "validator_limit")'
head -c 60000000 /dev/zero >zeros
refused zeros 'j.status === 500 && j.code === "validator_limit" && /64 MB/.test(j.detail)' --kind glb --memory 64
expect 0 "$SGM" mesh ball.sgm --cell 0.01 --region=-3.5,-3.5,-3.5:3.5,3.5,3.5 --out large.stl
{ "$SGM" inspect --kind stl --seconds 1 <large.stl >/dev/null; } 2>/dev/null
status=$? last="--seconds 1"
[[ $status == 152 ]] || failed "the end by SIGXCPU expected"
expect 0 "$SGM" mesh ball.sgm --cell 0.0205 --set radius=3.4m --out million.ply
judged million.ply --kind ply --name million.ply
json 'j.valid && j.measures.triangles > 900000 && j.preview.triangles <= 60000 && j.preview.triangles > 10000 && j.classification !== null'

# The limits must be set as hard limits, because a process can raise a soft limit itself.
mkfifo input
"$SGM" inspect --kind stl --seconds 7 <input >/dev/null &
inspecting=$!
exec 9>input
for ((i = 0; i < 500; ++i)); do
  grep -Eq '^Max open files +32 +32 ' /proc/$inspecting/limits && grep -Eq '^Max core file size +0 +0 ' /proc/$inspecting/limits && break
  sleep 0.02
done
last="the limits of the process"
grep -E '^Max (cpu time|file size|core file size|open files|address space)' /proc/$inspecting/limits | tr -s ' ' >limits
for limit in 'cpu time 7 8' 'file size 268435456 268435456' 'core file size 0 0' 'open files 32 32'; do
  grep -q "^Max $limit " limits || failed "a limit of $limit expected: $(<limits)"
done
# A build with a sanitizer has no memory limit (`unlimited`), since sanitizers map more memory than any limit would
# allow.
grep -Eq '^Max address space ([0-9]+|unlimited) \1 ' limits || failed "a hard limit of memory expected: $(<limits)"
exec 9>&-
wait $inspecting
rm input

# Lists the masters (reference histograms) and stores them again, which must not change a bit.
touch nothing
judge nothing --list-masters
json 'j.from === "built in" && !j.writable && j.masters.length > 100 && j.limits.length === 5'
cp .out listed.json
judge nothing --list-masters --masters base.db
json 'j.from === "built in" && j.writable'
judge listed.json --store-masters --masters base.db
json 'j.from === "base.db" && j.writable'
cp .out stored.json
judge stored.json --store-masters --masters base.db
cp .out again.json
last="the masters' way there and back"
node -e '
  const assert = require("assert"), read = (name) => JSON.parse(require("fs").readFileSync(name));
  const [listed, stored, again] = ["listed.json", "stored.json", "again.json"].map(read);
  for (const other of [stored, again])
    for (const part of ["masters", "limits"]) assert.deepStrictEqual(other[part], listed[part]);' || failed "they differ"
same ball.glb glb
judged ball.glb --kind glb --masters base.db
json 'j.classification.masters === "base.db"'
# put EXPRESSION POINTER: changes the masters by the JavaScript expression and stores them; expects an error at the JSON
# pointer POINTER, and an unchanged file.
put() {
  node -e '
    const fs = require("fs"), j = JSON.parse(fs.readFileSync("listed.json"));
    eval(process.argv[1]);
    fs.writeFileSync("put.json", JSON.stringify(j));' "$1"
  refused put.json "j.status === 422 && (j.pointer ?? '') === '$2' && j.detail.includes('$2')" --store-masters --masters base.db
}
put 'delete j.limits' ''
put 'j.masters = {}' /masters
put 'j.masters = []' /masters
put 'j.more = 1' ''
put 'j.masters[3].class = 5' /masters/3/class
put 'j.masters[3].class = "a\u0001"' /masters/3/class
put 'j.masters[3].class = "unknown"' /masters/3/class
put 'j.masters[3].name = "x".repeat(300)' /masters/3/name
put 'j.masters[4].name = j.masters[3].name; j.masters[4].class = j.masters[3].class' /masters/4/name
put 'j.masters[3].models = -1' /masters/3/models
put 'j.masters[3].models = 1.5' /masters/3/models
put 'j.masters[3].key.bins = 7' /masters/3/key
put 'j.masters[3].key.mode = "x"' /masters/3/key/mode
put 'j.masters[3].key.version += 1' /masters/3/key/version
put 'j.masters[3].shares.push(0)' /masters/3/shares
put 'j.masters[3].shares[7] = -1e-3' /masters/3/shares/7
put 'j.masters[3].shares[7] = null' /masters/3/shares/7
put 'j.masters[3].shares[0] += 1e-6' /masters/3/shares
put 'j.limits[0].mse = -1' /limits/0/mse
put 'delete j.limits[1].emd' /limits/1
put 'j.limits[1].key = j.limits[0].key' /limits/1/key
put 'j.masters = j.masters.filter(m => JSON.stringify(m.key) !== JSON.stringify(j.limits[1].key))' /limits/1/key
head -c 1000 listed.json >cut.json
refused cut.json 'j.status === 400 && j.code === "bad_json"' --store-masters --masters base.db
judge nothing --list-masters --masters base.db
cmp -s .out stored.json || failed "the base has changed"
echo text >damaged.db
refused nothing 'j.status === 500 && j.code === "masters_unusable"' --list-masters --masters damaged.db
refused listed.json 'j.status === 500 && j.code === "masters_unusable"' --store-masters --masters damaged.db
[[ $(<damaged.db) == text ]] || failed "the damaged base was changed"
judged ball.glb --kind glb --masters damaged.db
json 'j.valid && j.classification === null && j.classification_error.length > 0 && j.nearest_masters.length === 0'

# The command `inspect` is only for the service, so --help must not list it. It must report wrong usage to its caller.
expect 0 "$SGM" --help
[[ $out != *inspect* ]] || failed "help lists it"
expect 2 "$SGM" inspect
expect 2 "$SGM" inspect --kind gltf
expect 2 "$SGM" inspect --store-masters
expect 2 "$SGM" inspect --kind glb --memory 1
finish
