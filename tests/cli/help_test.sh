#!/usr/bin/env bash
# Tests --help (with an example for every command), --version, and sgm backends.
source "$(dirname "$0")/common.sh"
expect 0 "$SGM" --help
for command in check fmt explain lsp mesh bake store measure classify masters render preview fly serve bench paper backends; do
  out_has "$command"
done
for command in check fmt explain lsp mesh bake store measure classify masters render preview fly serve bench paper backends; do
  expect 0 "$SGM" $command --help
  out_has "Example:"
  out_has "sgm $command"
  err_empty
done
for command in render preview fly; do
  expect 0 "$SGM" $command --help
  out_has '--light TEXT:\{auto,sun,lamp,none\}=auto'
  out_has 'Light: from the points .* sun[[:space:]]+shines'
done
expect 0 "$SGM" --version
out_has '^sgm [0-9]+\.[0-9]+\.[0-9]+$'

# The examples in the help must work as printed.
mkdir -p samples && cp -r "$SOURCE/samples/grammars" samples/
for command in check fmt explain backends; do
  expect 0 "$SGM" $command --help
  example=$(sed -n '/^Example:/{n;s/^ *sgm //p}' <<<"$out")
  # shellcheck disable=SC2086
  expect 0 "$SGM" $example
done

expect 0 "$SGM" backends
out_has 'cpu +usable'
expect 0 "$SGM" backends --json
json 'j.auto === (j.backends[1].usable && j.vulkan_devices.some(d => d.usable && !d.software) ? "vulkan" : "cpu") && j.backends.map(b => b.name).join() === "cpu,vulkan,cuda"'
json 'j.backends[0].usable && j.backends[0].exact && j.backends[0].device.length > 0 && j.backends[0].concurrency >= 1'
json 'j.backends.slice(1).every(b => b.usable || b.reason.length > 0)'
json 'j.vulkan_devices.every(d => d.name && d.type && (d.usable ? typeof d.exact === "boolean" : d.reason.length > 0))'
json '!j.backends[1].usable || j.vulkan_devices.some(d => d.usable)'
json 'Array.isArray(j.vulkan_devices) && j.version && j.build.includes(j.version)'
expect 2 "$SGM" backends extra

# For an unknown command, the message must suggest the most similar command.
expect 2 "$SGM" meshh ball.sgm
err_has "^sgm: usage: there is no command 'meshh': did you mean 'mesh'\\?"
expect 2 "$SGM" bench papr
err_has "there is no command 'papr': did you mean 'paper'\\?"
expect 2 "$SGM" photograph
err_has "there is no command 'photograph': write one of check, fmt, explain, mesh, bake, store, measure, classify, masters, render, preview, fly, serve, lsp, bench, paper, backends"
expect 2 "$SGM" bench paper extra
err_has 'argument was not expected: extra'
finish
