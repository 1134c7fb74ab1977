#!/usr/bin/env bash
# Runs scripts/compare-texture on tiny meshes. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../scripts" && pwd)
start "$1"
export BIN=$bin VIEWS=2 SIZE=64 ROWS=2
ball 6 1 >ball.off
expect 0 "$bin/uvpatch" ball.off --faces 90 --texture-size 64 -o a.obj -q
expect 0 "$bin/uvpatch" ball.off --faces 60 --texture-size 64 --squares 2 -o b.obj -q
expect 0 "$bin/subdivide" a.obj --times 1 --scheme midpoint -o fine.obj -q

# The same surface and texture; another texture; another surface; too many faces.
compare=$scripts/compare-texture
expect 0 "$compare" a.obj a.png out 90 same=a.obj "other=a.obj:b.png" part=b.obj:a.png fine=fine.obj:a.png
grep -qx '| same | 90 | \*\*100.00\*\* | \*\*100.00\*\* | \*\*100.00\*\* | \*\*100.00\*\* |' out/table.md ||
  fail "$(cat out/table.md)"
grep -qx 'highest over covered pixels: same' "$log/out" || fail "$(cat "$log/out")"
head -n -1 "$log/out" | cmp - out/table.md || fail "another table on stdout"
column() { awk -F'|' -v name=" $1 " -v c="$2" '$2 == name { gsub(/[ *]/, "", $c); print $c }' out/table.md; }
[ "$(column fine 3)" = 360 ] && ! grep fine out/table.md | grep -q '\*' || fail "more faces than asked are best"
for name in other part; do
  awk -v all="$(column $name 4)" -v least="$(column $name 5)" -v covered="$(column $name 6)" -v worst="$(column $name 7)" \
    'BEGIN { exit !(least <= all && worst <= covered && covered < all && all < 60 && worst > 0) }' || fail "$name"
done
[ "$(ls -A out | tr '\n' ' ')" = "sheet.png table.md " ] || fail "$(ls -A out)"
width=$((0x$(od -An -tx1 -j16 -N4 out/sheet.png | tr -d ' ')))
[ "$width" -gt $((5 * 32)) ] || fail "a sheet of $width px"
# The numbers are those of the tools.
for m in a b; do
  expect 0 "$bin/meshshot" $m.obj --texture a.png --unlit --views 2 --size 64 --like a.obj --no-sheet -q -o $m
done
expect 0 "$bin/psnr" a b --no-ssim
row=$(awk '$1 == "mean" { a = $2; b = $4 } $1 == "min" { printf "%.2f %.2f %.2f %.2f", a, $2, b, $4 }' "$log/out")
[ "$row" = "$(column part 4) $(column part 5) $(column part 6) $(column part 7)" ] || fail "$row is not $(grep part out/table.md)"

# The same numbers again; all or nothing.
cp -rp out before
expect 0 "$compare" a.obj a.png few 10 part=b.obj:a.png
[ "$(tail -n 1 few/table.md)" = "$(grep part out/table.md)" ] || fail "another row: $(cat few/table.md)"
grep -q 'none, for all have more faces' "$log/out" || fail "$(cat "$log/out")"
for bad in missing.obj a.obj:ball.off; do
  expect 1 "$compare" a.obj a.png out 90 bad=$bad
  for f in table.md sheet.png; do cmp -s out/$f before/$f || fail "$bad changes $f"; done
done
expect 1 "$compare" a.obj missing.png new 90 a=a.obj  # at once
[ ! -e new ] && [ -z "$(find . -name '.tmp-*')" ] || fail "left over: $(ls -A)"
expect 0 "$compare" --help
grep -q 'scripts/compare-texture ORIGINAL TEXTURE OUT FACES' "$log/out" || fail "--help"
for bad in a.obj =a.obj x= x=: ../x=a.obj original=a.obj; do
  expect 2 "$compare" a.obj a.png new 90 "$bad"
  [ "$(wc -l <"$log/err")" -eq 1 ] || fail "'$bad': $(cat "$log/err")"
done
expect 2 "$compare" a.obj a.png new 90 x=a.obj x=b.obj
expect 2 "$compare" a.obj a.png new many x=a.obj
expect 2 "$compare" a.obj a.png new 90
expect 2 env VIEWS=none "$compare" a.obj a.png new 90 x=a.obj
echo "compare_texture.sh: all well"
