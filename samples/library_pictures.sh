# shellcheck shell=bash disable=SC2154
# Sourced by samples/library.sh. Draws the example of each rule at a distance that fits its size.

# Views of examples that are not drawn from the front right and slightly above: NAME AZIMUTH ELEVATION in degrees, and
# further options of `sgm render`.
views='
cave.Water 28 20
facade.Plant 28 32
facade.Stacks 28 26
fort.Circuit 28 36
fort.Ring 28 36
fort.Ramp 28 36
fort.Ward 28 36
gothic.Vault 28 -24
gothic.Boss 28 -24
karst.slabs 28 34
karst.cobbles 28 34
karst.Rimstone 28 38
karst.Moonmilk 28 30
karst.Stream 40 34
mine.Track 40 26
mine.Pipe 40 20
rock.ropes 28 34
rock.valley 28 30
rock.Crag 28 26
street.Pavement 28 38
street.Road 28 38
street.Dashes 28 38
street.Street 28 38
street.Kerb 28 30
street.Garden 28 30
street.Grid 28 45
street.Zebra 28 38
street.Kerbs 28 38
street.Slab 28 38
street.Lawn 28 34
street.Site 28 30
'

# Scenes that replace the examples of some rules, because these examples are invisible by themselves, or because their
# hollow space is easier to see as a solid cast. Columns: NAME | DECLARATIONS | the body of a rule.
scenes='
cave.Branchwork | | rot(z, 100deg) cave.Branchwork(10, step 5m, r 2.5m);
karst.sole | | for i in 0..24 { at(karst.sole((0m, 0m, 0m), (70m, -4m, 20m), i/23)) sphere(2.2m); }
cave.Water | domain finite box(24m, 24m, 24m); | { union { { box(13m, 7m, 10m); mat limestone; } cut { ellipsoid(5m, 3m, 4m); } } meet { ellipsoid(5m, 3m, 4m); at(-10.8m, -10.8m, -10.8m) scale(0.9) cave.Water(11.4m, deep 3m); } cut { at(z 5m) box(14m, 10m, 10m); mat clay; } }
'

# Prints the material for a part of the library: it is used for the examples that set no material themselves.
material_of() {
  case $1 in
    cave | karst | rock | noise) echo limestone ;;
    mine) echo rock ;;
    cloud) echo cloud ;;
    fort) echo ashlar ;;
    gothic) echo ashlar_cream ;;
    plant) echo leaf ;;
    *) echo plaster ;;
  esac
}

# program FILE PART BODY [MORE]: writes a grammar with BODY as its only rule. MORE: further declarations.
program() { printf 'sgm 1;\nimport "std/%s.sgm" as %s;\n%s\nstart A;\nrule A { %s }\n' "$2" "$2" "${4-}" "$3" >"$1"; }

# bounds SGM FILE: prints the bounds of the shapes in FILE, "x0 y0 z0 x1 y1 z1", measured with the finest cell size that
# needs few chunks.
bounds() {
  local cell said
  for cell in 0.01 0.02 0.04 0.08 0.16 0.32 0.64 1.28 2.5 5 10 20 40; do
    said=$("$1" measure "$2" --cell $cell --max-chunks 400 --json 2>/dev/null) || continue
    tr -d '\n ' <<<"$said" | sed -n 's/.*"bounds":\[\[\([^]]*\)\],\[\([^]]*\)\]\].*/\1,\2/p' | tr ',' ' '
    return
  done
  return 1
}

# camera BOUNDS AZIMUTH ELEVATION FOV: prints "--camera FROM:TO" for a view of the whole box, and the size of a pixel at
# the box's middle.
camera() {
  awk -v b="$1" -v azimuth="$2" -v elevation="$3" -v fov="$4" 'BEGIN {
    split(b, c, " ")
    pi = atan2(0, -1)
    a = azimuth*pi/180; e = elevation*pi/180; up = 0.9*sin(fov*pi/360)/cos(fov*pi/360); side = 1.5*up
    dx = sin(a)*cos(e); dy = sin(e); dz = cos(a)*cos(e)  # unit vector from the middle of the box to the camera
    rx = cos(a); rz = -sin(a)  # unit vector to the right of the picture
    ux = -sin(a)*sin(e); uy = cos(e); uz = -cos(a)*sin(e)  # unit vector upwards in the picture
    for (i = 1; i <= 3; ++i) m[i] = (c[i] + c[i + 3])/2
    for (k = 0; k < 8; ++k) {
      x = c[1 + 3*(k%2)] - m[1]; y = c[2 + 3*(int(k/2)%2)] - m[2]; z = c[3 + 3*int(k/4)] - m[3]
      near = dx*x + dy*y + dz*z; right = rx*x + rz*z; high = ux*x + uy*y + uz*z
      if (right < 0) right = -right
      if (high < 0) high = -high
      if (near + right/side > d) d = near + right/side
      if (near + high/up > d) d = near + high/up
    }
    printf "--camera=%.4f,%.4f,%.4f:%.4f,%.4f,%.4f %.6f\n", m[1] + d*dx, m[2] + d*dy, m[3] + d*dz, m[1], m[2], m[3],
      2*up*d/240
  }'
}

# long_axis BOUNDS: prints x or z if the box is long along that axis; otherwise nothing.
long_axis() {
  awk -v b="$1" 'BEGIN {
    split(b, c, " ")
    x = c[4] - c[1]; y = c[5] - c[2]; z = c[6] - c[3]
    if (x > 2*y && x > 1.7*z) print "x"
    if (z > 2*y && z > 1.7*x) print "z"
  }'
}

# middle BOUNDS AXIS: prints a box around a slice of BOUNDS across AXIS. The slice begins in the middle of BOUNDS, lies
# on the side away from the sun, and is 14 % as thick as BOUNDS.
middle() {
  awk -v b="$1" -v axis="$2" 'BEGIN {
    split(b, c, " ")
    k = axis == "x" ? 1 : 3
    half = (c[k] + c[k + 3])/2; deep = 0.14*(c[k + 3] - c[k])
    if (k == 1) { c[1] = half; c[4] = half + deep } else { c[3] = half - deep; c[6] = half }
    for (i = 1; i <= 3; ++i) { m[i] = (c[i] + c[i + 3])/2; s[i] = c[i + 3] - c[i] + (i == k ? 0 : 1) }
    printf "at(%.4fm, %.4fm, %.4fm) box(%.4fm, %.4fm, %.4fm);\n", m[1], m[2], m[3], s[1], s[2], s[3]
  }'
}

# opened BOUNDS MATERIAL EXAMPLE AXIS WHOLE: prints statements for a block of rock around a void, cut open at the middle
# of the axis, or, if WHOLE is 0, at the end of BOUNDS.
opened() {
  awk -v b="$1" -v material="$2" -v example="$3" -v axis="$4" -v whole="$5" 'BEGIN {
    split(b, c, " ")
    k = axis == "x" ? 1 : 3
    for (i = 1; i <= 3; ++i) { m[i] = (c[i] + c[i + 3])/2; s[i] = c[i + 3] - c[i] }
    wall = 0.5*(s[1] < s[2] ? s[1] : s[2])
    if (wall > 0.18*s[1] + 0.02*s[2]) wall = 0.18*s[1] + 0.02*s[2]
    cut = whole ? m[k] : k == 1 ? c[1] : c[6]
    for (i = 1; i <= 3; ++i) s[i] += 2*wall
    printf "{ { at(%.4fm, %.4fm, %.4fm) box(%.4fm, %.4fm, %.4fm); mat %s; } %s", m[1], m[2], m[3], s[1], s[2], s[3],
      material, example
    m[k] = k == 1 ? cut - s[k] : cut + s[k]
    for (i = 1; i <= 3; ++i) s[i] *= 2
    printf " cut { at(%.4fm, %.4fm, %.4fm) box(%.4fm, %.4fm, %.4fm); mat clay; } }", m[1], m[2], m[3], s[1], s[2], s[3]
  }'
}

# line_of TABLE NAME: prints the line of NAME without the name.
line_of() { awk -v n="$2" '$1 == n { sub(/^[^ ]+ */, ""); print }' <<<"$1"; }

draw_one() {  # draw_one SGM FOLDER PART NAME EXAMPLE: draws the picture of one example
  local sgm=$1 folder=$2 part=$3 name=$3.$4 body=$5 box view scene axis whole=1 options=() fov=24 material
  local azimuth=28 elevation=14 more='' camera pixel cell region file=$2/$3.$4.sgm
  material=$(material_of "$part")
  scene=$(line_of "$scenes" "$name")
  if [[ -n $scene ]]; then
    more=$(cut -d '|' -f 2 <<<"$scene") body=$(cut -d '|' -f 3 <<<"$scene")
  elif [[ $body == cut\ * ]]; then
    program "$file" "$part" "${body#cut }" || return
    box=$(bounds "$sgm" "$file") || return
    axis=$(long_axis "$box")
    if [[ -n $axis ]]; then
      program "$file" "$part" "meet { ${body#cut } $(middle "$box" "$axis") }"
      box=$(bounds "$sgm" "$file") || return
      whole=0
    fi
    [[ $axis != x ]] || azimuth=-62
    body=$(opened "$box" "$material" "$body" "${axis:-z}" $whole)
  fi
  program "$file" "$part" "{ $body mat $material; }" "$more"
  box=$(bounds "$sgm" "$file") || return
  view=$(line_of "$views" "$name")
  [[ -z $view ]] || read -r azimuth elevation view <<<"$view"
  read -r -a options <<<"$view" || true
  read -r camera pixel <<<"$(camera "$box" "$azimuth" "$elevation" $fov)"
  cell=$(awk -v p="$pixel" 'BEGIN { c = 1.2*p; print c < 0.005 ? 0.005 : c }')
  region=$(awk -v b="$box" -v p="$pixel" 'BEGIN {
    split(b, c, " ")
    e = 10*p
    printf "--region=%.3f,%.3f,%.3f:%.3f,%.3f,%.3f", c[1] - e, c[2] - e, c[3] - e, c[4] + e, c[5] + e, c[6] + e
  }')
  "$sgm" render "$file" --sharp --cell "$cell" "$region" --max-chunks 100000 --fov $fov --size 360x240 "$camera" \
    ${options[@]+"${options[@]}"} --out "$folder/$name.png" >/dev/null 2>"$folder/said" || { cat "$folder/said" >&2; return 1; }
  convert "$folder/$name.png" -quality 85 -sampling-factor 4:2:0 -strip "$images/$name.jpg"
}

draw_pictures() {  # draw_pictures SGM [NAME]...: draws the pictures of these examples, or of all
  local sgm=$1 folder part name example failed=0
  shift
  source "$root/samples/setup_debian.sh"
  sgm_need imagemagick=convert || exit 1
  for name in "$@"; do
    names | grep -qxF "$name" || { echo "library.sh: error: the library has no picture of '$name'" >&2; exit 2; }
  done
  folder=$(mktemp -d)
  mkdir -p "$images"
  while IFS=$'\t' read -r part name example; do
    [[ -z ${1-} || " $* " == *" $part.$name "* ]] || continue
    draw_one "$sgm" "$folder" "$part" "$name" "$example" </dev/null ||
      { echo "library.sh: error: $part.$name cannot be drawn: its example is $example" >&2; failed=1; }
  done < <(examples)
  rm -rf "$folder"
  return $failed
}
