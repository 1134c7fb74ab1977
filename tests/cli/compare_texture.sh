#!/usr/bin/env bash
# Runs scripts/compare-texture on tiny meshes, and scripts/meshopt-simplify with a stand-in for the
# package. First argument: the folder of binaries.
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
row=$(awk '$1 == "mean" { a = $2; b = $3 } $1 == "min" { printf "%.2f %.2f %.2f %.2f", a, $2, b, $3 }' "$log/out")
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

# --- meshopt-simplify: no network here; a stand-in that keeps the first faces asked for ---
simplify=$scripts/meshopt-simplify
expect 0 "$simplify" --help
grep -q 'meshopt-simplify MESH --faces N -o OUT' "$log/out" || fail "--help"
got=0
PATH=$log "$BASH" "$simplify" a.obj --faces 9 -o x.obj 2>"$log/err" || got=$?
[ $got -eq 3 ] && [ "$(cat "$log/err")" = "meshopt-simplify: node is missing; install it (Debian: apt-get install nodejs npm)" ] ||
  fail "$got $(cat "$log/err")"
command -v node >/dev/null || { echo "compare_texture.sh: all well; no node"; exit 0; }
mkdir stand_in
export MESHOPTIMIZER=$PWD/stand_in CALL=$log/call
fault 3 "has no meshopt_simplifier.js" "$simplify" a.obj --faces 9 -o x.obj
echo '{"type": "module", "version": "9.8.7"}' >stand_in/package.json
cat >stand_in/meshopt_simplifier.js <<'JS'
import { writeFileSync } from 'node:fs';
const say = (name, lock, n, flags) =>
  writeFileSync(process.env.CALL, [name, lock === null ? 'free' : Array.from(lock).join(''), n, ...flags].join(' '));
export const MeshoptSimplifier = {
  ready: Promise.resolve(),
  simplifyWithAttributes(indices, at, stride, uv, uv_stride, weights, lock, n, error, flags) {
    say(`attributes ${at.length / stride} ${uv.length / uv_stride} ${weights}`, lock, n, flags);
    return [indices.slice(0, n), 0.5];
  },
  simplifyWithUpdate(indices, at, stride, uv, uv_stride, weights, lock, n, error, flags) {
    say('update', lock, n, flags);
    for (let i = 0; i < at.length; ++i) at[i] += 1;
    indices.reverse();
    return [6, 0.5];
  },
};
JS
# Four squares in a row but for the last; two charts that meet at x = 1; corners and vertices said twice.
cat >strip.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 1 0 0
v 2 0 0
v 2 1 0
v 0.1 0 0
vt 0 0
vt 0.4 0
vt 0.4 0.4
vt 0 0.4
vt 0.5 0
vt 0.9 0
vt 0.9 0.4
vt 0.5 0.4
vt 0 0
vn 0 0 1
f 1/1/1 2/2/1 3/3/1 4/4/1
f -4/5 6/6 7/7
f 3/8 5/5 7/7
f 4/4/1 1/9/1 2/2/1
OBJ
expect 0 "$simplify" strip.obj --faces 5 -o s.obj
cat >wanted.obj <<'OBJ'
# meshoptimizer 9.8.7 simplifyWithAttributes weight 10 flags none, 5 faces asked
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 0
v 2 1 0
vt 0 0
vt 0.400000006 0
vt 0.400000006 0.400000006
vt 0 0.400000006
vt 0.5 0
vt 0.899999976 0
vt 0.899999976 0.400000006
vt 0.5 0.400000006
f 1/1 2/2 3/3
f 1/1 3/3 4/4
f 2/5 5/6 6/7
f 3/8 2/5 6/7
f 4/4 1/1 2/2
OBJ
cmp s.obj wanted.obj || fail "$(diff s.obj wanted.obj)"
[ "$(cat "$CALL")" = 'attributes 8 8 10,10 free 15' ] || fail "$(cat "$CALL")"
grep -qx 'meshopt-simplify: 5 faces, error 0.5000' "$log/err" || fail "no summary"
expect 0 "$simplify" strip.obj --faces 2 --weight 0.5 --flags Permissive,Prune --protect -o t.obj -q
[ "$(cat "$CALL")" = 'attributes 8 8 0.5,0.5 02202002 6 Permissive Prune' ] || fail "$(cat "$CALL")"
expect 5 "$simplify" strip.obj --faces 1 --update -o t.obj
grep -qx 'f 1/1 2/2 3/3' t.obj && grep -qx 'v 2 1 1' t.obj || fail "$(cat t.obj)"
grep -q 'strip.obj: 1 faces were asked for, it stops at 2' "$log/err" || fail "$(cat "$log/err")"
bad_obj() { printf "$1" >bad.obj; fault 1 "bad.obj: $2" "$simplify" bad.obj --faces 1 -o x.obj; }
bad_obj 'v 0 0\n' 'line 1: are not 3 numbers'
bad_obj 'v 0 0 0\nvt 0 0\nf 1/1 1/1 2/1\n' "line 3: '2' is no index"
bad_obj 'v 0 0 0\nvt 0 0\nf 1/1 1/1 1\n' "line 3: a corner has no texture coordinate"
bad_obj 'v 0 0 0\nvt 0 0\nf 1/1 1/1\n' "line 3: a face has fewer"
bad_obj 'v 0 0 0\n' "has no faces"
fault 1 "missing.obj: cannot be read" "$simplify" missing.obj --faces 1 -o x.obj
fault 3 "cannot write no/x.obj" "$simplify" strip.obj --faces 5 -o no/x.obj
for words in "--faces 0" "--faces 9 --weight nan" "--faces 9 --flags All" "" "--faces 9 --protect" "--faces 9 b.obj"; do
  # shellcheck disable=SC2086  # words
  fault 2 "scripts/meshopt-simplify --help" "$simplify" strip.obj -o x.obj $words
done
if command -v npm >/dev/null; then  # a copy of the scripts, and nobody at the registry's address
  unset MESHOPTIMIZER
  mkdir copy copy/scripts
  cp "$scripts"/meshopt-simplify* copy/scripts
  expect 3 env npm_config_registry=http://127.0.0.1:9 npm_config_fetch_retries=0 npm_config_cache="$log/npm" \
    copy/scripts/meshopt-simplify strip.obj --faces 5 -o x.obj
  [ "$(wc -l <"$log/err")" -eq 1 ] && grep -q 'npm cannot fetch meshoptimizer@1' "$log/err" || fail "$(cat "$log/err")"
  [ -z "$(ls -A copy/out)" ] && [ ! -e x.obj ] || fail "left over: $(ls -A copy/out)"
fi
echo "compare_texture.sh: all well ($n_faults faults)"
