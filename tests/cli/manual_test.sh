#!/usr/bin/env bash
# The manual of the language, samples/grammars/README.md: its examples are right, in the one layout, and keep what they
# expect; each has a picture of just this text; every word, shape and function stands in one; its grammar is the parser's.
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

# A text that changes wants another picture.
mkdir -p copy/samples && cp -r "$SOURCE/samples/grammars" "$SOURCE/samples/manual.sh" "$SOURCE/samples/images" copy/samples/ 2>/dev/null
sed -i 's/^  cylinder(1m, 2m);/  cylinder(1m, 3m);/' copy/samples/grammars/README.md
run bash copy/samples/manual.sh changed
[[ $status == 1 && $out == first ]] || failed 'a changed example is not seen'

words() { sed -n "/ $1 = {/,/};/p" "$SOURCE/runtime/grammar/syntax/keywords.cpp" | grep -o '"[a-z]*"' | tr -d '"'; }
names() { grep -o "{\"[a-z0-9]*\", $1::" "$SOURCE/runtime/grammar/syntax/builtins.cpp" | grep -o '"[a-z0-9]*"' | tr -d '"' | sort -u; }
text=$(sed 's#//.*##' examples/*.sgm)
for word in $(words kKeywords) $(words kMeasures) $(words kBoxParts) $(names Primitive) $(names Builtin); do
  grep -qw "$word" <<<"$text" || failed "no example has the word $word"
done
# Units and ends of words that only tables have are no words of an example.
for word in $(words kClauseWords); do
  grep -qE "(^|[^a-z])$word([^a-z]|$)" "$manual" || failed "the manual has not the word $word"
done
# Its lists are those of the compiler and of the pictures: nothing is missing, and nothing else stands there.
same() { [[ $(sort -u <<<"$2") == "$(sort -u <<<"$3")" ]] || failed "the manual's list of $1 is another: $(diff <(sort -u <<<"$2") <(sort -u <<<"$3"))"; }
section() { sed -n "/^## $1\$/,/^## /p" "$manual"; }
same words "$(section Words | sed -n '/^```text$/,/^```$/p' | grep -v '`' | tr ' ' '\n')" "$(words kKeywords; words kUnavailable)"
same shapes "$(section Shapes | sed -n 's/^| \(`.*`\) |.*/\1/p' | grep -o '`[a-z]*(' | tr -d '`(')" "$(names Primitive)"
same functions "$(section Values | sed -n 's/^| \(`.*`\) |.*/\1/p' | grep -oE '`(c\.)?[a-z0-9]+\(' | sed 's/[`(]//g; s/^c\.//')" "$(names Builtin)"
same materials "$(section Rules | tr '\n' ' ' | sed 's/.*know these looks://; s/; each with a tint.*//' | grep -o '`[a-z_]*`' | tr -d '`')" \
  "$(grep -o '^    {"[a-z_]*", {' "$SOURCE/runtime/tools/materials/material.cpp" | grep -o '[a-z_]*')"
# The library's page is what the library says of itself, and all of it.
bash "$SOURCE/samples/library.sh" | cmp -s - "$SOURCE/samples/grammars/library.md" ||
  failed 'samples/grammars/library.md is of another library: samples/library.sh write'
[[ $(grep -c '^### ' "$SOURCE/samples/grammars/library.md") == $(cat "$SOURCE"/runtime/grammar/std/*.sgm | grep -c '^// Example: ') ]] ||
  failed 'the page of the library leaves some of it out'
# What has a shape has a picture beside it, and no picture is of what is no longer there. One number of a cell has none.
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
