#!/usr/bin/env bash
# Tests the manual of the language, samples/grammars/README.md. Its examples must be valid, formatted, and satisfy their
# expectations; each must have a picture made from exactly its text. Every keyword, shape and function must occur in an
# example. The printed grammar must be the parser's.
source "$(dirname "$0")/common.sh"
manual=$SOURCE/samples/grammars/README.md

bash "$SOURCE/samples/manual.sh" extract examples || failed 'the examples cannot be taken out'
count=0
for file in examples/*.sgm; do
  count=$((count + 1))
  expect 0 "$SGM" fmt --check "$file"
  expect 0 "$SGM" check --expect --max-chunks 1000000 "$file"
  ! grep -qE 'warning|error|note' <<<"$err" || failed "$file is not without a word"
  name=$(basename "$file" .sgm)
  grep -qx "!\[$name\](../images/manual/$name.png)" "$manual" || failed "$name has no picture in the manual"
done
((count >= 30)) || failed "only $count examples"
run bash "$SOURCE/samples/manual.sh" changed
[[ $status == 0 ]] || failed 'pictures are of other texts: samples/manual.sh draw SGM draws them'

# If the text of an example has changed, the check must ask for a new picture.
mkdir -p copy/samples && cp -r "$SOURCE/samples/grammars" "$SOURCE/samples/manual.sh" "$SOURCE/samples/images" copy/samples/ 2>/dev/null
sed -i 's/^  cylinder(1m, 2m);/  cylinder(1m, 3m);/' copy/samples/grammars/README.md
run bash copy/samples/manual.sh changed
[[ $status == 1 && $out == first ]] || failed 'a changed example is not seen'

words() { sed -n "/ $1 = {/,/};/p" "$SOURCE/runtime/grammar/syntax/keywords.cpp" | grep -o '"[a-z]*"' | tr -d '"'; }
# A keyword that begins a statement is a reserved word, unless it is in the table kClauseWords.
keywords() {
  words kOtherKeywords
  sed -n 's/^SGM_STMT([a-z_]*, "\([a-z]\+\)".*/\1/p' "$SOURCE/runtime/grammar/syntax/stmts.def" | grep -vxF "$(words kClauseWords)"
}
(($(keywords | wc -l) >= 60)) || failed "only $(keywords | wc -l) keywords"
names() { grep -o "{\"[a-z0-9]*\", $1::" "$SOURCE/runtime/grammar/syntax/builtins.cpp" | grep -o '"[a-z0-9]*"' | tr -d '"' | sort -u; }
text=$(sed 's#//.*##' examples/*.sgm)
for word in $(keywords) $(words kMeasures) $(words kBoxParts) $(names Primitive) $(names Builtin); do
  grep -qw "$word" <<<"$text" || failed "no example has the word $word"
done
# Units and suffixes that occur only in tables of the manual need not occur in an example.
for word in $(words kClauseWords); do
  grep -qE "(^|[^a-z])$word([^a-z]|$)" "$manual" || failed "the manual has not the word $word"
done
# The manual's lists must be equal to the lists in the compiler and to the list of pictures.
same() { [[ $(sort -u <<<"$2") == "$(sort -u <<<"$3")" ]] || failed "the manual's list of $1 is another: $(diff <(sort -u <<<"$2") <(sort -u <<<"$3"))"; }
section() { sed -n "/^## $1\$/,/^## /p" "$manual"; }
same words "$(section Words | sed -n '/^```text$/,/^```$/p' | grep -v '`' | tr ' ' '\n')" "$(keywords; words kUnavailable)"
same shapes "$(section Shapes | sed -n 's/^| \(`.*`\) |.*/\1/p' | grep -o '`[a-z]*(' | tr -d '`(')" "$(names Primitive)"
same functions "$(section Values | sed -n 's/^| \(`.*`\) |.*/\1/p' | grep -oE '`(c\.)?[a-z0-9]+\(' | sed 's/[`(]//g; s/^c\.//')" "$(names Builtin)"
same materials "$(section Rules | tr '\n' ' ' | sed 's/.*know these looks://; s/; each with a tint.*//' | grep -o '`[a-z_]*`' | tr -d '`')" \
  "$(grep -o '^    {"[a-z_]*", {' "$SOURCE/runtime/tools/materials/material.cpp" | grep -o '[a-z_]*')"
# The page of the standard library must be what samples/library.sh generates from the library's sources.
bash "$SOURCE/samples/library.sh" | cmp -s - "$SOURCE/samples/grammars/library.md" ||
  failed 'samples/grammars/library.md is of another library: samples/library.sh write'
[[ $(grep -c '^### ' "$SOURCE/samples/grammars/library.md") == $(cat "$SOURCE"/runtime/grammar/std/*.sgm | grep -c '^// Example: ') ]] ||
  failed 'the page of the library leaves some of it out'
# Every rule or function of the library must have a picture, and every picture must belong to one of them; functions
# that return one number per cell need none.
pictured=$(bash "$SOURCE/samples/library.sh" names | sort)
there=$(cd "$SOURCE/samples/images/library" && printf '%s\n' *.jpg | sed 's/\.jpg$//' | sort)
[[ $pictured == "$there" ]] || failed "pictures of the library: samples/library.sh pictures SGM draws them: $(diff <(echo "$pictured") <(echo "$there"))"
[[ $(grep -c . <<<"$pictured") == $(($(grep -c '^### ' "$SOURCE/samples/grammars/library.md") - 1)) ]] ||
  failed 'more than one of the library has no picture'
[[ $(grep -o '(\.\./images/library/[^)]*\.jpg)' "$SOURCE/samples/grammars/library.md" | sed 's#.*/##; s#\.jpg)$##' | sort) == "$pictured" ]] ||
  failed 'the page of the library does not show all of its pictures'
sed -n '/^```ebnf$/,/^```$/p' "$manual" | sed '1d;$d' | cmp -s - "$SOURCE/runtime/grammar/grammar.ebnf" ||
  failed 'the grammar in the manual is not runtime/grammar/grammar.ebnf'
finish
