#!/usr/bin/env bash
# Redraws the pictures of the samples in samples/images, each with its original view.
#
#   samples/pictures.sh SGM [NAME]...    # draws with the command SGM: all pictures, or those named
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

views='
basalt basalt.sgm --sharp --cell 0.64 --pixels 3 --fov 60 --region=-16,-1,-30:124,24,400 --camera=-8,2.9,16:10,1.5,14
birger table4/birger.sgm --seed 3 --cell 10 --fov 52 --region=-800,700,-3200:3200,1150,0 --camera 1300,350,300:1250,560,-900
bouthors table4/bouthors.sgm --seed 3 --cell 4 --fov 42 --region=-1600,640,-1600:1600,1280,800 --camera 820,600,1050:330,800,250
branchwork branchwork.sgm --cell 0.64 --pixels 2 --seed 3 --fov 64 --light lamp --region -112,-4,15:-15,10,112 --camera=-59.4,1,55.2:-51,1.3,44.5
building building.sgm --sharp --cell 0.64 --pixels 3.5 --fov 56 --size 1280x960 --region -50,-3,-36:50,32,44 --camera 11.8,1.7,15.4:1.4,5.3,8.6
cabral table4/cabral.sgm --sharp --cell 0.64 --pixels 2.3 --fov 58 --region -34,-2,-20:50,25,20 --camera=-16,1.7,3.2:-1,4.4,-5.4
castle castle.sgm --sharp --cell 2.56 --pixels 2.5 --fov 38 --region -150,-14,-180:180,75,124 --camera 58,20,122:6,20,6
cave cave.sgm --cell 0.64 --pixels 2 --seed 8 --fov 64 --light lamp --region -10,-5,-10:85,14,85 --camera 32.6,0.4,31.2:43,1.2,42
city city.sgm --sharp --cell 0.64 --pixels 2.3 --fov 58 --seed 1 --region -50,-1,-100:46,40,18 --camera=-5.7,1.75,-4.4:2.2,4.2,-34
cloud cloud.sgm --seed 3 --cell 9 --fov 50 --region=-3000,900,-4000:2800,4300,2000 --camera 2300,620,2500:300,1080,-420
cui table4/cui.sgm --seed 3 --cell 0.64 --pixels 2 --fov 66 --light lamp --region 15,48,25:80,74,80 --camera 30.5,60.2,51.5:50,60,42
desert desert.sgm --cell 1.6 --pixels 2 --fov 60 --region=-10,-10,10:130,40,126 --camera 46,1.7,116:63,10,84
gkm table4/gkm.sgm --seed 3 --sharp --cell 1.28 --pixels 3.5 --fov 64 --region -520,-40,-720:300,660,10 --camera=-34,2.6,-66:-52,11,-96
greuter table4/greuter.sgm --sharp --cell 1.28 --pixels 3 --fov 60 --region 84,-1,-560:176,130,-368 --camera=132.6,1.75,-379:126.9,19,-440
houses houses.sgm --sharp --cell 0.64 --pixels 2.3 --fov 52 --region 84,-8,20:150,20,66 --camera=102.5,2.2,58.5:109.5,3.9,44
lake lake.sgm --cell 0.64 --pixels 2 --seed 3 --fov 66 --region -75,-8,-18:21,14,78 --camera=-27,0.8,44.5:-25,0.8,20
lava_tube lava_tube.sgm --cell 0.64 --pixels 2 --fov 64 --light lamp --region -20,-6,14:90,14,66 --camera 13,-0.8,44:36,-0.7,43
lipp table4/lipp.sgm --sharp --cell 0.64 --pixels 3 --fov 46 --region -50,-12,-40:50,20,30 --camera 13,-7.2,23.5:1,-2.8,7
muller table4/muller.sgm --sharp --cell 0.64 --pixels 3 --fov 52 --size 960x960 --region -50,-20,-30:44,24,44 --camera 14,-14.4,24:0,-6,7
nave nave.sgm --sharp --light sun --cell 0.64 --pixels 2.5 --fov 62 --region -15,-1,2:15,34,50 --camera 0,2.3,3.4:0,8.6,34
terrace terrace.sgm --sharp --cell 0.64 --pixels 2.3 --fov 56 --size 1280x800 --region 8,-1,-10:100,18,30 --camera=14.5,1.7,5.5:40,3.6,6.6
town town.sgm --sharp --cell 0.64 --pixels 2.3 --fov 58 --size 1280x800 --region -10,-1,-40:80,22,40 --camera 7.6,1.65,4.6:17.6,2.6,5.7
tree tree.sgm --seed 12 --cell 0.64 --pixels 4 --fov 48 --size 960x960 --region -44,-1.6,-60:44,18,16 --camera -5,1.6,13:0.2,4.6,0
tunnels tunnels.sgm --sharp --cell 0.64 --pixels 2 --fov 56 --region -56,-9,-40:56,16,50 --camera=-22,-4.1,17:-5,-1.2,-1
valley valley.sgm --cell 3.2 --pixels 2 --fov 66 --region 16,-6,-12:240,116,206 --camera 40,9,132:108,26,72
workings workings.sgm --sharp --cell 0.32 --pixels 2 --fov 50 --region 8,11,8:14,16,44 --camera 10.9,13.45,17.45:11,13.1,30
'

[[ -x ${1-} ]] || { sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 2; }
sgm=$1
shift
for name in "$@"; do
  grep -q "^$name " <<<"$views" || { echo "pictures.sh: error: there is no view '$name'" >&2; exit 2; }
done
while read -r name grammar options; do
  [[ -n $name && (-z ${1-} || " $* " == *" $name "*) ]] || continue
  # $options is unquoted on purpose, since it contains several options
  "$sgm" render "samples/grammars/$grammar" $options --max-chunks 200000 --out "samples/images/$name.png"
done <<<"$views"
