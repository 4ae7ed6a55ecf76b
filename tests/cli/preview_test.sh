#!/usr/bin/env bash
# Tests sgm preview under a virtual display: its window, mouse, keys, and saves of the file that it shows.
source "$(dirname "$0")/common.sh"

ball >ball.sgm
expect 3 env -u DISPLAY -u WAYLAND_DISPLAY "$SGM" preview ball.sgm
err_has 'there is no display to open a window on .*: start it on a desktop, or draw a picture with `sgm render'
one_line
out_empty
expect 4 "$SGM" preview missing.sgm
err_has 'missing.sgm'
one_line
for wrong in --region=0,0,0:0,1,1 --cell=0; do
  expect 1 "$SGM" preview ball.sgm $wrong
  err_has "${wrong%%=*}"
done
expect 2 "$SGM" preview
expect 2 "$SGM" preview ball.sgm --camera 1,2,3
err_has '--camera'

for tool in Xvfb xdotool; do
  command -v "$tool" >/dev/null && continue
  echo "$tool is missing: install the packages xvfb and xdotool" >&2
  [[ -z ${SGM_REQUIRE_ALL:-} ]] || exit 1
  exit 77
done

mkfifo display
Xvfb -displayfd 3 -screen 0 1024x768x24 -fbdir "$work" -nolisten tcp 3>display 2>xvfb.log &
server=$!
previewed=
end() {
  [[ -z $previewed ]] || kill "$previewed" 2>/dev/null
  kill "$server" 2>/dev/null
  wait 2>/dev/null
  cleanup
}
trap end EXIT
read -r -t 60 number <display || { cat xvfb.log >&2; echo "FAILED: no virtual display starts" >&2; exit 1; }
export DISPLAY=:$number
unset WAYLAND_DISPLAY

# Makes ball.sgm import the file parts.sgm, which contains its shape.
printf 'sgm 1;\nunits m;\nrule Stone(r) { sphere(r); mat marble; tag "stone"; }\n' >parts.sgm
world() {
  printf 'sgm 1;\nimport "parts.sgm" as parts;\nunits m;\nparam radius = %s in 1m..3.5m "of the ball";\nstart Ball;\nrule Ball { parts.Stone(radius); }\n' "$1"
}
world 3m >ball.sgm
: >events
"$SGM" preview ball.sgm --json --size 800x600 --seed 3 >events 2>errors &
previewed=$!

# await EXPRESSION [FROM]: waits for an event line, after the first FROM lines, that satisfies the expression; prints
# its line number.
await() {
  node -e '
    const fs = require("fs"), [wanted, from] = [process.argv[1], Number(process.argv[2])];
    const end = Date.now() + 120000;
    (function look() {
      const lines = fs.readFileSync("events", "utf8").split("\n").slice(0, -1);
      for (let i = from; i < lines.length; ++i) {
        const j = JSON.parse(lines[i]);
        if (eval(wanted)) { console.log(i + 1); return; }
      }
      if (Date.now() > end) { console.error("no line satisfies " + wanted + ":\n" + lines.slice(from).join("\n")); process.exit(1); }
      setTimeout(look, 20);
    })();' "$1" "${2:-0}"
}
# waited EXPRESSION: same as await, but starts after the line that was awaited last.
seen=0
waited() {
  local now
  last="await $1" status=0 out=$(tail -3 events) err=$(cat errors)
  now=$(await "$1" "$seen") || { failed "the preview does not say so"; finish; }
  seen=$now
}
key() { xdotool search --sync --name 'sgm preview' windowfocus --sync key "$1"; }

# A draft must be drawn first, then the full picture.
waited 'j.event === "picture" && j.draft && j.seed === 3 && j.triangles > 100 && j.width * j.height < 100000'
waited 'j.event === "picture" && !j.draft && j.width === 800 && j.height === 600 && j.messages === "" && j.triangles > 1000'
# colour X Y EXPRESSION: tests the colour of a pixel of the screen. The window's middle must be pale marble, with sky
# around it.
colour() {
  node -e '
    const d = require("fs").readFileSync("Xvfb_screen0"), u = (i) => d.readUInt32BE(4 * i);
    const header = u(0), width = u(4), order = u(7), bits = u(11), line = u(12), colours = u(19);
    const at = header + 12 * colours + line * Number(process.argv[2]) + bits / 8 * Number(process.argv[1]);
    const pixel = order === 0 ? d.readUInt32LE(at) : d.readUInt32BE(at);
    const c = [pixel >> 16 & 255, pixel >> 8 & 255, pixel & 255];
    process.exit(eval(process.argv[3]) ? 0 : (console.error(width, c), 1));' "$1" "$2" "$3"
}
# shown X Y EXPRESSION MESSAGE: waits until the pixel's colour satisfies the expression, since the window shows a
# picture some time after the preview has reported it.
shown() {
  for _ in {1..40}; do
    run colour "$1" "$2" "$3"
    [[ $status == 0 ]] && return
    sleep 0.25
  done
  failed "$4"
}
shown 400 300 'c[0] > 60 && Math.abs(c[0] - c[2]) < 60' "no ball in the middle of the window"
shown 780 20 'c[2] > c[0] + 20' "no sky beside it"

# A saved file must be drawn at once, also a file that the shown file imports. Errors must be reported, and the last
# picture must stay.
world 1.5m >ball.sgm
waited 'j.event === "picture" && j.draft && j.messages === ""'
waited 'j.event === "picture" && !j.draft'
sed -i 's/sphere(r)/box(r, r, r)/' parts.sgm
waited 'j.event === "picture" && !j.draft'
echo 'rule Ball { nothing(1); }' >>ball.sgm
waited 'j.event === "message" && /ball.sgm:7:\d+: error: /.test(j.messages)'
shown 400 300 'c[0] > 60' "the last picture is gone"
world 3m >ball.sgm
sed -i 's/box(r, r, r)/sphere(r)/' parts.sgm
waited 'j.event === "picture" && !j.draft && j.messages === ""'

# A click must report the rule, the wheel must zoom in, H must reset the camera, and P must print the command.
xdotool search --sync --name 'sgm preview' windowfocus --sync mousemove --window %1 400 300 sleep 0.1 click 1
waited 'j.event === "place" && j.path === "Ball/parts.Stone[0]" && j.source === "parts.sgm:3:17" && j.material === "marble" && j.tag === "stone"'
before=$(tail -n +1 events | grep '"draft":false' | tail -1)
xdotool click 4
waited 'j.event === "picture" && !j.draft && j.camera !== '"$(node -p "JSON.stringify(JSON.parse(process.argv[1]).camera)" "$before")"
key h
waited 'j.event === "picture" && !j.draft && j.camera === '"$(node -p "JSON.stringify(JSON.parse(process.argv[1]).camera)" "$before")"
# Drags the slider, the third control of the panel, to its right end.
xdotool search --sync --name 'sgm preview' mousemove --window %1 60 97 sleep 0.1 mousedown 1 sleep 0.1 mousemove --window %1 300 97 sleep 0.1 mouseup 1
waited 'j.event === "picture" && !j.draft && j.sets.join() === "radius=3.5m"'
key p
waited 'j.event === "command" && /^sgm render ball.sgm .*--seed 3 --set radius=3.5m --region=.* --cell .* --camera=/.test(j.command)'
# Use the last printed command; more pictures may have been reported after it.
command=$(grep '"event":"command"' events | tail -1 | node -p 'JSON.parse(require("fs").readFileSync(0)).command')
# shellcheck disable=SC2086  # the command's words
expect 0 "$SGM" ${command#sgm }
[[ -s picture.png ]] || failed "the printed command draws no picture"

key Escape
wait "$previewed"
status=$? previewed=
out=$(tail -2 events) err=$(cat errors) last="sgm preview"
[[ $status == 0 ]] || failed "the preview does not end well"
err_empty
finish
