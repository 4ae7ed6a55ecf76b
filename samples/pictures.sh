#!/usr/bin/env bash
# Draws pictures of samples in samples/images again, each from the view that it was made from.
#
#   samples/pictures.sh SGM [NAME]...    # with the command SGM; all of them, or those named
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

views='
basalt basalt.sgm --sharp --cell 0.1 --fov 60 --region 2,-1,12:30,20,46 --camera 3,2.9,16:11,1.7,22
building building.sgm --sharp --cell 0.05 --fov 46 --size 1280x960 --camera 20,12,28.5:1,8.2,0
castle castle.sgm --sharp --cell 0.2 --fov 50 --camera 46,28,50:0,1,0
city city.sgm --sharp --cell 0.4 --region -128,0,-600:128,120,-180 --camera 1,48,-172:0,26,-300
desert desert.sgm --cell 0.25 --fov 60 --region -10,-10,10:130,40,118 --camera 46,1.5,116:63,10,84
greuter table4/greuter.sgm --sharp --cell 0.5 --region -160,0,-760:160,150,-230 --camera 1,70,-225:0,40,-400
lava_tube lava_tube.sgm --cell 0.1 --fov 75 --light lamp --region 4,-5,24:90,14,56 --camera 26,0.2,40.6:40,-0.4,40.4
nave nave.sgm --sharp --cell 0.1 --fov 62 --region -15,-1,2:15,34,50 --camera 0,1.7,4:0,8.6,34
terrace terrace.sgm --sharp --cell 0.1 --fov 50 --size 1280x800 --region -4,-1,-24:140,40,14 --camera 16,7,25:60,12,-6
town town.sgm --sharp --cell 0.1 --fov 62 --region -8,-1,-8:34,20,30 --camera -3.5,1.7,22:15,5.2,9
valley valley.sgm --cell 0.4 --fov 66 --region 16,-6,-12:240,116,206 --camera 40,9,132:108,26,72
workings workings.sgm --cell 0.06 --fov 60 --region 8,11,8:14,16,44 --camera 10.8,13.5,16:11,13.1,30
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
  "$sgm" render "samples/grammars/$grammar" $options --max-chunks 200000 --out "samples/images/$name.png"
done <<<"$views"
