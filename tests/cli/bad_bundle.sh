#!/usr/bin/env bash
# Types broken bundles, paths and options at play: the right exit code, one line on stderr that names
# the file, nothing written. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"

bake whole

cell=1  # of the path
play() { echo "$bin/play" "$1" --path "${2:-park/path.json}" --no-quality; }
small="--frames 2 --size 64x64 --texture-memory 8 -q"
expect 0 $(play whole) $small --stats x.json
has_keys x.json hybrid_over_frustum
rm x.json

# --- the folder ---
cp -r whole b
cp -r park p
json_faults b/bundle.json $(play b)
json_faults p/path.json $(play whole p/path.json)
fault 1 "nowhere" $(play nowhere)
whole_bake=$(bake_of whole)
bake=b/${whole_bake#whole/}
mend() {
  rm -rf b
  cp -r whole b
}
bundle_fault() {  # TEXT: play refuses b, and says it; b is then mended
  fault 1 "$1" $(play b) --modes hybrid $small --stats x
  mend
}
for file in scene.json ball.off cells.json; do
  rm $bake/$file
  bundle_fault $bake/$file
  mkfifo b/pipe
  mv b/pipe $bake/$file
  bundle_fault "$file"
done
sed -i 's/190, 140, 8/180, 140, 8/' $bake/scene.json
bundle_fault "$bake/scene.json: is damaged"
sed -i 's/"near": 1.0/"near": 1.5/' $bake/cells.json
bundle_fault "$bake/cells.json: is damaged"
sed -i '4s/^/ /' $bake/ball.off
bundle_fault "$bake/ball.off: is damaged"
sed -i 's/"scene_hash": "......../"scene_hash": "ffffffff/' b/bundle.json
bundle_fault "b/bundle.json: key: is not that of what stands beside it"
sed -i 's/"centres": \[0,/"centres": [/' b/bundle.json
bundle_fault "b/bundle.json: key"
sed -i 's/"cells": \[0,/"cells": [1,/' b/bundle.json
bundle_fault "b/bundle.json: cells[1]"
sed -i 's/"version": 2/"version": 1/' b/bundle.json
bundle_fault "b/bundle.json: version: version 1, this tool reads version 2 to 3: pack the bundle again"

# --- its binary files: play goes on without the one that is damaged, says so once, also with -q, and
# counts it ---
expect 0 $(play b) --modes hybrid $small --stats -
[ ! -s "$log/err" ] || fail "words over a whole bundle: $(cat "$log/err")"
is stand_ins.frames 0
goes_on() {  # COUNT TEXT: of b, which is then mended; COUNT: the key that counts both frames
  expect 0 $(play b) --modes hybrid $small --stats -
  is "stand_ins.$1" 2
  is stand_ins.frames 2
  [ "$(wc -l <"$log/err")" -eq 1 ] && grep -qF -- "play: $2" "$log/err" || fail "no '$2' in: $(cat "$log/err")"
  [ "$(jq -r '.stand_ins.faults | length' "$log/out")" -eq 1 ] || fail "not one fault: $(cat "$log/out")"
  mend
}
for name in cells/cell-0000$cell.geo:damaged_cell centres/centre-00008.tex:damaged_textures; do
  count=${name#*:} file=$bake/${name%:*}
  damaged() { goes_on $count "$file: $1"; }
  whole_file=$whole_bake/${name%:*} size=$(stat -c %s $file)
  rm $file; damaged "cannot open"
  rm $file; mkfifo $file; damaged "is a pipe"
  cp park/ball.off $file; damaged "is not "
  for bytes in 0 100 $((size - 1)); do
    head -c $bytes $whole_file >$file; damaged ""
  done
  { cat $whole_file; echo; } >$file; damaged "1 bytes follow"
  head -c $size /dev/zero >$file; damaged "is not "
  overwrite $file 12 '\0377\0377\0377'; damaged "is truncated"
  overwrite $file 34 '\0377'; damaged "its table of sections is damaged"
  for part in 3 4; do
    overwrite $file $((size * part / 5)) '\0125\0252\0125'; damaged "section"
  done
done
# Files that are whole, but not this bundle's.
cp $whole_bake/centres/centre-00008.tex $bake/cells/cell-0000$cell.geo
goes_on damaged_cell "$bake/cells/cell-0000$cell.geo: is not geometry of a cell"
cp $whole_bake/cells/cell-00000.geo $bake/cells/cell-0000$cell.geo
goes_on damaged_cell "$bake/cells/cell-0000$cell.geo: is of cell 0, not $cell"
cp $whole_bake/centres/centre-00009.tex $bake/centres/centre-00008.tex
goes_on damaged_textures "$bake/centres/centre-00008.tex: is of centre 9, not 8"
expect 0 "$bin/cellpack" park/scene.json cells.json captures sv mv --cells 1,8-11 -o other
cp "$(bake_of other)/cells/cell-0000$cell.geo" $bake/cells
goes_on damaged_cell "$bake/cells/cell-0000$cell.geo: is of another bake"
# What is not needed is not looked at.
rm $bake/cells/cell-00011.geo $bake/centres/centre-00029.tex
expect 0 $(play b) --modes hybrid $small --stats - --no-prefetch
is stand_ins.frames 0
mend

# --- the path ---
expect 0 "$bin/cellpack" park/scene.json cells.json captures sv mv --cells 8-11 -o few
fault 1 "cell $cell" $(play few) $small
path_fault() {  # SED TEXT
  sed "$1" park/path.json >p/path.json
  differ park/path.json p/path.json || fail "no change by $1"
  fault 1 "$2" $(play whole p/path.json) $small
}
path_fault 's/\[90, 50, 8\]/[-9e3, 50, 8]/; s/\[100, 60, 8\]/[5000, 60, 8]/' 'leaves the grid'
path_fault 's/"time_s": 1/"time_s": 0/' 'p/path.json: samples[1].time_s'
path_fault 's/\[-1, 0, 0\]/[0, 0, 1]/' 'p/path.json: samples[0].forward'
path_fault 's/\[-1, 0, 0\]/[0, 0, 0]/' 'p/path.json: samples[0].forward'
path_fault 's/\[90, 50, 8\]/[90, 50]/' 'p/path.json: samples[0].eye'
path_fault 's/\[90, 50, 8\]/[90, 50, NaN]/' 'p/path.json: line 2, column'
path_fault 's/"samples"/"fov_y_deg": 145, "samples"/' 'p/path.json: fov_y_deg: 145 is not within 5.0 to 120.0'
echo '{"format": "viewcell-path", "version": 1, "samples": []}' >p/path.json
fault 1 "p/path.json: samples: is empty" $(play whole p/path.json)

# --- an eye where nothing was baked: the originals, a word and a count ---
off_bake() {  # SED KEY N TEXT: of two frames
  sed "$1" park/path.json >p/path.json
  expect 0 $(play whole p/path.json) --frames 2 --size 64x64 -q --stats -
  is "stand_ins.$2" "$3"
  [ "$(wc -l <"$log/err")" -eq 1 ] && grep -qF "in $3 of 2 frames the eye is $4" "$log/err" ||
    fail "no '$4' in: $(cat "$log/err")"
}
off_bake 's/\[100, 60, 8\]/[100, 60, 25]/' off_height 1 "above or below the heights that were baked (6.00 to 10.00)"
off_bake 's/60, 8\]/60, 2]/; s/50, 8\]/50, 900]/' off_height 2 "above or below"
off_bake 's/\[100, 60, 8\]/[5000, 60, 8]/' off_cells 1 "in no cell that the bundle holds"
# There every picture is that of the reference.
expect 0 "$bin/play" whole --path p/path.json --frames 2 --size 64x64 -q --stats - --modes hybrid
says "$log/out" '.per_frame[1].modes.hybrid | .psnr_db == 100 and .stand_in == "off_cells"' ||
  fail "off the bake: $(cat "$log/out")"

# --- options, and the machine's fault ---
fault 2 "required" "$bin/play" whole
for options in "--modes film" "--modes hybrid,hybrid" "--modes ," "--reference film" "--size 0x0" \
  "--size 64" "--size 64x8" "--fov 200" "--size 9000x9000" "--frames 0" "--frames 1e9" "--gl metal" \
  "--texture-memory 0" "--every 0" "--every 2" "--quality-every 2" "--sheet x.png" "--save x --every 0"; do
  fault 2 "(see play --help)" $(play whole) $options
done
fault 2 "hybrid must be among" "$bin/play" whole --path park/path.json --modes frustum --sheet x.png
fault 3 "nowhere/x" $(play whole) $small --stats nowhere/x

# --- frames are saved without comparing; levels are built for a reference of levels ---
expect 0 $(play whole) $small --save saved
[ "$(find saved -name '*.png' | wc -l)" -eq 4 ] || fail "no frames: $(find saved)"
for modes in frustum,hybrid frustum,lod,hybrid; do
  expect 0 "$bin/play" whole --path park/path.json --modes $modes --reference lod --frames 2 --size 64x64 -q --stats -
  jq '.modes.frustum.psnr_db.mean' "$log/out" >>"$log/references"
done
[ "$(sort -u "$log/references" | wc -l)" -eq 1 ] || fail "--reference lod depends on --modes"
echo "bad_bundle.sh: all well ($n_faults faults)"
