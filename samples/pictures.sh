#!/usr/bin/env bash
# Draws the pictures of buildings and cities in samples/images again, each from the view that it was made from.
#
#   samples/pictures.sh SGM [NAME]...    # with the command SGM; all of them, or those named
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

views='
building building.sgm --cell 0.05 --fov 46 --size 1280x960 --camera 20,12,28.5:1,8.2,0
castle castle.sgm --cell 0.2 --fov 50 --camera 46,28,50:0,1,0
city city.sgm --cell 0.4 --region -128,0,-600:128,120,-180 --camera 1,48,-172:0,26,-300
greuter table4/greuter.sgm --cell 0.5 --region -160,0,-760:160,150,-230 --camera 1,70,-225:0,40,-400
terrace terrace.sgm --cell 0.1 --fov 50 --size 1280x800 --region -4,-1,-24:140,40,14 --camera 16,7,25:60,12,-6
'

[[ -x ${1-} ]] || { sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 2; }
sgm=$1
shift
for name in "$@"; do
  grep -q "^$name " <<<"$views" || { echo "pictures.sh: error: there is no view '$name'" >&2; exit 2; }
done
while read -r name grammar options; do
  [[ -n $name && (-z ${1-} || " $* " == *" $name "*) ]] || continue
  # shellcheck disable=SC2086  # the options are words
  "$sgm" render "samples/grammars/$grammar" $options --sharp --max-chunks 200000 --out "samples/images/$name.png"
done <<<"$views"
