#!/usr/bin/env bash
# Types texadapt's commands and holds exit codes, pictures and reports. First argument: the folder of
# binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
texadapt=$bin/texadapt

ball 24 1 >ball.off
expect 0 "$bin/uvpatch" ball.off --faces 900 -o patch.obj  # with a check-board
expect 0 "$bin/pmesh" build patch.obj --metric mapping -o patch.pm
expect 0 "$texadapt" --help
grep -q "Example:" "$log/out" || fail "--help has no example"

expect 0 "$texadapt" patch.pm patch.png --faces 200 -o adapted.png --mesh coarse.ply --json report.json
for key in faces collapses adaptations texels refused timing; do
  grep -q "\"$key\": " report.json || fail "no $key in the report"
done
grep -Eq '"faces": (199|200),' report.json || fail "faces: $(cat report.json)"
# Seen from the same places, the adapted texture is nearer to the original than the one as it was.
shots() { expect 0 "$bin/meshshot" "$1" --texture "$2" --unlit --views 6 --size 128 --like patch.obj --no-sheet -q -o "$3"; }
shots patch.obj patch.png original
shots coarse.ply patch.png plain
shots coarse.ply adapted.png follows
mean() { "$bin/psnr" original "$1" | awk '$1 == "mean" { print $3 }'; }
awk -v with="$(mean follows)" -v without="$(mean plain)" 'BEGIN { exit !(with > without + 1) }' ||
  fail "PSNR with adaptation $(mean follows), without $(mean plain)"
# The input's own level changes nothing; the same bytes every time.
expect 0 "$texadapt" patch.pm patch.png --faces 100000 -o same.png
expect 0 "$bin/psnr" patch.png same.png
grep -q "100.000     100.000" "$log/out" || fail "the finest level's texture differs: $(cat "$log/out")"
expect 0 "$texadapt" patch.pm patch.png --faces 200 -o again.png -q
[ ! -s "$log/err" ] || fail "words on stderr with -q"
cmp -s again.png adapted.png || fail "other bytes the second time"
"$texadapt" patch.pm patch.png --faces 200 -q -o - | cmp -s - adapted.png || fail "-o -"

# Bad input: one line, nothing written.
expect 0 "$bin/pmesh" build ball.off -o bare.pm
fault 1 "has no texture coordinates" "$texadapt" bare.pm patch.png --faces 60 -o x.png
expect 0 "$bin/pmesh" build patch.obj --metric lt -o full.pm
fault 1 "full-edge" "$texadapt" full.pm patch.png --faces 60 -o x.png
sed 's/^vt \([0-9]\)/vt 1\1/' patch.obj >wide.obj
expect 0 "$bin/pmesh" build wide.obj -o wide.pm
fault 1 "outside [0, 1]" "$texadapt" wide.pm patch.png --faces 60 -o x.png
fault 1 "gone.png" "$texadapt" patch.pm gone.png --faces 60 -o x.png
fault 2 "faces" "$texadapt" patch.pm patch.png --faces 0 -o x.png
fault 2 "faces" "$texadapt" patch.pm patch.png -o x.png
fault 2 "-o" "$texadapt" patch.pm patch.png --faces 60 -o patch.png
fault 2 "-o" "$texadapt" patch.pm patch.png --faces 60 -o x.jpg
head -c 500 patch.pm >cut.pm
fault 1 "cut.pm" "$texadapt" cut.pm patch.png --faces 60 -o x.png
echo "texadapt.sh: $n_faults faults"
