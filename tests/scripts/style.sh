#!/usr/bin/env bash
# Searches the source tree for forbidden content: arithmetic that violates the arithmetic contract, absolute paths of
# one machine, addresses of package servers, marks of unfinished work, and files that are too long. Also checks that the
# README's program is that of the tested sample, and that its list of packages is what the scripts install.
#
#   bash tests/scripts/style.sh [ROOT]
set -euo pipefail
cd "${1:-.}"
failed=0

complain() {  # complain WHAT MATCHES: if MATCHES is not empty, prints both, and the script fails
  [[ -z $2 ]] && return
  printf 'style: %s\n%s\n' "$1" "$2" >&2
  failed=1
}
tracked() { git ls-files -co --exclude-standard -- "$@" ':!tests/scripts/style.sh'; }
# search PATTERN PATHS...: prints matches in tracked text files. A path without such files is an error, since the rule
# would otherwise check nothing.
search() {
  local pattern=$1 path
  shift
  for path in "$@"; do
    [[ $path == ':!'* || $path == '*'* || -n $(tracked "$path" | head -n 1) ]] || echo "$path: there is no such file"
  done
  tracked "$@" | xargs -r -d '\n' grep -nIE -- "$pattern" 2>/dev/null || true
}
code=('*.cpp' '*.h' '*.hpp' '*.c' '*.comp' '*.vert' '*.frag' '*.glsl' '*.cu' '*.cuh' '*.inc' '*.def')
build=('*CMakeLists.txt' '*.cmake' '*.json' '*.sh')

complain "the arithmetic contract forbids fused, approximate and vendor functions (hwy: Mul and Add, our own sqrt)" \
  "$(search '\b(MulAdd|NegMulAdd|MulSub|NegMulSub|MulAddSub|ApproximateReciprocal|ApproximateReciprocalSqrt|_mm[0-9]*_f[n]?m(add|sub)[a-z_]*)\(' "${code[@]}")"
complain "no fma in anything that feeds derived data" \
  "$(search '\b(std::)?fmaf?\(' 'runtime/**' 'shaders/**' 'cuda/**')"
complain "the kernels of shaders/common use + - * and integers alone" \
  "$(search '\b(fma|mad|sqrt|sqrtf|rsqrt|inversesqrt|exp|exp2|pow|sin|cos|tan|atan|log|log2|normalize|length|fract|mod)\(' 'shaders/common/*.h' | grep -vE ':[0-9]+: *(//|\*)' || true)"
complain "no value-changing optimisation" \
  "$(search '(-ffast-math|-Ofast|/fp:fast|use_fast_math|-funsafe-math|-fassociative-math)' "${code[@]}" "${build[@]}")"
complain "unfinished marks" "$(search '\b(TODO|FIXME|XXX|HACK)\b' "${code[@]}" "${build[@]}" '*.md')"
complain "paths of one machine" "$(search '(^|[^[:alnum:]_.$}*])/(work|home|farm|root|Users)/' .)"
complain "package hosts: packages come by name from the machine's own clients" \
  "$(search '\b(deb\.debian\.org|archive\.ubuntu\.com|registry\.npmjs\.org|pypi\.org|crates\.io)' .)"
# Exceptions: the C interface is a single header, which is also its manual; the table of built-in reference histograms
# is generated.
complain "files over 1,000 lines" \
  "$(tracked "${code[@]}" '*.sh' '*.py' ':!runtime/include/sgm/sgm.h' \
    ':!runtime/tools/classify/built_in_masters.inc' | xargs -r -d '\n' wc -l | awk '$2 != "total" && $1 > 1000')"
complain "a test begins from testSeed() (tests/unit/seed.h), which is the same in every run but the long one" \
  "$(search 'random_device' 'tests/**' ':!tests/unit/seed.h')"
# Exception: field/reference.* only checks the results of the kernels.
complain "libm in code that feeds derived data: use base/math.h (std::sqrt, floor, fabs are exact)" \
  "$(search '\bstd::(sin|cos|tan|asin|acos|atan|atan2|exp|exp2|log|log2|pow|cbrt|hypot|fma)f?\(' \
    'runtime/base/*' 'runtime/asset/*' 'runtime/grammar/*' 'runtime/derive/*' 'runtime/field/*' 'runtime/mesh/*' 'runtime/backend/*' \
    ':!runtime/field/reference*')"

# defined_twice: prints types that are defined in two files, with the same name in the same namespace. Each library would
# keep only one of their constructors for both types.
defined_twice() {
  tracked 'runtime/*.h' 'runtime/*.cpp' 'cuda/*.h' 'cuda/*.cpp' | xargs -r -d '\n' awk '
    FNR == 1 { depth = 0 }
    /^(inline )?namespace.*\{/ && !/\}/ {
      name = $0
      sub(/^(inline )?namespace */, "", name)
      sub(/ *\{.*/, "", name)
      within[++depth] = name == "" ? FILENAME : name
    }
    /^\} *\/\/ namespace/ { --depth }
    match($0, /^(struct|class|union|enum|enum class) [A-Za-z0-9_]+( final)?( : [^;]*)? *\{/) {
      name = $0
      sub(/^(struct|class|union|enum class|enum) /, "", name)
      sub(/[^A-Za-z0-9_].*/, "", name)
      for (i = depth; i > 0; --i) name = within[i] "::" name
      print name, FILENAME
    }' | sort -u | awk '$1 == last { print $1 ": " file " and " $2 } { last = $1; file = $2 }'
}
complain "types with one name in one namespace: rename one" "$(defined_twice)"

# broken_links: prints links in Markdown pages to files that do not exist in the tree.
broken_links() {
  local page target
  while IFS= read -r page; do
    while IFS= read -r target; do
      [[ $target == *:* || -z ${target%%#*} || -e $(dirname "$page")/${target%%#*} ]] || echo "$page: $target"
    done < <(grep -oE '\]\([^)[:space:]]+\)' "$page" | sed 's/^](//; s/)$//')
  done < <(tracked '*.md')
}
complain "links to files that are not there" "$(broken_links)"

# The program that the README shows must be identical to the sample, because only the sample is built and run as a test.
if [[ -e samples/minimal_c/main.c ]]; then
  shown=$(awk '/^```c$/ { on = 1; next } /^```/ { on = 0 } on' README.md)
  complain "README.md's C program differs from samples/minimal_c/main.c" \
    "$(diff <(printf '%s\n' "$shown") samples/minimal_c/main.c || true)"
fi

# The README lists packages to install by hand. They must be the packages that samples/setup_debian.sh installs.
if [[ -e samples/setup_debian.sh ]]; then
  source samples/setup_debian.sh
  words=$(tr -s ' \\\n' ' ' <README.md)
  for list in "${SGM_LIBRARY_PACKAGES[*]%%=*}" "${SGM_BUILD_PACKAGES[*]%%=*}" "${SGM_TEST_PACKAGES[*]%%=*}"; do
    [[ $words == *"apt-get install $list "* ]] || complain "README.md lacks the packages of samples/setup_debian.sh" "$list"
  done
fi
exit "$failed"
