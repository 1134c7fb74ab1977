#!/usr/bin/env bash
# Runs measure-texture, measure-trips, time-texture, measure-memory and draw-texture-figures on small
# stand-ins for their models, and write-results on what they leave. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../scripts" && pwd)
start "$1"
export BIN=$bin VIEWS=1 SIZE=64 RUNS=1 SIDE=64 TRIPS=2
mkdir models
ball 15 1 >ball.off
expect 0 "$bin/uvpatch" ball.off --faces 400 --texture-size 128 --distort swirl -o models/josie.obj

# Tables: a row a candidate, the rebaked and adapted ones better than the texture as it was.
expect 0 "$scripts/measure-texture" models out josie
names=$(awk -F'|' 'NR > 2 && NF > 3 { gsub(/ /, "", $2); printf "%s ", $2 }' out/josie/table.md)
[ "$names" = "plain adapted rebaked full-plain full-adapted full-rebaked mean-adapted lt-adapted texture bits16 bits8 map1024 " ] ||
  fail "candidates: $names"
db() { awk -F'|' -v name="$1" '{ gsub(/[ *]/, "", $2) } $2 == name { gsub(/[ *]/, "", $6); print $6 }' out/josie/table.md; }
awk -v a="$(db adapted)" -v p="$(db plain)" -v r="$(db rebaked)" 'BEGIN { exit !(a > p + 1 && r > p + 1) }' ||
  fail "$(cat out/josie/table.md)"
awk -v a="$(db adapted)" -v p="$(db plain)" -v r="$(db rebaked)" 'BEGIN { printf "%+.2f\n%+.2f\n", a - p, a - r }' >gains
for gain in $(cat gains); do
  tail -n 1 out/josie/table.md | grep -qF -- "$gain" || fail "no $gain in: $(tail -n 1 out/josie/table.md)"
done
[ -s out/josie/sheet.png ] || fail "no sheet"
expect 1 "$scripts/measure-texture" models out swirl
grep -q 'swirl: no 951gaspra_21_MLfix.obj' "$log/err" || fail "$(cat "$log/err")"
expect 1 "$scripts/measure-texture" models out nothing
expect 2 "$scripts/measure-texture" models

# Trips: back at the finest level nothing has changed with a map, something with the texture itself; part
# of the way back more with each trip.
expect 0 "$scripts/measure-trips" models out josie
awk -F'|' 'NR > 2 {
    n++
    if ($3 != n || $4 != 0 || $5 + 0 != 100 || $6 != 100 || !($7 > before) || !($9 < 100) || !($10 < 100)) bad = 1
    before = $7
  }
  END { exit bad || n != 2 }' out/trips/table.md || fail "$(cat out/trips/table.md)"
expect 1 "$scripts/measure-trips" models out swirl
[ -z "$(find out -name '.tmp-*')" ] || fail "left over: $(find out -name '.tmp-*')"

# Times: a row for this model and those of the paper, all of as many columns.
expect 0 "$scripts/time-texture" models out josie
for table in packs runtime building; do
  grep -q '^| Josie | ' out/$table/table.md || fail "$table: $(cat out/$table/table.md)"
  awk -F'|' 'NR == 1 { n = NF } NF != n { exit 1 }' out/$table/table.md || fail "$table: $(cat out/$table/table.md)"
done
awk -F'|' '$2 ~ /Josie/ { exit !($5 * 1 == $5 && $5 > 20 && $7 < $5 && $8 > 1 && $6 > 0 && $9 > 0) }' out/packs/table.md ||
  fail "$(cat out/packs/table.md)"
expect 1 "$scripts/time-texture" models out swirl

# Memory: four times the texels take about four times as much, in multiples of what is held as the table has it.
SIDES="1024 2048" expect 0 "$scripts/measure-memory" models out josie
awk -F'|' 'NR > 2 {
    held = $4 + $5
    off = $11 - $10 / held
    if (!($10 > held && $10 < 12 * held) || off > 0.1 || off < -0.1) bad = 1
    if ($3 ~ /texture/ ? $8 !~ /^ *$/ : !($8 > held && $8 < 12 * held)) bad = 1
    if ($2 == 2048 && !($10 > 3 * small[$3] && $10 < 8 * small[$3] && $7 > $5)) bad = 1
    small[$3] = $10
    n++
  }
  END { exit bad || n != 8 }' out/memory/table.md || fail "$(cat out/memory/table.md)"
expect 1 "$scripts/measure-memory" models out swirl

# Figures: left out where there is no model. write-results fills the document.
expect 0 "$scripts/draw-texture-figures" models out fig309
grep -q 'fig309 left out: no swirl' "$log/err" || fail "$(cat "$log/err")"
# Figure 3.15 on a bumpy patch with a flat normal map: maps that follow show its bumps, those that stay do not.
ball 24 1 | awk 'NR < 3 || NF == 4 { print; next }
  { k = 1 + 0.06 * sin(9 * $1) * sin(9 * $2 + 1); print k * $1, k * $2, k * $3 }' >bumpy.off
expect 0 "$bin/uvpatch" bumpy.off --faces 1500 --texture-size 256 -o bumpy.obj
expect 0 "$bin/pmesh" build bumpy.obj --metric mapping -o bumpy.pm
expect 0 "$bin/texadapt" bumpy.pm bumpy.png --faces 1500 --normal-map flat=flat.png -o models/LeePerrySmith.glb
cp bumpy.png models/Map-COL.jpg
cp flat.png models/Infinite-Level_02_Tangent_SmoothUV.jpg
expect 0 "$scripts/measure-texture" models out leeperrysmith
expect 0 "$scripts/draw-texture-figures" models out fig315
[ -s out/fig315/figure.png ] || fail "no Figure 3.15"
awk '/^original/ { n++ } /^500/ && /dB/ { db[++k] = $(NF - 1) } /^adapted/ { db[++k] = $(NF - 1) }
  END { exit !(n == 4 && k == 8 && db[2] > db[1] + 0.5 && db[4] > db[3] + 2) }' out/fig315/notes.txt || fail "$(cat out/fig315/notes.txt)"
printf '%s\n' '<!-- josie: table views -->' old '<!-- end -->' '<!-- trips -->' '<!-- end -->' '<!-- fig309: figure -->' kept '<!-- end -->' >doc.md
expect 0 "$scripts/write-results" doc.md out
grep -q '^| adapted |' doc.md && grep -q 'pictures/out/josie-sheet.png' doc.md && grep -q '^| Josie | 1 |' doc.md &&
  grep -qx kept doc.md && ! grep -qx old doc.md || fail "$(cat doc.md)"
cmp -s pictures/out/josie-sheet.png out/josie/sheet.png || fail "another picture"
echo "slow_measure_texture.sh: all well"
