#!/usr/bin/env bash
# Writes small requests as initial inputs of http_fuzz: four bytes that determine how the request is divided into
# pieces, then the bytes of the request.
#
#   http_seeds.sh FOLDER
set -euo pipefail
folder=$1
rm -rf "$folder"
mkdir -p "$folder"
seed() { printf "\3\n \1$2" >"$folder/$1"; }

host='Host: h\r\n'
post="POST /a HTTP/1.1\r\n$host"
seed empty_line "\r\nHEAD / HTTP/1.0\r\n\r\n"
seed pipelined "GET /a HTTP/1.1\r\n$host\r\n${post}Content-Length: 3\r\n\r\nabcDELETE /c HTTP/1.1\r\n$host\r\n"
seed target "GET /%%C3%%A9/b%%20c/?x=1+2&set=k%%3Dv&& HTTP/1.1\r\n${host}Connection: close, te\r\n\r\n"
seed absolute "GET http://h/a?b HTTP/1.1\r\n$host\r\n"
seed chunked "${post}Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0a;x=\"y\"\r\n0123456789\r\n0\r\nA: b\r\n\r\n"
seed waiting "PUT / HTTP/1.1\r\n${host}Content-Length: 1\r\nExpect: 100-continue\r\n\r\nx"
seed waiting_chunks "${post}Transfer-Encoding: chunked\r\nExpect: 100-continue\r\n\r\n0\r\n\r\n"
seed too_large "${post}Content-Length: 501\r\n\r\n"
seed two_lengths "${post}Content-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n"
seed encoded "${post}Content-Length: 3\r\nContent-Encoding: gzip\r\n\r\nabc"
seed folded "GET / HTTP/1.1\r\n${host}A: b\r\n c\r\n\r\n"
seed next_version "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"
seed get "GET / HTTP/1.1\r\n$host\r\n"
