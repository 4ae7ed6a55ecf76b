#!/usr/bin/env bash
# Tests sgm check and sgm fmt: messages with their places, JSON, and formatting.
source "$(dirname "$0")/common.sh"

ball >ball.sgm
expect 0 "$SGM" check ball.sgm
out_has '^ball.sgm: ok$'
err_empty
expect 0 "$SGM" check --json ball.sgm
json 'j.ok === true && j.files.length === 1 && j.files[0].file === "ball.sgm" && j.files[0].diagnostics.length === 0'
json 'j.files[0].parameters[0].name === "radius" && j.files[0].parameters[0].default === 3 && j.files[0].parameters[0].range[1] === 3.5'
json '/^[0-9a-f]{16}$/.test(j.files[0].hash) && j.files[0].materials[0] === "marble" && j.files[0].layers[0].name === "main"'
expect 0 "$SGM" check "$SOURCE"/samples/grammars/*.sgm

# If a file has bytes that are not UTF-8, there must be one error, at the first of them, and the JSON must be valid
# nevertheless.
printf 'sgm 1;\nparam a = 1m in 1m..2m "na\xefve"; // \xe9\nstart R;\nrule R { sphere(a); }\n' >latin1.sgm
expect 1 "$SGM" check latin1.sgm
err_has 'latin1.sgm:2:27: error: this byte is not UTF-8'
err_has 'note: 1 more byte of this file is not UTF-8'
expect 1 "$SGM" check --json latin1.sgm
json 'j.files[0].diagnostics.map(d => d.line + ":" + d.column).join() === "2:27"'

# For errors whose cause is hard to see, such as UTF-16 or a division by zero in a constant, there must be one error
# that names the cause.
printf '\xff\xfes\0g\0m\0 \0001\0;\0' >utf16.sgm
printf 'sgm 1;\nstart A;\nlet z = 0;\nrule A { sphere(1m/z); }' >divzero.sgm
printf 'sgm 1;\nstart A;\nrule A weight -1 { sphere(1m); }\nrule A weight 2 { box(1m); }' >weight.sgm
for case in 'utf16.sgm:1:1: error: the text is UTF-16, not UTF-8' 'divzero.sgm:4:20: error: division by zero: `z` is 0 here' \
  'weight.sgm:3:15: error: a weight is 0 or more, and this is -1'; do
  expect 1 "$SGM" check "${case%%:*}"
  err_has "$case"
  out_has '1 error, 0 warnings'
done

# A library, such as the standard library, is valid without a start rule; a world needs a start rule.
printf 'sgm 1;\nrule Post(h) { cylinder(0.1*h, h); }\n' >library.sgm
expect 0 "$SGM" check library.sgm "$SOURCE"/runtime/grammar/std/*.sgm
out_has '^library.sgm: ok, a library without a start'
out_has 'cloud.sgm: ok, a library without a start'
err_empty
expect 0 "$SGM" check --json --expect library.sgm
json 'j.files[0].library === true && j.files[0].rules === 1'
expect 1 "$SGM" mesh library.sgm --out library.glb --region 0,0,0:8,8,8
err_has 'nothing says where derivation starts'
printf 'sgm 1;\nrule Post(h) { cylinder(h, 1); }\n' >library.sgm
expect 1 "$SGM" check library.sgm
err_has 'library.sgm:2:28: error: '
cp ball.sgm "$(printf 'b\xe4ll.sgm')"
expect 0 "$SGM" check --json "$(printf 'b\xe4ll.sgm')"
json 'j.files[0].file === "b\ufffdll.sgm"'

# With several files, the exit status must be the highest of their statuses, and the messages of every file must be
# printed, even if one file cannot be read.
for order in "none.sgm latin1.sgm ball.sgm" "ball.sgm latin1.sgm none.sgm"; do
  # shellcheck disable=SC2086
  expect 4 "$SGM" check --json $order
  json 'j.files.every(f => Array.isArray(f.diagnostics))'
  # shellcheck disable=SC2086
  expect 4 "$SGM" fmt --check $order
done
# The message must give the reason why a file cannot be read.
ln -s round.sgm round.sgm
expect 4 "$SGM" check round.sgm
err_has 'round.sgm: Too many levels of symbolic links'
rm round.sgm

# bad NAME LINE COLUMN TEXT: checks the grammar TEXT; expects status 1 and the message "NAME.sgm:LINE:COLUMN: error:
# ...", followed by the source line and a caret below the column.
bad() {
  printf '%s\n' "$4" >"$1.sgm"
  expect 1 "$SGM" check "$1.sgm"
  local at=$1.sgm:$2:$3
  grep -q "^$at: error: ." <<<"$err" || failed "no error at $at"
  local line
  line=$(sed -n "$2p" "$1.sgm")
  grep -qF "$line" <<<"$err" || failed "the source line is not shown"
  grep -q '\^' <<<"$err" || failed "no caret"
  expect 1 "$SGM" check --json "$1.sgm"
  json "j.ok === false && j.files[0].ok === false && j.files[0].diagnostics.some(d => d.severity === 'error' && d.line === $2 && d.column === $3)"
  expect 1 "$SGM" mesh "$1.sgm" --out "$1.glb" --region 0,0,0:8,8,8
  grep -q "^$at: error: ." <<<"$err" || failed "no error at $at"
  [[ ! -e $1.glb ]] || failed "a file was left"
  out_empty
}
bad syntax 3 17 $'sgm 1;\nstart R;\nrule R { sphere 3m; }'
bad unknown_rule 2 7 $'sgm 1;\nstart Nowhere;\nrule R { sphere(3m); }'
bad unknown_name 3 17 $'sgm 1;\nstart R;\nrule R { sphere(raduis); }'
bad unit_mismatch 3 17 $'sgm 1;\nstart R;\nrule R { sphere(30deg); }'
bad field_in_guard 3 13 $'sgm 1;\nstart R;\nrule R when p.y < 3m { sphere(3m); }'
bad recursion 3 25 $'sgm 1;\nstart R;\nrule R { at(1m, 0m, 0m) R; }'
bad reach 4 26 $'sgm 1;\ndomain infinite;\nlayer main cell 16m reach 2m { start R; }\nrule R { at(20m, 0m, 0m) sphere(1m); }'
bad missing_import 2 8 $'sgm 1;\nimport "none.sgm" as none;\nstart R;\nrule R { sphere(3m); }'

# For an unknown name, the message must suggest the most similar name.
printf 'sgm 1;\nstart Chambr;\nrule Chamber { sphere(3m); }\n' >typo.sgm
expect 1 "$SGM" check typo.sgm
err_has 'did you mean .?Chamber'

# One run must report several errors.
printf 'sgm 1;\nstart R;\nrule R { sphere(3deg); box(no_such); }\n' >two.sgm
expect 1 "$SGM" check two.sgm
[[ $(grep -c ': error: ' <<<"$err") == 2 ]] || failed "two errors expected"

# Files that cannot be grammars: random bytes, an empty file, a folder, and a missing file.
head -c 4096 /dev/urandom >noise.sgm
expect 1 "$SGM" check noise.sgm
: >empty.sgm
expect 1 "$SGM" check empty.sgm
expect 4 "$SGM" check none.sgm
one_line
expect 4 "$SGM" check .
one_line
head -c 3000000 /dev/zero | tr '\0' ' ' >huge.sgm
expect 1 "$SGM" check huge.sgm
expect 2 "$SGM" check
expect 2 "$SGM"
expect 2 "$SGM" frobnicate
expect 2 "$SGM" check --no-such-option ball.sgm

# Imports must not leave the folder of the grammar.
mkdir inner
printf 'sgm 1;\nlet width() = 2m;\n' >outside.sgm
printf 'sgm 1;\nimport "../outside.sgm" as o;\nstart R;\nrule R { sphere(o.width()); }\n' >inner/up.sgm
ln -s ../outside.sgm inner/link.sgm
printf 'sgm 1;\nimport "link.sgm" as o;\nstart R;\nrule R { sphere(o.width()); }\n' >inner/through.sgm
expect 1 "$SGM" check inner/up.sgm
expect 1 "$SGM" check inner/through.sgm

# sgm fmt must be idempotent, write a file only if it changes, and check the grammar.
for grammar in "$SOURCE"/samples/grammars/*.sgm; do
  cp "$grammar" sample.sgm
  expect 0 "$SGM" fmt --write sample.sgm
  cp sample.sgm first.sgm
  expect 0 "$SGM" fmt sample.sgm
  diff -q "$work/.out" first.sgm >/dev/null || failed "fmt of its own output differs"
  expect 0 "$SGM" fmt --check sample.sgm
done
printf 'sgm 1;units m;start   R;rule R{sphere( 3m );}' >ugly.sgm
expect 1 "$SGM" fmt --check ugly.sgm
chmod 640 ugly.sgm
ln -s ugly.sgm link.sgm
expect 0 "$SGM" fmt --write link.sgm
[[ -L link.sgm && $(stat -c %a ugly.sgm) == 640 ]] || failed "the link or the mode was lost"
expect 0 "$SGM" fmt --check ugly.sgm
expect 1 "$SGM" fmt syntax.sgm
expect 4 "$SGM" fmt --write none.sgm
expect 2 "$SGM" fmt --write --check ball.sgm
finish
