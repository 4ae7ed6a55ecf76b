#!/usr/bin/env bash
# Tests sgm classify and sgm masters: classes of grammars and mesh files, unknown objects, and the database file of
# reference histograms ("masters").
source "$(dirname "$0")/common.sh"
export XDG_DATA_HOME=$work/.data
# Use the grammars of tests/bench/grammars, which never change; the current samples are tested below.
grammars=$SOURCE/tests/bench/grammars
only_here() { [[ ! -e $XDG_DATA_HOME ]] || failed "something was written to the base's place"; }

for command in classify masters 'masters build' 'masters list'; do
  expect 0 "$SGM" $command --help
  out_has 'Example:'
done

# Classifies grammars. If no database of masters exists, none must be written.
classes() {  # classes CLASS GRAMMAR OPTIONS...: fails unless the grammar is classified as CLASS
  expect 0 "$SGM" classify "$grammars/$2" --json "${@:3}"
  err_empty
  json "j.class === '$1' && j.reason === null && j.margin > 0 && j.margin <= 1 && j.second_opinion.length > 0"
}
classes building storeys.sgm --cell 0.5 --seed 77
json 'j.classes.length === 6 && j.classes[0].class === "building" && j.classes[0].mse <= j.classes[1].mse'
json 'j.classes.every(c => c.mse >= 0 && c.emd >= 0 && c.emd <= 1 && c.nearest.startsWith(c.class))'
json 'j.masters === "built in" && j.key.mode === "curvature" && j.key.density === null && j.key.normals === "smooth, outward"'
json 'j.shares.length === j.key.bins && Math.abs(j.shares.reduce((a, b) => a + b) - 1) < 1e-12 && j.edges > 1000'
classes cave cave.sgm --region 64,64,64:160,160,160 --cell 1 --seed 77
classes cloud table4/bouthors.sgm --cell 8 --seed 77
# Tests samples with seeds from which no reference histogram was made. Standard error is not checked, because it has
# hints for a tree.
for sample in cave/cave cave/branchwork cave/lake cave/table4/cui terrain/desert building/city tree/tree; do
  expect 0 "$SGM" classify "$SOURCE/samples/grammars/${sample#*/}.sgm" --cell 0.5 --seed 77 --json
  json "j.class === '${sample%%/*}'"
done
expect 0 "$SGM" classify "$grammars/storeys.sgm" --set floors=11 --set convex=0.9
out_has 'storeys\.sgm: building, by a margin of 0\.[0-9]+'
out_has 'cloud +0\.[0-9]+ +0\.[0-9]+  cloud [0-9]+, most like '
out_has 'reference histograms: built in, for mode curvature, 65 bins, curvature length 1 m, any density'
only_here

# A mesh file in any format must have the class of its grammar; values may differ only by the rounding of positions to
# float32.
expect 0 "$SGM" mesh "$grammars/storeys.sgm" --cell 0.5 --out storeys.glb
for format in obj ply stl; do expect 0 "$SGM" mesh "$grammars/storeys.sgm" --cell 0.5 --out storeys.$format; done
expect 0 "$SGM" classify "$grammars/storeys.sgm" --cell 0.5 --json
error=$(node -p 'JSON.parse(require("fs").readFileSync(".out")).classes[0].mse')
for format in glb obj ply stl; do
  expect 0 "$SGM" classify storeys.$format --json
  json "j.class === 'building' && Math.abs(j.classes[0].mse - $error) < 1e-6"
done

# The paper's two modes depend on the density (cells per metre). It is known for a grammar; a mesh file needs --ld.
for mode in printed corrected; do
  classes building storeys.sgm --cell 0.5 --mode $mode
  json 'j.key.density === 2 && j.key.curvature_length === null'
  expect 0 "$SGM" classify storeys.glb --mode $mode --ld 2 --json
  json 'j.class === "building"'
  expect 1 "$SGM" classify storeys.glb --mode $mode
  one_line
  err_has '--ld'
  expect 1 "$SGM" classify storeys.glb --mode $mode --ld 3
  one_line
  err_has 'no reference histograms for mode .* at 3 cells per metre; there are some for: '
done

# Noise must be unknown, and objects without an edge to measure must be reported.
cat >noise.sgm <<'END'
sgm 1;
units m;
domain infinite solid limestone;
layer maze cell 32m reach 1m { start Maze; }
rule Maze { cut { ca(1m, fill 50%, rounds 0, threshold 50%, radius 1); } }
END
expect 0 "$SGM" classify noise.sgm --region 0,0,0:32,32,32 --cell 0.5 --json
json 'j.class === "unknown" && /most like noise|more than/.test(j.reason)'
expect 0 "$SGM" classify noise.sgm --region 0,0,0:32,32,32 --cell 0.5
out_has 'noise\.sgm: unknown: (the|it is most like) '
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
expect 0 "$SGM" classify one.obj --json
json 'j.class === "unknown" && /no edge/.test(j.reason) && j.edges === 0'

# Files that cannot be classified must be refused.
expect 4 "$SGM" classify none.glb
one_line
echo 'Dear Sir or Madam' >letter.txt
expect 1 "$SGM" classify letter.txt
err_has 'letter.txt: the mesh format is unsupported; use .glb'
one_line
printf 'glTF and nothing else' >bad.glb
expect 1 "$SGM" classify bad.glb
one_line
expect 2 "$SGM" classify storeys.glb --mode other
only_here

# Builds a database of masters and uses it.
expect 0 "$SGM" masters list --json
json 'j.masters === "built in" && j.keys.length === 5 && j.keys.every(k => new Set(k.masters.map(m => m.class)).size === 6)'
json 'j.keys.every(k => k.limits.mse > 0 && k.limits.emd > 0)'
json 'j.keys.every(k => k.masters.every(m => Math.abs(m.shares.reduce((a, b) => a + b) - 1) < 1e-9))'
expect 0 "$SGM" masters list
out_has 'built in: [0-9]+ reference histograms'
expect 0 "$SGM" masters build --help
only_here
expect 0 "$SGM" masters build --models 2 --out base.db --emit base.inc
out_has 'base\.inc: base\.db: [0-9]+ reference histograms of [0-9]+ models'
expect 0 "$SGM" masters list base.db --json
json 'j.masters === "base.db" && j.keys.length === 5'
expect 0 "$SGM" classify storeys.glb --masters base.db --json
json 'j.class === "building" && j.masters === "base.db"'
[[ $(stat -c %s base.inc) -gt 10000 ]] || failed 'base.inc is short'
[[ -z $(ls base.db-* 2>/dev/null) ]] || failed 'logs of the base are left'

# A damaged database that the user names must not be moved; a file that is no database must not be overwritten.
head -c 5000 base.db >cut.db
for command in "classify storeys.glb --masters cut.db" "masters list cut.db" "masters build --out cut.db"; do
  expect 1 "$SGM" $command
  one_line
done
[[ $(stat -c %s cut.db) == 5000 ]] || failed 'cut.db was changed'
expect 4 "$SGM" masters list none.db
expect 4 "$SGM" classify storeys.glb --masters none.db

# A damaged database at the default path must be moved aside, and this must be reported once.
mkdir -p "$XDG_DATA_HOME/sgm"
base=$XDG_DATA_HOME/sgm/masters.db
cp cut.db "$base"
expect 0 "$SGM" classify storeys.glb --json
err_has 'warning: .*masters\.db was damaged \(.*\): it is named .*masters\.db\.damaged-1 now'
json 'j.class === "building" && j.masters.endsWith("/sgm/masters.db")'
cmp -s cut.db "$base.damaged-1" || failed 'the damaged base is lost'
expect 0 "$SGM" classify storeys.glb --json
err_empty
cp base.db "$base"
expect 0 "$SGM" masters list --json
json 'j.masters.endsWith("/sgm/masters.db")'
finish
