#!/usr/bin/env bash
# Types broken bundles, paths and options at play: the right exit code, one line on stderr that names
# the file, nothing written. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"

bake whole

cell=1  # of the path
play() { echo "$bin/play" "$1" --path "${2:-park/path.json}" --no-quality; }
small="--frames 2 --size 64x64 -q"
expect 0 $(play whole) $small --stats x.json
has_keys x.json hybrid_over_frustum
rm x.json

# --- the folder ---
cp -r whole b
cp -r park p
json_faults b/bundle.json $(play b)
json_faults p/path.json $(play whole p/path.json)
fault 1 "nowhere" $(play nowhere)
bundle_fault() {  # TEXT: play says it of b, which is then mended
  fault 1 "$1" $(play b) --modes hybrid $small --stats x
  rm -rf b
  cp -r whole b
}
for file in scene.json ball.off cells.json; do
  rm b/$file
  bundle_fault b/$file
done
sed -i 's/190, 140, 8/180, 140, 8/' b/scene.json
bundle_fault "b/cells.json: scene_hash"
sed -i 's/"scene_hash": "......../"scene_hash": "ffffffff/' b/bundle.json
bundle_fault "b/bundle.json: scene_hash"
sed -i 's/"centres": \[0,/"centres": [999,/' b/bundle.json
bundle_fault "b/bundle.json: centres[0]"
sed -i 's/"cells": \[0,/"cells": [1,/' b/bundle.json
bundle_fault "b/bundle.json: cells[1]"

# --- its binary files ---
geometry=b/cells/cell-0000$cell.geo
for file in $geometry b/centres/centre-00008.tex; do
  size=$(stat -c %s $file)
  rm $file; bundle_fault "$file"
  cp park/ball.off $file; bundle_fault "$file: is not a section file"
  for bytes in 0 100 $((size - 1)); do
    head -c $bytes whole/${file#b/} >$file; bundle_fault "$file"
  done
  overwrite $file 12 '\0377\0377\0377'; bundle_fault "$file: is truncated"
  overwrite $file 34 '\0377'; bundle_fault "$file: its table of sections is damaged"
  for part in 3 4; do
    overwrite $file $((size * part / 5)) '\0125\0252\0125'; bundle_fault "$file: section"
  done
done
cp whole/centres/centre-00008.tex $geometry
bundle_fault "$geometry: is a section file of another kind"

# --- the path ---
expect 0 "$bin/cellpack" park/scene.json cells.json captures sv mv --cells 8-11 -o few
fault 1 "cell $cell" $(play few) $small
path_fault() {  # SED TEXT
  sed "$1" park/path.json >p/path.json
  differ park/path.json p/path.json || fail "no change by $1"
  fault 1 "$2" $(play whole p/path.json) $small
}
path_fault 's/\[100, 60, 8\]/[5000, 60, 8]/' 'leaves the grid'
path_fault 's/"time_s": 1/"time_s": 0/' 'p/path.json: samples[1].time_s'
path_fault 's/\[-1, 0, 0\]/[0, 0, 1]/' 'p/path.json: samples[0].forward'
path_fault 's/\[-1, 0, 0\]/[0, 0, 0]/' 'p/path.json: samples[0].forward'
path_fault 's/\[90, 50, 8\]/[90, 50]/' 'p/path.json: samples[0].eye'
path_fault 's/\[90, 50, 8\]/[90, 50, NaN]/' 'p/path.json: byte'
echo '{"format": "viewcell-path", "version": 1, "samples": []}' >p/path.json
fault 1 "p/path.json: samples: is empty" $(play whole p/path.json)

# --- options, and the machine's fault ---
fault 2 "required" "$bin/play" whole
for options in "--modes film" "--modes hybrid,hybrid" "--modes ," "--reference film" "--size 0x0" \
  "--size 64" "--size 64x32" "--size 9000x9000" "--frames 0" "--frames 1e9" "--gl metal" \
  "--texture-memory 0" "--every 0"; do
  fault 2 "(see play --help)" $(play whole) $options
done
fault 3 "nowhere/x" $(play whole) $small --stats nowhere/x
echo "bad_bundle.sh: all well ($n_faults faults)"
