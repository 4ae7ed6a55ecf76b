#!/usr/bin/env bash
# The examples of the manual, samples/grammars/README.md, and their pictures.
#
#   samples/manual.sh extract FOLDER    # each ```sgm NAME OPTIONS... as FOLDER/NAME.sgm, the options in NAME.options
#   samples/manual.sh draw SGM          # draws those that have changed with the command SGM, and notes what was drawn
#   samples/manual.sh changed           # the names of those whose picture is of another text; status 1 where there are some
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
manual=$root/samples/grammars/README.md images=$root/samples/images/manual

extract() {
  mkdir -p "$1/table4"
  cp -r "$root/samples/grammars/table4/assets" "$1/table4"
  awk -v folder="$1" '
    /^```sgm / { name = $2; file = folder "/" name ".sgm"; options = $0; sub(/^```sgm [^ ]+ ?/, "", options)
                 print options > (folder "/" name ".options"); printf "" > file; inside = 1; next }
    /^```/     { inside = 0; next }
    inside     { print > file }' "$manual"
}

# What a picture is of.
hash_of() { cat "$1.sgm" "$1.options" | sha256sum | cut -d ' ' -f 1; }

changed() {
  local folder file name found=0
  folder=$(mktemp -d)
  extract "$folder"
  for file in "$folder"/*.sgm; do
    name=$(basename "$file" .sgm)
    if [[ ! -f $images/$name.png ]] || ! grep -qsx "$name $(hash_of "${file%.sgm}")" "$images/drawn.txt"; then
      echo "$name"
      found=1
    fi
  done
  rm -rf "$folder"
  return $found
}

draw() {
  local sgm=$1 folder name options
  folder=$(mktemp -d)
  extract "$folder"
  mkdir -p "$images"
  for name in $(changed || true); do
    read -r -a options <"$folder/$name.options" || true
    [[ " ${options[*]-} " == *" --cell "* ]] || options+=(--cell 0.05)
    [[ " ${options[*]-} " == *" --fov "* ]] || options+=(--fov 34)
    [[ " ${options[*]-} " == *" --volume "* ]] || options+=(--sharp)
    "$sgm" render "$folder/$name.sgm" "${options[@]}" --size 480x270 --max-chunks 200000 --out "$images/$name.png"
    { grep -sv "^$name " "$images/drawn.txt" || true; echo "$name $(hash_of "$folder/$name")"; } | sort >"$folder/drawn.txt"
    cp "$folder/drawn.txt" "$images/drawn.txt"
  done
  rm -rf "$folder"
}

case ${1-} in
  extract) extract "$2" ;;
  draw) draw "$2" ;;
  changed) changed ;;
  *) sed -n '2,6s/^# \{0,1\}//p' "$0" && exit 2 ;;
esac
