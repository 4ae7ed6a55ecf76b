#!/usr/bin/env bash
# The standard library's own page, samples/grammars/library.md, from the comments in runtime/grammar/std.
#
#   samples/library.sh          # prints the page
#   samples/library.sh write    # writes it where it belongs
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

page() {
  cat <<'END'
# The standard library

What each part is made of, in the words of its own text, with an example of each. `import "std/karst.sgm" as karst;` brings a
part. Lengths are metres, and behind `in` is the range that a call has to keep. Whoever changes a comment or a head in
`runtime/grammar/std` writes this page anew: `samples/library.sh write`.
END
  local part module
  for part in "$root"/runtime/grammar/std/*.sgm; do
    module=$(basename "$part" .sgm)
    printf '\n## std/%s.sgm\n' "$module"
    awk '
      function tell(  text, i) {
        text = ""
        for (i = 1; i <= lines; ++i) text = text (i > 1 ? "\n" : "") comment[i]
        return text
      }
      NR == 1 { next }
      /^\/\// { line = $0; sub(/^\/\/ ?/, "", line); comment[++lines] = line; next }
      !begun && lines { printf "\n%s\n", tell(); begun = 1; if ($0 !~ /^(rule|let|field|morphic) /) { lines = 0; next } }
      /^(rule|let|field|morphic) / && lines && comment[lines] ~ /^Example: / {
        head = $0
        sub(/ (when|else|weight|lod|minsize|depth) .*/, "", head)
        sub(/ *[{=:] *$/, "", head)
        if (head ~ /^(let|field) /) sub(/\) = .*/, ")", head)
        if (head ~ /^(rule|morphic) /) { sub(/\) [{:].*/, ")", head); sub(/ \{.*/, "", head) }
        example = comment[lines--]
        sub(/^Example: /, "", example)
        printf "\n### `%s`\n\n%s\n\n```text\n%s\n```\n", head, tell(), example
      }
      { lines = 0 }' "$part"
  done
}

case ${1-} in
  '') page ;;
  write) page >"$root/samples/grammars/library.md" ;;
  *) sed -n '2,5s/^# \{0,1\}//p' "$0" && exit 2 ;;
esac
