#!/usr/bin/env bash
# Tests sgm lsp with VS Code's own client library (lsp_client.js), syntax highlighting (highlighting.js), and input that
# is no valid message.
source "$(dirname "$0")/common.sh"
here=$SOURCE/tests/cli tools=$3

expect 0 node "$here/lsp_client.js" "$tools" "$SGM" "$SOURCE"
[[ $status != 77 ]] || exit 77
out_has 'all passed'
expect 0 node "$here/highlighting.js" "$tools" "$SOURCE"

# message TEXT: prints a message with its header. lsp MESSAGE...: sends each message to the server.
message() { printf 'Content-Length: %d\r\n\r\n%s' "${#1}" "$1"; }
lsp() { for one in "$@"; do message "$one"; done | "$SGM" lsp; }
hello='{"jsonrpc":"2.0","id":1,"method":"initialize","params":{}}'
bye='{"jsonrpc":"2.0","id":2,"method":"shutdown"}'
leave='{"jsonrpc":"2.0","method":"exit"}'

run lsp "$hello" "$bye" "$leave"
[[ $status == 0 ]] || failed 'a whole talk ends well'
out_has '"id":1' && out_has '"id":2,"jsonrpc":"2.0","result":null'
run lsp "$hello" "$leave"
[[ $status == 1 ]] || failed 'an exit without shutdown is status 1'
run lsp '{"jsonrpc":' "$hello" "$bye" "$leave"
[[ $status == 0 ]] || failed 'what is no JSON ends nothing'
out_has '"code":-32700' && out_has '"id":1'
run lsp '[1,2]' '{"id":{}}' '{"method":7}' '{"id":5,"result":{}}' "$hello" '{"id":"x","method":"textDocument/hover","params":[]}' "$bye" "$leave"
[[ $status == 0 && $(grep -o -- '-32600' <<<"$out" | wc -l) == 3 ]] || failed 'messages that are none are refused'
out_has '"code":-32602'
{ printf 'Content-Type: x\r\ncontent-length: %d\r\n\r\n%s' "${#hello}" "$hello"; message "$bye"; message "$leave"; } >talk
run bash -c '"$1" lsp <talk' - "$SGM"
[[ $status == 0 ]] || failed 'headers are in any case and order'
{ printf 'Content-Length: 99999999999\r\n\r\n'; head -c 1000 /dev/zero; } >talk
run bash -c '"$1" lsp <talk' - "$SGM"
[[ $status == 1 ]] || failed 'a message that is too large'
out_has 'a message must have 1 to'
# Sends JSON nested deeper than the stack allows: once in the parameters, once as the whole message.
deep=$(head -c 1000000 /dev/zero | tr '\0' '[')
shut=$(tr '[' ']' <<<"$deep")
{ message "$hello"
  message "$deep"
  message "{\"jsonrpc\":\"2.0\",\"id\":3,\"method\":\"textDocument/hover\",\"params\":$deep$shut}"
  message "$bye"; message "$leave"; } >talk
run bash -c '"$1" lsp <talk' - "$SGM"
[[ $status == 0 && $(grep -o 'at most 256 deep' <<<"$out" | wc -l) == 2 ]] || failed 'messages that are nested too deep'
out_has '"id":2,"jsonrpc":"2.0","result":null'
run lsp "$hello" '{"jsonrpc":"2.0","id":3,"method":"no/such","params":["\"[[","'"${deep:0:300}"'"]}' "$bye" "$leave"
[[ $status == 0 ]] && out_has '"code":-32601' || failed 'brackets in texts are none'
# Sends a header without an end, and lengths that no stream can have.
run bash -c 'yes Content-Type: | tr -d "\n" | "$1" lsp' - "$SGM"
[[ $status == 1 ]] || failed 'a header without an end'
err_has 'not a message of the Language Server Protocol'
for length in 9223372036854775807 9223372036854775808 18446744073709551615 99999999999999999999 -5; do
  { message "$hello"; printf 'Content-Length: %s\r\n\r\n' "$length"; message "$bye"; } >talk
  run bash -c '"$1" lsp <talk' - "$SGM"
  [[ $status == 1 ]] || failed "a length of $length"
  err_has 'not a message of the Language Server Protocol'
done
printf 'GET / HTTP/1.1\r\n\r\n' >talk
run bash -c '"$1" lsp <talk' - "$SGM"
[[ $status == 1 ]] || failed 'another protocol'
err_has 'not a message of the Language Server Protocol'
one_line
finish
