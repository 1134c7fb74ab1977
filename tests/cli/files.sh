#!/usr/bin/env bash
# Types at every tool an output over an input, one over another output, and one whose folder is not
# there: an error before the work, and nothing changed. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
sources=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../tools" && pwd)
start "$1"

# over_input, over_output TEXT TOOL ARGUMENT...: exit code 2; nowhere TOOL ARGUMENT...: 3.
declare -A tried
clash() {  # KIND TEXT TOOL ARGUMENT...
  tried[$1/$3]=yes
  fault 2 "$2" "$bin/$3" "${@:4}"
}
over_input() { clash input "$@"; }
over_output() { clash output "$@"; }
nowhere() {
  tried[nowhere/$1]=yes
  fault 3 "'no' is no folder" "$bin/$1" "${@:2}"
}

bake bundle
ball 8 3 >ball.off
ln -s ball.off link.off
ln ball.off hard.off
mkdir folder
expect 0 "$bin/uvpatch" ball.off --faces 100 -o patch.obj
expect 0 "$bin/pmesh" build patch.obj --metric mapping -o patch.pm
cp patch.png patch-40.png
for name in A B; do
  mkdir $name
  cp patch.png $name/1.png
done
printf 'x,y\n1,2\n2,3\n' >table.csv
cp table.csv table.svg
scene=(park/scene.json cells.json)

# --- parkgen ---
mkdir -p m/meshes
ball 4 1 >m/horse.off
cp m/horse.off m/meshes
over_input "-o is the folder of models that is read" parkgen --models m -o m
over_input "-o would write over the folder of models" parkgen --models m/meshes -o m
over_input "--json would write over the folder of models" parkgen --models m -o x --json m/horse.off
over_output "-o and --json would write the same file" parkgen -o x --json x/scene.json
over_output "-o and --json would write the same file" parkgen -o x --json x/meshes/horse.ply
over_output "-o and --json are one file" parkgen -o x --json ./x
nowhere parkgen -o x --json no/x.json

# --- sceneimport, walkpath, pvs, scenedraw ---
over_input "-o is the level that is read" sceneimport ball.off -o ball.off
over_input "--json is the level that is read" sceneimport ball.off -o x --json ball.off
over_output "-o and --json would write the same file" sceneimport ball.off -o x --json x/scene.json
nowhere sceneimport ball.off -o x --json no/x.json
mkdir textures
cp patch.png textures/000.png
sed 's|patch.png|textures/000.png|' patch.mtl >textured.mtl
sed 's|patch.mtl|textured.mtl|' patch.obj >textured.obj
over_input "-o would write over a picture of the level" sceneimport textured.obj -o .
rm -r textures textured.*
over_input "-o is the scene that is read" walkpath "${scene[@]}" -o park/scene.json
over_input "--json is the file of cells" walkpath "${scene[@]}" -o x --json cells.json
over_output "-o and --json are one file" walkpath "${scene[@]}" -o x --json x
nowhere walkpath "${scene[@]}" -o no/x
over_input "-o is the scene that is read" pvs "${scene[@]}" -o park/scene.json
over_input "-o is the file of cells" pvs "${scene[@]}" -o cells.json
over_output "-o and --json are one file" pvs "${scene[@]}" -o x --json x
nowhere pvs "${scene[@]}" -o no/x
over_input "-o is the scene that is read" scenedraw park/scene.json -o park/scene.json
over_input "-o is the file of cells" scenedraw park/scene.json --cells cells.json -o cells.json
over_output "-o and --json are one file" scenedraw park/scene.json -o x --json x
nowhere scenedraw park/scene.json -o no/x

# --- hexcells: by other spellings and links, too ---
ln -s scene.json park/link.json
ln -s park linked
ln park/scene.json hard.json
for file in park/scene.json ./park/../park/scene.json "$PWD/park/scene.json" park/link.json \
  linked/scene.json folder/../linked/link.json hard.json; do
  over_input "-o is the scene that is read" hexcells park/scene.json -o "$file"
  over_input "-o is the scene that is read" hexcells "$file" -o park/scene.json
  over_input "--svg is the scene that is read" hexcells park/scene.json -o x --svg "$file"
  over_input "--json is the scene that is read" hexcells park/scene.json -o x --json "$file"
done
over_input "-o is the path that is read" hexcells park/scene.json --path park/path.json -o park/path.json
over_input "-o is a mesh of the scene" hexcells park/scene.json -o park/ball.off
over_output "-o and --svg are one file" hexcells park/scene.json -o x --svg ./x
over_output "-o and --json are one file" hexcells park/scene.json -o folder/x --json folder/../folder/x
over_output "-o and --json cannot both be standard output" hexcells park/scene.json -o - --json -
over_output "--json and --svg cannot both be standard output" \
  hexcells park/scene.json -o x --json /dev/stdout --svg -
nowhere hexcells park/scene.json -o no/x
nowhere hexcells park/scene.json -o x --svg no/x.svg
fault 3 "folder: cannot write: is a folder" "$bin/hexcells" park/scene.json -o folder

# --- depthcap ---
mkdir c
cp cells.json c/captures.json
echo 0 >list
over_input "-o is the scene that is read" depthcap "${scene[@]}" -o park/scene.json
over_input "-o would write over the file of cells" depthcap park/scene.json c/captures.json -o c
over_input "--json is the file of cells" depthcap "${scene[@]}" -o x --json cells.json
over_input "--json is the file of --cells" depthcap "${scene[@]}" --cells @list -o x --json list
over_input "--json is the file of --cells" \
  depthcap "${scene[@]}" --cells path:park/path.json -o x --json park/path.json
over_input "--json is a mesh of the scene" depthcap "${scene[@]}" -o x --json park/ball.off
over_output "-o and --json would write the same file" depthcap "${scene[@]}" -o x --json x/captures.json
over_output "-o and --json would write the same file" depthcap "${scene[@]}" -o x --json x/centre-00007.exr
fault 2 "-o names a folder" "$bin/depthcap" "${scene[@]}" -o -
nowhere depthcap "${scene[@]}" -o x --json no/x.json

# --- svmesh, mvmesh ---
ln -s captures linked_captures
for tool in svmesh mvmesh; do
  for folder in captures ./captures/ folder/../captures linked_captures; do
    over_input "-o is the folder of captures" $tool "${scene[@]}" captures -o $folder
    over_input "-o is the folder of captures" $tool "${scene[@]}" $folder -o captures
  done
  over_input "-o is the file of cells" $tool "${scene[@]}" captures -o cells.json
  over_input "--json would write over the folder of captures" \
    $tool "${scene[@]}" captures -o x --json captures/centre-00007.exr
  over_input "--json is the scene" $tool "${scene[@]}" captures -o x --json park/scene.json
  over_input "--json is a mesh of the scene" $tool "${scene[@]}" captures -o x --json linked/ball.off
  over_output "-o and --json would write" $tool "${scene[@]}" captures -o x --json x/cell-00003.ply
  over_output "-o and --json are one file" $tool "${scene[@]}" captures -o x --json x
  nowhere $tool "${scene[@]}" captures -o x --json no/x.json
done

# --- cellpack ---
for folder in captures sv mv; do
  over_input "-o is the folder of" cellpack "${scene[@]}" captures sv mv -o $folder
done
over_input "-o would write over the scene" cellpack "${scene[@]}" captures sv mv -o park
over_input "-o would write over the scene" cellpack "${scene[@]}" captures sv mv -o .
over_input "--json would write over the folder of MVMeshes" \
  cellpack "${scene[@]}" captures sv mv -o x --json mv/cell-00001.ply
over_input "--json is a mesh" cellpack "${scene[@]}" captures sv mv -o x --json park/ball.off
over_output "-o and --json would write" cellpack "${scene[@]}" captures sv mv -o x --json x/bundle.json
nowhere cellpack "${scene[@]}" captures sv mv -o x --json no/x.json

# --- play ---
played=(bundle --path park/path.json --frames 2 --size 64x64)
for option in --json --stats --table --sheet; do
  over_input "$option is the path that is read" play "${played[@]}" $option park/path.json
  over_input "$option would write over the bundle" play "${played[@]}" $option bundle/bundle.json
  nowhere play "${played[@]}" $option no/x
done
for option in --save --plots; do
  over_input "$option is the bundle" play "${played[@]}" $option bundle
  over_input "$option is the path that is read" play "${played[@]}" $option park/path.json
done
over_output "--stats and --table are one file" play "${played[@]}" --stats x --table x
over_output "--json and --stats cannot both be standard output" play "${played[@]}" --stats - --json -
over_output "--plots and --sheet would write" play "${played[@]}" --plots x --sheet x/psnr.svg
over_output "--save and --stats would write" \
  play "${played[@]}" --save x --stats x/frustum/frame-00001.png

# --- pmesh ---
for file in ball.off link.off hard.off; do
  over_input "--json is the mesh that is read" pmesh build ball.off -o x.pm --json $file
  over_input "--json is the mesh that is read" pmesh build $file -o x.pm --json ball.off
done
cp patch.pm patch.ply
over_input "-o is the progressive mesh" pmesh extract patch.ply --faces 50 -o patch.ply
over_input "--json is the progressive mesh" pmesh info patch.pm --json patch.pm
over_output "-o and --json are one file" pmesh build ball.off -o x.pm --json x.pm
over_output "cannot both be standard output" pmesh extract patch.pm --faces 50 -o - --json -
nowhere pmesh build ball.off -o no/x.pm
nowhere pmesh extract patch.pm --faces 50 -o no/x.ply
nowhere pmesh info patch.pm --json no/x.json

# --- meshshot ---
mkdir shots
cp patch.png shots/view-00.png
textured=(meshshot patch.obj --texture patch.png)
over_input "-o is the mesh that is read" meshshot ball.off -o ball.off
over_input "-o would write over the texture" meshshot patch.obj --texture shots/view-00.png -o shots
over_input "--sheet is the texture" "${textured[@]}" -o x --sheet patch.png
over_input "--sheet is the normal map" "${textured[@]}" --normal-map A/1.png -o x --sheet A/1.png
over_input "--json is the mesh of --like" "${textured[@]}" --like ball.off -o x --json hard.off
over_output "-o and --sheet would write" meshshot ball.off -o x --sheet x/view-03.png
over_output "--json and --sheet are one file" meshshot ball.off -o x --json x.sheet.png
nowhere meshshot ball.off -o x --sheet no/x.png

# --- texadapt ---
level=(texadapt patch.pm patch.png --faces 40)
over_input "-o is the texture" "${level[@]}" -o patch.png
over_input "-o is the texture" texadapt patch.pm patch-40.png --levels 60,40 -o patch.png
over_input "--also is a texture" "${level[@]}" -o x.png --also A/1.png=A/1.png
over_input "--normal-map is the normal map" "${level[@]}" -o x.png --normal-map A/1.png=./A/1.png
over_input "--mesh is the progressive mesh" texadapt patch.ply patch.png --faces 40 -o x.png --mesh patch.ply
over_input "--json is the progressive mesh" "${level[@]}" -o x.png --json patch.pm
over_output "-o and --also are one file" "${level[@]}" -o x.png --also A/1.png=x.png
over_output "--also and --also are one file" "${level[@]}" -o x.png --also A/1.png=y.png --also B/1.png=y.png
over_output "--json and --mesh are one file" "${level[@]}" -o x.png --mesh x.ply --json x.ply
over_output "--json and --log are one file" "${level[@]}" -o x.png --log x.adapt --json x.adapt
nowhere "${level[@]}" -o no/x.png

# --- meshdist, uvpatch, subdivide ---
over_input "-o is A" meshdist ball.off patch.obj -o link.off
over_input "--json is B" meshdist ball.off patch.obj --json patch.obj
over_output "--json and --color are one file" meshdist ball.off patch.obj --color x.ply --json x.ply
nowhere meshdist ball.off patch.obj --color no/x.ply
over_input "-o is the mesh that is read" uvpatch patch.obj --faces 9 -o patch.obj
over_input "the .png beside -o is the texture" uvpatch ball.off --faces 9 --texture patch.png -o patch.obj
over_input "--json is the texture" uvpatch ball.off --faces 9 --texture patch.png -o x.obj --json patch.png
cp ball.off x.mtl
over_input "the .mtl beside -o is the mesh" uvpatch x.mtl --faces 9 -o x.obj
rm x.mtl
over_output "--json and the .mtl beside -o are one file" uvpatch ball.off --faces 9 -o x.obj --json x.mtl
over_output "--json and the .png beside -o are one file" uvpatch ball.off --faces 9 -o x.obj --json x.png
nowhere uvpatch ball.off --faces 9 -o no/x.obj
over_input "-o is the mesh that is read" subdivide patch.obj --times 1 -o folder/../patch.obj
over_output "-o and --json are one file" subdivide patch.obj --times 1 -o x.obj --json x.obj
nowhere subdivide patch.obj --times 1 -o no/x.obj

# --- meshinfo ---
over_input "-o is mesh ball.off, which is read" meshinfo ball.off -o hard.off
over_input "--json is mesh patch.obj" meshinfo ball.off patch.obj --json patch.obj
over_output "-o and --json are one file" meshinfo ball.off -o x --json x
nowhere meshinfo ball.off -o no/x

# --- contactsheet, plot, psnr ---
over_input "-o is picture A/1.png, which is read" contactsheet patch.png A/1.png -o ./A/1.png
over_input "--json is picture patch.png" contactsheet patch.png A/1.png -o x.png --json patch.png
over_output "-o and --json are one file" contactsheet patch.png -o x.png --json x.png
nowhere contactsheet patch.png -o no/x.png
over_input "-o is the table" plot table.svg --x x --y y -o table.svg
over_output "-o and --json are one file" plot table.csv --x x --y y -o x.svg --json x.svg
nowhere plot table.csv --x x --y y -o no/x.svg
over_input "--diff is REFERENCE" psnr A/1.png patch.png --diff A/1.png
over_input "-o is TESTED" psnr A/1.png patch.png -o patch.png
over_input "--diff is REFERENCE" psnr A B --diff A
over_input "--diff is TESTED" psnr A B --diff folder/../B
over_input "--json would write over REFERENCE" psnr A B --json A/1.png
over_output "--json and --diff are one file" psnr A/1.png B/1.png --diff x.png --json x.png
over_output "-o and --diff would write" psnr A B --diff x -o x/1.png
over_output "cannot both be standard output" psnr A B -o - --json -
nowhere psnr A/1.png B/1.png --diff no/x.png
nowhere psnr A B --json no/x.json

for main in "$sources"/*/main.cpp; do
  tool=$(basename "$(dirname "$main")")
  for kind in input output nowhere; do
    [ -n "${tried[$kind/$tool]-}" ] || fail "$tool: not tried ($kind)"
  done
done

# What is not over anything still goes: folders made on the way, beside and around inputs; devices.
expect 0 "$bin/svmesh" "${scene[@]}" captures -o new/folder/sv --json new/folder/report.json
expect 0 "$bin/svmesh" "${scene[@]}" captures -o captures/sv
expect 0 "$bin/depthcap" "${scene[@]}" --resolution 64 --cells 0 -o park --json park/report.json
expect 0 "$bin/play" "${played[@]}" --save frames --plots frames --stats frames/stats.json
expect 0 "$bin/psnr" A B --diff A/difference --json A/report.json
expect 0 "$bin/psnr" A/1.png A/1.png -o /dev/null --json /dev/null --diff /dev/null
expect 0 "$bin/texadapt" patch.pm patch.png --levels 60,40 -o fresh.png --also A/1.png=other.png
expect 0 "$bin/pmesh" info patch.pm --json -
echo "files.sh: all well ($n_faults faults)"
