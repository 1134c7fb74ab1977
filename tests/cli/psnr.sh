#!/usr/bin/env bash
# Types psnr's commands and holds exit codes, streams and reports. First argument: the folder of
# binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
psnr=$bin/psnr

# Gray pictures: a is 100 everywhere, b 101, both 20 x 15; turned is 15 x 20; huge says that it is
# 60000 x 60000.
base64 -d >a.png <<<iVBORw0KGgoAAAANSUhEUgAAABQAAAAPCAAAAADB87CJAAAAEUlEQVR42mNIwQIYRgWJEAQAHnt1MQgniOIAAAAASUVORK5CYII=
base64 -d >b.png <<<iVBORw0KGgoAAAANSUhEUgAAABQAAAAPCAAAAADB87CJAAAAEUlEQVR42mNIxQIYRgWJEAQA1w12XfyOKaoAAAAASUVORK5CYII=
base64 -d >turned.png <<<iVBORw0KGgoAAAANSUhEUgAAAA8AAAAUCAAAAAB3rDjOAAAAEElEQVR42mNIQQUMo3yS+ABDh3UxH8eBBAAAAABJRU5ErkJggg==
base64 -d >huge.png <<<iVBORw0KGgoAAAANSUhEUgAA6mAAAOpgCAAAAACluSqeAAAACklEQVR42mNIAQAAZgBl1yi8HwAAAABJRU5ErkJggg==

# The words and the numbers.
expect 0 "$psnr" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$psnr" --version
expect 0 "$psnr" a.png a.png
grep -q "100.000" "$log/out" || fail "identical pictures are not at 100 dB"
expect 0 "$psnr" a.png b.png
grep -q "48.131" "$log/out" || fail "an offset of one is not 48.131 dB: $(cat "$log/out")"
[ ! -s "$log/err" ] || fail "words on stderr: $(cat "$log/err")"

# JSON, alone on stdout when asked for there.
expect 0 "$psnr" a.png b.png --json -
head -c 1 "$log/out" | grep -q "{" || fail "stdout is not only JSON"
has_keys "$log/out" psnr_db psnr_rgb_db psnr_covered_db psnr_rgb_covered_db ssim snr_db rms max_abs \
  peak compared_as covered_px alpha_differs_px not_finite_px width_px height_px
is max_abs 1
expect 0 "$psnr" a.png b.png --json report.json -o table.txt
[ ! -s "$log/out" ] && [ -s report.json ] && [ -s table.txt ] || fail "-o and --json"
expect 0 "$psnr" a.png b.png --no-ssim --json -
says "$log/out" 'has("ssim") and .ssim == null' || fail "--no-ssim"

# Standard input for either.
got=0; "$psnr" - b.png <a.png >"$log/out" || got=$?
[ $got -eq 0 ] && grep -q "48.131" "$log/out" || fail "reference from stdin"
got=0; "$psnr" a.png - <b.png >"$log/out" || got=$?
[ $got -eq 0 ] && grep -q "48.131" "$log/out" || fail "tested picture from stdin"

# The threshold.
expect 0 "$psnr" a.png b.png --fail-below 48
expect 5 "$psnr" a.png b.png --fail-below 49
grep -q "48.131" "$log/out" || fail "no table beside exit code 5"

grep -q "PSNR of luminance: 1 of 1 pair below 49 dB" "$log/err" || fail "no verdict: $(cat "$log/err")"
fault 2 "--judge" "$psnr" a.png b.png --judge rgb
fault 2 "--judge" "$psnr" a.png b.png --fail-below 3 --judge red

# Colours of one brightness: what luminance does not see stands beside it, and may be judged.
ppm() { printf "P6 4 4 255\n"; for _ in {1..16}; do printf "$1"; done; }
ppm '\xff\0\0' >red.ppm
ppm '\0\x82\0' >green.ppm
expect 0 "$psnr" red.ppm green.ppm --json - --fail-below 60
holds "$(key psnr_db) > 70 && $(key psnr_rgb_db) > 3.7 && $(key psnr_rgb_db) < 3.8"
expect 5 "$psnr" red.ppm green.ppm --fail-below 60 --judge rgb

# 16 bits, 100 of 65535 apart; linear light, unclipped; two depths; numbers that are none.
gray16() { printf 'P5 4 4 65535\n'; for _ in {1..16}; do printf "$1"; done; }
gray16 '\x40\0' >c16.pgm
gray16 '\x40\x64' >d16.pgm
expect 0 "$psnr" c16.pgm d16.pgm --json -
holds "$(key psnr_db) > 56.32 && $(key psnr_db) < 56.34"
is peak 65535
linear() { printf 'Pf\n4 4\n-1.0\n'; for _ in {1..16}; do printf "$1"; done; }
linear '\0\0\0\x40' >two.pfm    # 2
linear '\0\0\x40\x40' >three.pfm  # 3
linear '\0\0\xc0\x7f' >nan.pfm
expect 0 "$psnr" two.pfm three.pfm --json -
holds "$(key psnr_db) == 0"
expect 0 "$psnr" two.pfm three.pfm --json - --peak 10
is psnr_db 20
expect 0 "$psnr" c16.pgm two.pfm --json -
says "$log/out" '.compared_as == "[0, 1]"' && grep -q "compared as reals" "$log/err" || fail "two depths"
fault 1 "nan.pfm: no pixel is finite" "$psnr" two.pfm nan.pfm
{ head -c -4 two.pfm; tail -c 4 nan.pfm; } >hole.pfm
expect 0 "$psnr" two.pfm hole.pfm --json -
is not_finite_px 1
grep -q "hole.pfm: pixels that are not finite in one picture or both, left out (1)" "$log/err" || fail "no word of holes"
expect 5 "$psnr" two.pfm hole.pfm --fail-below 3
fault 2 "--peak" "$psnr" two.pfm three.pfm --peak nan

# Headers that say more than their files hold, and the limit.
printf 'P6 16384 16384 255\nabc' >bomb.ppm
fault 1 "bomb.ppm: header: 16384 x 16384 pixels in" "$psnr" bomb.ppm a.png
fault 1 "more than 299 in all (--max-pixels)" "$psnr" a.png b.png --max-pixels 299
expect 0 "$psnr" a.png b.png --max-pixels 300
fault 2 "--max-pixels" "$psnr" a.png b.png --max-pixels 0

# Folders.
mkdir A B
for i in 1 2 3; do cp a.png "A/$i.png"; cp b.png "B/$i.png"; done
cp a.png B/2.png
expect 0 "$psnr" A B --json -
says "$log/out" '[.pairs[].name] == ["1.png", "2.png", "3.png"] and (.summary | length > 0)' || fail "folders"
cp "$log/out" first
for j in 1 2 8; do
  expect 0 "$psnr" A B --json - -j $j
  cmp -s "$log/out" first || fail "-j $j gives another report"
done
# Progress on a terminal that can write over a line, and there alone.
if command -v script >/dev/null; then
  TERM=xterm script -qec "$psnr A B" /dev/null </dev/null >"$log/out"
  grep -q "pair 3 of 3" "$log/out" || fail "no progress: $(cat "$log/out")"
  for quiet in "TERM=dumb script -qec '$psnr A B' /dev/null" "TERM=xterm script -qec '$psnr A B -q' /dev/null"; do
    bash -c "$quiet" </dev/null >"$log/out"
    ! grep -q "pair 3 of 3" "$log/out" || fail "progress by $quiet"
  done
fi
expect 5 "$psnr" A B --fail-below 60
expect 0 "$psnr" A B --diff D --gain 100
[ -s D/1.png ] && [ -s D/3.png ] || fail "no difference pictures"
expect 0 "$psnr" a.png b.png --diff d.png
expect 0 "$psnr" a.png b.png --diff d2.png
cmp -s d.png d2.png || fail "--diff is not the same twice"
rm B/3.png
fault 1 "has no '3.png'" "$psnr" A B

# Misuse.
fault 2 "TESTED is required" "$psnr" a.png
fault 2 "two pictures or two folders" "$psnr" a.png A
fault 2 "standard input" "$psnr" - -
fault 2 "--gain" "$psnr" a.png b.png --gain nan
fault 2 "--colour" "$psnr" a.png b.png --colour

# Bad input.
fault 1 "missing.png" "$psnr" a.png missing.png
fault 1 "missing: does not exist" "$psnr" A missing
fault 1 "turned.png: is 15 x 20 pixels" "$psnr" a.png turned.png
: >empty.png
fault 1 "empty.png" "$psnr" a.png empty.png
head -c 60 a.png >cut.png
fault 1 "cut.png" "$psnr" a.png cut.png
fault 1 "60000 x 60000 pixels" "$psnr" a.png huge.png
printf 'v 0 0 0\n' >text.png
fault 1 "text.png: is not a PNG" "$psnr" a.png text.png
mkdir E
fault 1 "E: has no pictures" "$psnr" A E

# Indexing maps: the identity against itself in 16 bits, and a coarse level's; inside a chart.
maps() { expect 0 "$psnr" "$@" --index-maps --json report.json -o table.txt; }
maps_say() { says report.json "$1" || fail "not $1: $(cat report.json)"; }
cat >square.obj <<'OBJ'
v 0 0 0
v 2 0 0
v 2 2 0
v 0 2 0
v 0.9 1.2 1
vt 0 0
vt 0.5 0
vt 0.5 1
vt 0 1
vt 0.2 0.6
f 1/1 2/2 5/5
f 2/2 3/3 5/5
f 3/3 4/4 5/5
f 4/4 1/1 5/5
OBJ
"$bin/pmesh" build square.obj --metric qem3 -o square.pm -q
for ending in exr tif; do "$bin/texadapt" square.pm a.png --faces 4 -o fine.$ending -q; done
"$bin/texadapt" square.pm a.png --faces 2 -o coarse.exr -q
maps fine.exr fine.exr
maps_say '.rms_texels == 0 and .share_within_texel == 1 and .texels == 300'
maps fine.exr fine.tif
maps_say '.rms_texels > 0 and .max_texels < 0.001 and .max_texels > 0'
maps fine.exr coarse.exr
maps_say '.rms_texels > 0.5 and .share_within_texel < 0.9'
all=$(jq .rms_texels report.json)
maps fine.exr coarse.exr --inside square.obj
maps_say ".texels == 150 and .rms_texels > 1.2 * $all"  # the other half did not move
expect 0 "$psnr" fine.exr coarse.exr --index-maps
grep -q "RMS texels" "$log/out" || fail "no table: $(cat "$log/out")"
fault 2 "--index-maps" "$psnr" fine.exr coarse.exr --inside square.obj
fault 2 "--fail-below" "$psnr" fine.exr coarse.exr --index-maps --fail-below 3
fault 1 "a.png: is not a TIFF or EXR" "$psnr" fine.exr a.png --index-maps
fault 1 "missing.obj" "$psnr" fine.exr coarse.exr --index-maps --inside missing.obj
sed '/^vt/d; s,/[0-9],,g' square.obj >bare.obj
fault 1 "bare.obj: has no texture coordinates" "$psnr" fine.exr coarse.exr --index-maps --inside bare.obj
sed 's/^vt /vt 7/' square.obj >aside.obj
fault 1 "aside.obj: no texel lies inside" "$psnr" fine.exr coarse.exr --index-maps --inside aside.obj
"$bin/texadapt" square.pm a.png --faces 2 --size 15x20 -o turned.exr -q
fault 1 "turned.exr: is 15 x 20 texels" "$psnr" fine.exr turned.exr --index-maps

# The machine's fault, and nothing left behind.
fault 3 "no/d.png" "$psnr" a.png b.png --diff no/d.png
[ -z "$(find . -name '.tmp-*')" ] || fail "temporaries are left"
echo "psnr.sh: all well"
