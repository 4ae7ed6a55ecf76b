#!/usr/bin/env bash
# Extracts the examples of the manual, samples/grammars/README.md, and draws their pictures.
#
#   samples/manual.sh extract FOLDER    # writes each block ```sgm NAME OPTIONS... to FOLDER/NAME.sgm and NAME.options
#   samples/manual.sh draw SGM          # draws the changed examples with the command SGM, and records their hashes
#   samples/manual.sh changed           # prints the examples that changed since they were drawn; status 1 if any did
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

# The hash of an example and its options, which tells whether its picture is up to date.
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
