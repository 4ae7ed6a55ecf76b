#!/usr/bin/env bash
# Tests the small build of the command (SGM_TOOLS=core): its commands must work; others must be refused by name.
#
#   core_test.sh SGM SOURCE WHOLE_SGM
whole=$3
source "$(dirname "$0")/common.sh"
lists() { grep -qE "^ +$1( |\$)" <<<"$out"; }
expect 0 "$SGM" --help
for command in check fmt explain mesh measure render fly backends; do
  lists "$command" || failed "help does not list $command"
done
# A core build must refuse every command that only the whole build has, with any arguments.
core=$out
left_out=0
expect 0 "$whole" --help
for command in inspect $(sed -n '/^Subcommands:/,$s/^  \([a-z]\+\) .*/\1/p' <<<"$out"); do
  ! grep -qE "^ +$command( |\$)" <<<"$core" || continue
  left_out=$((left_out + 1))
  for more in "" --help file.sgm; do
    # shellcheck disable=SC2086
    expect 2 "$SGM" "$command" $more
    err_has "^sgm: usage: this build of sgm leaves out '$command': configure it with SGM_TOOLS=all"
  done
done
((left_out == 10)) || failed "$left_out commands are left out, not 10"
expect 2 "$SGM" chek
err_has "there is no command 'chek': did you mean 'check'\\?"

cp "$SOURCE/samples/grammars/sphere.sgm" .
expect 0 "$SGM" check sphere.sgm
expect 0 "$SGM" mesh sphere.sgm --out sphere.glb
expect 0 "$SGM" measure sphere.glb --strict
expect 0 "$SGM" fly sphere.sgm --frames 5 --unpaced
expect 2 "$SGM" fly sphere.sgm --frames 5 --unpaced --serve
err_has "^sgm: usage: this build of sgm leaves out '--serve': configure it with SGM_TOOLS=all"
finish
