#!/usr/bin/env bash
# Types meshinfo's commands and holds exit codes, streams and reports. First argument: the folder of
# binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
info=$bin/meshinfo

ball 8 3 >ball.off
expect 0 "$info" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$info" ball.off
[ ! -s "$log/err" ] || fail "words on stderr: $(cat "$log/err")"
for words in "triangles    224" "1 part, no border" '"scale": 6.7'; do
  grep -qF "$words" "$log/out" || fail "no '$words' in: $(cat "$log/out")"
done
expect 0 "$info" ball.off --json -
says "$log/out" '.files[0] | .triangles == 224 and .topology.closed and .topology.euler == 2 and .volume > 100' ||
  fail "report: $(cat "$log/out")"
cp "$log/out" first
for j in 1 2; do
  expect 0 "$info" ball.off --json - -j $j
  cmp -s first "$log/out" || fail "-j $j gives another report"
done
# A pipe; several files; an output.
"$info" - <ball.off >piped
grep -q "triangles    224" piped || fail "no mesh from a pipe"
expect 0 "$info" ball.off ball.off -o table.txt --json files.json
[ ! -s "$log/out" ] && [ "$(wc -l <table.txt)" -eq 3 ] || fail "table: $(cat table.txt)"
says files.json '.files | length == 2' || fail "two files"
# Misuse and bad input.
fault 2 "FILE is required" "$info"
fault 2 "--texture-size" "$info" ball.off --texture-size 1
fault 1 "missing.ply" "$info" ball.off missing.ply
printf 'OFF\n3 1 0\n0 0 0\n' >cut.off
fault 1 "cut.off" "$info" cut.off
fault 2 "cannot both be standard input" "$info" - -
echo "meshinfo.sh: all well"
