#!/usr/bin/env bash
# Writes the reference page of the standard library, samples/grammars/library.md, from the comments in
# runtime/grammar/std, and draws a picture of each example, samples/images/library/PART.NAME.jpg.
#
#   samples/library.sh                        # prints the page
#   samples/library.sh write                  # writes the page to its file
#   samples/library.sh names                  # lists the examples with a picture, as PART.NAME
#   samples/library.sh missing                # lists the examples whose picture does not exist yet
#   samples/library.sh pictures SGM [NAME]... # draws the pictures with the command SGM: all of them, or those named
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
images=$root/samples/images/library

# noise.value returns a number and has no shape, so it has no picture.
shapeless='noise.value'

page() {
  cat <<'TEXT'
# The standard library

What each part is made of, in the words of its own text, with an example of each and its picture.
`import "std/karst.sgm" as karst;` brings a part. Lengths are metres, and behind `in` is the range that a call has to keep.
What is cut from rock is shown in a block that is sawn open. Whoever changes a comment or a head in `runtime/grammar/std`
writes this page anew with `samples/library.sh write`, and draws what looks different with `samples/library.sh pictures SGM`.
TEXT
  local part module
  for part in "$root"/runtime/grammar/std/*.sgm; do
    module=$(basename "$part" .sgm)
    printf '\n## std/%s.sgm\n' "$module"
    awk -v module="$module" -v shapeless="$shapeless" '
      function tell(  text, i) {
        text = ""
        for (i = 1; i <= lines; ++i) text = text (i > 1 ? "\n" : "") comment[i]
        return text
      }
      NR == 1 { next }
      /^\/\// { line = $0; sub(/^\/\/ ?/, "", line); comment[++lines] = line; next }
      !begun && lines { printf "\n%s\n", tell(); begun = 1; if ($0 !~ /^(rule|let|field|morphic) /) { lines = 0; next } }
      /^(rule|let|field|morphic) / && lines && comment[lines] ~ /^Example: / {
        name = $2
        sub(/\(.*/, "", name)
        head = $0
        sub(/ (when|else|weight|lod|minsize|depth) .*/, "", head)
        sub(/ *[{=:] *$/, "", head)
        if (head ~ /^(let|field) /) sub(/\) = .*/, ")", head)
        if (head ~ /^(rule|morphic) /) { sub(/\) [{:].*/, ")", head); sub(/ \{.*/, "", head) }
        example = comment[lines--]
        sub(/^Example: /, "", example)
        printf "\n### `%s`\n\n%s\n\n```text\n%s\n```\n", head, tell(), example
        name = module "." name
        if (name != shapeless) printf "![%s](../images/library/%s.jpg)\n", name, name
      }
      { lines = 0 }' "$part"
  done
}

# Prints PART, NAME and EXAMPLE, separated by tabs, of all examples with a picture.
examples() {
  awk -v shapeless="$shapeless" '
    FNR == 1 { module = FILENAME; sub(/.*\//, "", module); sub(/\.sgm$/, "", module); example = "" }
    /^\/\/ Example: / { example = $0; sub(/^\/\/ Example: /, "", example); next }
    /^(rule|let|field|morphic) / && example != "" {
      name = $2
      sub(/[^A-Za-z0-9_].*/, "", name)
      if (module "." name != shapeless) print module "\t" name "\t" example
    }
    { example = "" }' "$root"/runtime/grammar/std/*.sgm
}

names() { examples | awk -F '\t' '{ print $1 "." $2 }'; }

source "$root/samples/library_pictures.sh"

case ${1-} in
  '') page ;;
  write) page >"$root/samples/grammars/library.md" ;;
  names) names ;;
  missing) names | while read -r name; do [[ -f $images/$name.jpg ]] || echo "$name"; done ;;
  pictures)
    [[ -x ${2-} ]] || { echo 'library.sh: error: pictures needs the path of the command: samples/library.sh pictures SGM' >&2; exit 2; }
    draw_pictures "${@:2}"
    ;;
  *) sed -n '2,10s/^# \{0,1\}//p' "$0" && exit 2 ;;
esac
