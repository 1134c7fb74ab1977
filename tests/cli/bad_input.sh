#!/usr/bin/env bash
# Types broken input at the tools that make and bake parks: the right exit code, one line on stderr
# that names file and place, nothing written. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"

bake whole
cp -r park p
json_faults p/scene.json "$bin/hexcells" p/scene.json -o x
cp cells.json c.json
json_faults c.json "$bin/depthcap" park/scene.json c.json -o x
head -c 500 cells.json >c.json
for tool in svmesh mvmesh; do
  fault 1 "c.json: line" "$bin/$tool" park/scene.json c.json captures -o x
done
fault 1 "c.json: line" "$bin/cellpack" park/scene.json c.json captures sv mv -o x
cp -r captures caps
json_faults caps/captures.json "$bin/svmesh" park/scene.json cells.json caps -o x
json_faults p/path.json "$bin/depthcap" park/scene.json cells.json --cells path:p/path.json -o x
json_faults p/path.json "$bin/hexcells" park/scene.json --svg x.svg --path p/path.json -o x

# --- scene.json: $1 a sed script over the good one, $2 the place and text of the error ---
scene_fault() {
  sed "$1" park/scene.json >p/scene.json
  differ park/scene.json p/scene.json || fail "no change by $1"
  fault 1 "$2" "$bin/hexcells" p/scene.json -o x
}
scene_fault 's/"hi": \[200/"hi": [0/' 'p/scene.json: area'
scene_fault 's/"hi": \[200/"hi": [NaN/' 'p/scene.json: line 2, column'
scene_fault 's/"hi": \[200/"hi": [1e999/' 'p/scene.json'
scene_fault 's/"hi": \[200/"hi": ["wide"/' 'p/scene.json: area.hi[0]: is not a number'
scene_fault 's/\[0.6, 0, 0.8\]/[0.6, 0, 0.9]/' 'light.toward_light: is not a unit vector'
scene_fault 's/"name": "far", "mesh": 0/"name": "far", "mesh": 1/' 'objects[1].mesh'
scene_fault 's/"name": "far", "mesh": 0/"name": "far", "mesh": -1/' 'objects[1].mesh'
scene_fault 's/"name": "far", "mesh": 0/"name": "far", "mesh": 0.5/' 'objects[1].mesh'
scene_fault 's/"mesh": 0, "material": 0/"mesh": 0, "material": 7/' 'objects[0].material'
scene_fault 's/\[0, 0, 0, 1\]/[0, 0, 0, 0]/' 'objects[0].rotation'
scene_fault 's/"rotation": \[0, 0, 0, 1\], "scale": 1/"rotation": [0, 0, 0, 1], "scale": 0/' \
  'objects[0].scale'
scene_fault 's/\[190, 140, 8\]/[190, 140]/' 'objects[1].translation'
scene_fault 's/\[190, 140, 8\]/[1e300, 140, 8]/' 'objects[1].translation[0]'
scene_fault 's/"up": "z"/"up": "w"/' 'meshes[0].up'
scene_fault 's/"sky"/"sea"/' 'p/scene.json: has no "sky"'
scene_fault 's/"up": "z"/"triangles": 3, "up": "z"/' 'meshes[0].triangles'
scene_fault 's/"up": "z"/"hash": "0123456789abcdef", "up": "z"/' 'p/ball.off: mesh file changed'
# Paths that leave the folder.
scene_fault 's/ball.off/..\/park\/ball.off/' "meshes[0].file: path '../park/ball.off' leaves"
scene_fault 's/ball.off/a\/..\/..\/park\/ball.off/' 'leaves'
scene_fault "s|ball.off|$PWD/park/ball.off|" 'is absolute'
scene_fault 's/"ball.off"/""/' 'is empty'
scene_fault 's/"base_color_texture": null/"base_color_texture": "..\/x.png"/' 'leaves'
ln -s ../park/ball.off p/link.off
scene_fault 's/ball.off/link.off/' "path 'link.off' leaves"
ln -s ../park p/linked
scene_fault 's/ball.off/linked\/ball.off/' 'leaves'

# --- mesh files ---
mesh_fault() {  # FILE TEXT: p/FILE as the scene's mesh
  sed "s/ball.off/$1/" park/scene.json >p/scene.json
  fault 1 "$2" "$bin/hexcells" p/scene.json -o x
}
mesh_fault missing.off p/missing.off
mesh_fault linked p/  # a folder
for kind in off ply obj stl glb gltf 3ds ply.gz; do
  : >"p/empty.$kind"
  mesh_fault "empty.$kind" "p/empty.$kind"
  noise 5000 >"p/noise.$kind"
  mesh_fault "noise.$kind" "p/noise.$kind"
done
echo "no mesh of any kind" >p/ball.xyz
mesh_fault ball.xyz p/ball.xyz
triangle='0 0 0\n1 0 0\n0 1 0\n'
printf "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" >p/nan.off
printf "OFF\n3 1 0\n1e39 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" >p/infinite.off
printf "OFF\n3 1 0\n${triangle}3 0 1 3\n" >p/index.off
printf "OFF\n3 1 0\n${triangle}3 0 1 -2\n" >p/negative.off
printf "OFF\n3 0 0\n${triangle}" >p/faceless.off
printf "OFF\n4000000000 1 0\n${triangle}3 0 1 2\n" >p/count.off
printf "OFF\n3 99999999999999999999 0\n${triangle}3 0 1 2\n" >p/faces.off
head -c 6000 park/ball.off >p/cut.off
for name in nan infinite index negative faceless count faces cut; do
  mesh_fault $name.off "p/$name.off"
done
ply() {  # VERTICES FACES FORMAT: a header
  printf 'ply\nformat %s 1.0\nelement vertex %s\nproperty float x\nproperty float y\n' "$3" "$1"
  printf 'property float z\nelement face %s\nproperty list uchar int vertex_indices\n' "$2"
  printf 'end_header\n'
}
{ ply 3 1 ascii; printf "nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"; } >p/nan.ply
{ ply 3 1 ascii; printf "${triangle}3 0 1 3\n"; } >p/index.ply
{ ply 3 0 ascii; printf "$triangle"; } >p/faceless.ply
{ ply 4000000000 1 binary_little_endian; head -c 60 /dev/zero; } >p/count.ply
{ ply 3 4000000000 binary_little_endian; head -c 60 /dev/zero; } >p/faces.ply
{ ply 3 1 binary_little_endian; head -c 40 /dev/zero; } >p/cut.ply
for name in nan index faceless count faces cut; do mesh_fault $name.ply "p/$name.ply"; done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n' >p/nan.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >p/index.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >p/faceless.obj
for name in nan index faceless; do mesh_fault $name.obj "p/$name.obj"; done
{ head -c 80 /dev/zero; printf '\377\377\377\177'; head -c 100 /dev/zero; } >p/count.stl
mesh_fault count.stl p/count.stl
gzip -nc p/nan.ply | head -c 60 >p/cut.ply.gz
mesh_fault cut.ply.gz p/cut.ply.gz
gzip -nc p/nan.ply >p/nan.ply.gz
mesh_fault nan.ply.gz p/nan.ply.gz
# The scene that a later tool reads is checked as well.
sed 's/ball.off/nan.off/' park/scene.json >p/scene.json
fault 1 p/nan.off "$bin/depthcap" p/scene.json cells.json -o x
fault 1 p/nan.off "$bin/cellpack" p/scene.json cells.json captures sv mv -o x

# --- cells.json ---
cells_fault() {
  sed "$1" cells.json >c.json
  differ cells.json c.json || fail "no change by $1"
  fault 1 "$2" "$bin/depthcap" park/scene.json c.json -o x
}
cells_fault 's/"columns": 4/"columns": 10000/' 'c.json: cells: has 12 cells'
cells_fault 's/"columns": 4/"columns": 2e9/' 'c.json: columns'
cells_fault 's/"size": 50.0/"size": -50.0/' 'c.json: size'
cells_fault 's/"inside": \[0\]/"inside": [2]/' 'inside[0]'
cells_fault 's/"inside": \[0\]/"inside": [0, 0]/' 'inside[1]'
cells_fault 's/"id": 3,/"id": 4,/' 'cells[3].id'
cells_fault 's/\[6.0, *10.0\]/[10.0, 6.0]/' 'c.json: eye_height'
cells_fault 's/"scene_hash": "....../"scene_hash": "ffffff/' 'was made for another scene'

# --- lists of cells, slices, numbers ---
for tool in depthcap svmesh mvmesh cellpack; do
  inputs=(park/scene.json cells.json)
  [ $tool = depthcap ] || inputs+=(captures)
  [ $tool = cellpack ] && inputs+=(sv mv)
  command=("$bin/$tool" "${inputs[@]}" -o x)
  fault 1 "cell 12 is out of range" "${command[@]}" --cells 12
  fault 2 "--cells" "${command[@]}" --cells 5-3
  fault 2 "required" "$bin/$tool"
done
command=("$bin/depthcap" park/scene.json cells.json -o x)
fault 1 "cell 2000000000 is out of range" "${command[@]}" --cells 0,3-2000000000
for list in x 1- -1 1.5 99999999999 1--2 , ""; do
  fault 2 "--cells" "${command[@]}" --cells "$list"
done
fault 1 "missing" "${command[@]}" --cells @missing
fault 1 "missing" "${command[@]}" --cells path:missing
noise 500 | tr -d '\n' >"$log/list"
fault 2 "--cells" "${command[@]}" --cells "@$log/list"
fault 2 "--nonsense" "${command[@]}" --nonsense
fault 2 "--threads" "${command[@]}" -j -1
for slice in 0/2 3/2 x 1/0 1/2x -1/2 1; do
  fault 2 "--slice" "${command[@]}" --slice "$slice"
done
for height in 20:16 x 1 nan:3 1:inf 1:2:3 ""; do
  fault 2 "--eye-height" "$bin/hexcells" park/scene.json --eye-height "$height" -o x
done
for size in 0 -5 nan inf 1e9 wide; do
  fault 2 "--size" "$bin/hexcells" park/scene.json --size $size -o x
done
fault 2 "too many" "$bin/hexcells" park/scene.json --size 0.01 -o x
fault 1 "MB of textures, more than --budget" "$bin/depthcap" park/scene.json cells.json --budget 0.01 -o x
fault 2 "--resolution" "$bin/depthcap" park/scene.json cells.json --resolution 1e9 -o x
fault 2 "--far-scale" "$bin/depthcap" park/scene.json cells.json --far-scale nan -o x
fault 2 "--engine" "$bin/depthcap" park/scene.json cells.json --engine guess -o x
fault 2 "--ts" "$bin/svmesh" park/scene.json cells.json captures --ts nan -o x
fault 2 "--tl" "$bin/mvmesh" park/scene.json cells.json captures --tl=-1 -o x

# --- misspelt keys: no error, but a word with what was meant; and what stands at a missing one ---
sed 's/"up": "z"/"up": "z", "substitues": "x"/' park/scene.json >p/scene.json
expect 0 "$bin/hexcells" p/scene.json -o "$log/x" --json "$log/report"
grep -qF "hexcells: p/scene.json: key 'substitues' of a mesh is unknown and passed over; is 'substitutes' meant? (1)" \
  "$log/err" || fail "a misspelt key: $(cat "$log/err")"
says "$log/report" '.remarks[0].count == 1' || fail "no remark in the report"
expect 0 "$bin/hexcells" p/scene.json -o "$log/x" -q
[ ! -s "$log/err" ] || fail "a remark in spite of -q"
sed 's/"up": "z"/"Up": "z"/' park/scene.json >p/scene.json
fault 1 "p/scene.json: meshes[0]: has no \"up\"; is 'Up' it?" "$bin/hexcells" p/scene.json -o x

# --- captures of something else ---
sed 's/190, 140, 8/180, 140, 8/' park/scene.json >p/scene.json
expect 0 "$bin/hexcells" p/scene.json --size 50 --eye-height 6:10 -o other.json
expect 0 "$bin/hexcells" park/scene.json --size 60 --eye-height 6:10 -o large.json
expect 0 "$bin/depthcap" p/scene.json other.json --resolution 128 -o other
fault 1 "made for another scene" "$bin/svmesh" park/scene.json other.json captures -o x
fault 1 "captures of another scene" "$bin/svmesh" p/scene.json other.json captures -o x
fault 1 "captures of other cells" "$bin/mvmesh" park/scene.json large.json captures -o x
fault 1 "captures of another scene" "$bin/cellpack" p/scene.json other.json captures sv mv -o x
first=captures/centre-00007.exr  # of cell 0, which has the far ball outside
cp $first "$log/first.exr"
capture_fault() { fault 1 "$first" "$bin/svmesh" park/scene.json cells.json captures --cells 0 -o x; }
mkdir -p x  # an empty folder may stay behind
cp other/centre-00007.exr $first
capture_fault
grep -q "belongs to another bake" "$log/err" || fail "a capture of another bake: $(cat "$log/err")"
for bytes in 0 3 100 1500 8000 13000; do
  head -c $bytes "$log/first.exr" >$first
  capture_fault
done
cp "$log/first.exr" $first
overwrite $first $(($(stat -c %s $first) - 300)) '\377\376\375'
capture_fault
printf 'v 1 2 3\n' >$first
capture_fault
rm $first
capture_fault
cp "$log/first.exr" $first

# --- cellpack: meshes that do not belong together; no bundle may appear ---
pack_fault() {  # TEXT SVMESH MVMESH [CELLS]
  mkdir -p "$log/bundle"
  fault 1 "$1" "$bin/cellpack" park/scene.json cells.json captures "$2" "$3" \
    --cells "${4:-all}" -o "$log/bundle"
  [ ! -e "$log/bundle/bundle.json" ] || fail "a manifest in spite of $1"
}
expect 0 "$bin/mvmesh" park/scene.json cells.json captures --ts 0.1 -o mv_low
expect 0 "$bin/mvmesh" park/scene.json cells.json captures --ts 1e5 -o mv_high
pack_fault "was derived with other options" sv mv_low
pack_fault "was derived with other options" sv mv_high
pack_fault "is of the other kind" mv sv
cp -r sv bad
mesh=bad/cell-00000.ply
cp sv/cell-00001.ply $mesh
pack_fault "$mesh: header: is of another cell" bad mv 0
fault 1 "$mesh: header: is of another cell: its comment 'cell' says 1, not 0" \
  "$bin/svmesh" park/scene.json cells.json captures --cells 0 -o bad
fault 1 "sv/cell-00000.ply: header: is of the other kind: its comment 'kind' says svmesh, not mvmesh" \
  "$bin/mvmesh" park/scene.json cells.json captures -o sv
for bytes in 0 200 700 900; do
  head -c $bytes sv/cell-00000.ply >$mesh
  pack_fault "$mesh" bad mv 0
done
sed 's/^element vertex .*/element vertex 3999999999/' sv/cell-00000.ply >$mesh
pack_fault "$mesh" bad mv 0
cp park/ball.off $mesh
pack_fault "$mesh" bad mv 0
{ ply 3 1 ascii; printf "${triangle}3 0 1 2\n"; } >$mesh
pack_fault "is not a file of weighted meshes" bad mv 0
cp sv/cell-00000.ply $mesh
overwrite $mesh $(($(stat -c %s $mesh) - 6)) '\377\377'  # the last face's object
pack_fault "$mesh" bad mv 0
rm $mesh
pack_fault "$mesh" bad mv 0
pack_fault "nowhere/cell-00000.ply" nowhere mv

# --- the machine's fault ---
: >in_the_way
fault 3 "in_the_way/cells.json" "$bin/hexcells" park/scene.json -o in_the_way/cells.json
fault 3 "nowhere/cells.json" "$bin/hexcells" park/scene.json -o nowhere/cells.json
fault 3 "park: cannot write: is a folder" "$bin/hexcells" park/scene.json -o park
fault 1 "in_the_way" "$bin/svmesh" park/scene.json cells.json captures -o in_the_way
fault 3 "in_the_way/x" "$bin/mvmesh" park/scene.json cells.json captures -o in_the_way/x
fault 3 "in_the_way/x" "$bin/depthcap" park/scene.json cells.json -o in_the_way/x
fault 3 "in_the_way/x" "$bin/cellpack" park/scene.json cells.json captures sv mv -o in_the_way/x
got=0
"$bin/hexcells" park/scene.json -o - >/dev/full 2>"$log/err" || got=$?
[ $got -eq 3 ] && grep -q "No space left" "$log/err" || fail "a full disk: $got"
# A folder that may not be written into; root may, without giving up that right.
unprivileged() {
  if [ "$(id -u)" -ne 0 ]; then "$@"; else
    setpriv --bounding-set -dac_override,-dac_read_search "$@"
  fi
}
mkdir locked
chmod 500 locked
for command in "hexcells park/scene.json -o locked/cells.json" \
  "depthcap park/scene.json cells.json -o locked/x"; do
  got=0
  # shellcheck disable=SC2086  # words
  unprivileged "$bin/"$command 2>"$log/err" || got=$?
  [ $got -eq 3 ] && [ "$(wc -l <"$log/err")" -eq 1 ] && grep -q "locked.*Permission denied" "$log/err" ||
    fail "a locked folder: $got $(cat "$log/err")"
done
[ -z "$(ls -A locked)" ] || fail "a locked folder has something in it"

# --- parkgen ---
fault 2 "--preset" "$bin/parkgen" --preset 16m -o x
fault 2 "-o FOLDER" "$bin/parkgen"
fault 2 "--seed" "$bin/parkgen" --seed many -o x
fault 1 "nowhere" "$bin/parkgen" --models nowhere -o x
mkdir models
ball 4 1 >models/horse.off
printf '{"format": "viewcell-models", "version": 1, "models": [{"name": "horse", "file": "horse.off"}]}' \
  >models/models.json
optional=yes json_faults models/models.json "$bin/parkgen" --models models -o x
models_fault() {
  printf '{"format": "viewcell-models", "version": 1, "models": [%s]}' "$1" >models/models.json
  fault 1 "models/models.json: models[0]" "$bin/parkgen" --models models -o x
}
models_fault '{"name": "unicorn", "file": "horse.off"}'
models_fault '{"name": "horse", "file": "../park/ball.off"}'
models_fault '{"name": "horse", "file": "horse.off", "up": "q"}'
echo "bad_input.sh: all well ($n_faults faults)"
