#!/usr/bin/env bash
# A level of another program becomes a scene that is baked and played with its pictures. First
# argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"

# A yard of 30 m: a floor with a picture, a block of two materials, a post. y is up.
ball 12 3 >ball.off
expect 0 "$bin/uvpatch" ball.off --faces 60 --texture-size 64 -o checker.obj
cat >yard.mtl <<'X'
newmtl floor
Kd 1 1 1
map_Kd checker.png
newmtl red
Kd 0.8 0.1 0.1
newmtl blue
Kd 0.1 0.1 0.8
X
{
  echo mtllib yard.mtl
  echo "v -15 0 15"; echo "v 15 0 15"; echo "v 15 0 -15"; echo "v -15 0 -15"
  for height in 0 3; do
    echo "v 3 $height -3"; echo "v 5 $height -3"; echo "v 5 $height -5"; echo "v 3 $height -5"
  done
  for height in 0 2; do
    echo "v -4 $height 2"; echo "v -3.5 $height 2"; echo "v -3.5 $height 1.5"; echo "v -4 $height 1.5"
  done
  echo "vt 0 0"; echo "vt 10 0"; echo "vt 10 10"; echo "vt 0 10"
  echo usemtl floor; echo "f 1/1 2/2 3/3 4/4"
  for first in 5 13; do
    a=$first b=$((first + 1)) c=$((first + 2)) d=$((first + 3)) e=$((first + 4)) f=$((first + 5)) g=$((first + 6)) h=$((first + 7))
    echo usemtl red; echo "f $a $b $f $e"; echo "f $b $c $g $f"
    echo usemtl blue; echo "f $c $d $h $g"; echo "f $d $a $e $h"; echo "f $e $f $g $h"
  done
} >yard.obj

expect 0 "$bin/sceneimport" yard.obj --piece 10 -o yard --json report.json
says report.json '.triangles > 20 and .objects == 18 and .pictures == 1 and .components == 3'
says report.json '(.floor_m | fabs) < 1e-6'
says report.json '.components_cut == 1 and (.size_m[0] - 30 | fabs) < 1e-6'
cmp -s yard/textures/000.png checker.png || fail "the picture is not as it was"
says yard/scene.json '.version == 2 and ([.materials[].name] | index("red")) != null'
cp -r yard yard_1
expect 0 "$bin/sceneimport" yard.obj --piece 10 -o yard -j 1
diff -r yard yard_1 >"$log/diff" || fail "again, it is another scene"

# Centimetres, z up, a pipe: the same place.
awk '/^v /{print "v", 100*$2, -100*$4, 100*$3; next} {print}' yard.obj >yard_cm.obj
expect 0 "$bin/sceneimport" yard_cm.obj --piece 10 --unit cm --up z -o yard_cm --json cm.json
says cm.json '(.size_m[0] - 30 | fabs) < 1e-4 and (.size_m[2] - 3 | fabs) < 1e-4'

# A floor 5 m up comes to the same place, and one that is named to where it is named.
awk '/^v /{print "v", $2, $3 + 5, $4; next} {print}' yard.obj >yard_up.obj
expect 0 "$bin/sceneimport" yard_up.obj --piece 10 -o yard_up --json up.json
says up.json '(.floor_m - 5 | fabs) < 1e-5'
expect 0 "$bin/sceneimport" yard_up.obj --piece 10 --floor 4 -o yard_four --json four.json
says four.json '.floor_m == 4'

# A wide plain: some thousand pieces, far ones about places of their own, which every tool takes.
awk 'BEGIN{n=60; for(i=0;i<=n;i++)for(j=0;j<=n;j++)printf "v %d %.3f %d\n",20*i,2*sin(i)*cos(j),20*j;
  for(i=0;i<n;i++)for(j=0;j<n;j++){a=i*(n+1)+j+1;printf "f %d %d %d\nf %d %d %d\n",a,a+1,a+n+2,a,a+n+2,a+n+1}}' >plain.obj
expect 0 "$bin/sceneimport" plain.obj -o plain --json plain.json
says plain.json '.piece_m > 30 and .objects > 500 and .objects < 2000 and (.size_m[0] - 1200 | fabs) < 0.01'
says plain/scene.json '[.objects[].translation[0]] | max - min > 1000'
expect 0 "$bin/hexcells" plain/scene.json --size 300 -o plain_cells.json --json plain.json
[ ! -s "$log/err" ] || ! grep -q "offsets\|cracks" "$log/err" || fail "remarks on what sceneimport wrote: $(cat "$log/err")"

# Far from the origin heights are the file's, too.
awk '/^v /{printf "v %.1f %.1f %.1f\n", 4000000 + $2, $3 + 5000000, 4000000 + $4; next} {print}' yard.obj >yard_far.obj
expect 0 "$bin/sceneimport" yard_far.obj --piece 10 -o yard_far --json far.json
says far.json '(.floor_m - 5000000 | fabs) < 0.01 and (.size_m[0] - 30 | fabs) < 0.01 and .objects > 10'

# Through the whole chain, with its pictures.
cat >path.json <<'X'
{"format": "viewcell-path", "version": 1, "samples": [
 {"time_s": 0, "eye": [-30, -30, 10], "forward": [1, 0, 0]},
 {"time_s": 1, "eye": [-20, -20, 10], "forward": [0, 1, 0]}]}
X
expect 0 "$bin/hexcells" yard/scene.json --size 50 -o cells.json --json cells_report.json
says cells_report.json ".own_mean > 3 and .inside_mean > 0"
says cells.json ".version == 2 and ([.cells[].own // [] | length] | add) > 100"
expect 0 "$bin/hexcells" yard/scene.json --size 50 --choose paper -o - -q
says "$log/out" ".version == 1"
fault 2 "--choose" "$bin/hexcells" yard/scene.json --choose best -o x
# A walk over the yard, around what stands there; to a place, and not to one.
expect 0 "$bin/walkpath" yard/scene.json cells.json --seconds 6 -o walk.json --json walk_report.json
says walk_report.json '.seconds == 6 and .room_share > 0.8 and .room_share < 1'
says walk.json '[.samples[].eye[2]] | all((. - 18 | fabs) < 0.01)'
expect 0 "$bin/walkpath" yard/scene.json cells.json --through 100,-100 --through -100,100 -o - -q
says "$log/out" '(.samples[0].eye[0] - 100 | fabs) < 3 and (.samples[-1].eye[1] - 100 | fabs) < 3'
cp "$log/out" one
expect 0 "$bin/walkpath" yard/scene.json cells.json --through 100,-100 --through -100,100 -o - -q -j 1
cmp -s "$log/out" one || fail "threads make another walk"
# Pictures of it before any bake: all of it, as a map, from the walk, from an eye; the same again.
is_picture() {  # FILE WIDTH HEIGHT: a PNG of that size, in which more is than one colour
  [ "$(head -c 24 "$1" | tail -c 8 | od -An -tu1 -w8 | awk '{print $3*256+$4, $7*256+$8}')" = "$2 $3" ] || fail "$1 is not $2 x $3"
  [ "$(stat -c %s "$1")" -gt 2000 ] || fail "$1 shows nothing"
}
draw=("$bin/scenedraw" yard/scene.json -q)
expect 0 "${draw[@]}" --cells cells.json --path walk.json --size 320x200 -o corner.png --json draw.json
is_picture corner.png 320 200
says draw.json '.objects > 10 and .triangles > 30 and .width_px == 320'
expect 0 "${draw[@]}" --cells cells.json --path walk.json --size 320x200 -o - -j 1
cmp -s "$log/out" corner.png || fail "threads draw another picture"
expect 0 "${draw[@]}" --from above --size 200x200 -o above.png
is_picture above.png 200 200
expect 0 "${draw[@]}" --from eye --path walk.json --at 2 --size 160x90 -o eye.png
is_picture eye.png 160 90
expect 0 "${draw[@]}" --from eye --eye=-60,-60,18 --toward 45,45,15 --size 160x90 --fov 40 -o eye.png
is_picture eye.png 160 90
fault 2 "--eye X,Y,Z" "${draw[@]}" --from eye -o x
fault 2 "is not X,Y,Z" "${draw[@]}" --from eye --eye 1,2 --toward 0,0,0 -o x
fault 2 "straight above" "${draw[@]}" --from eye --eye 1,2,3 --toward 1,2,9 -o x
fault 2 "--size" "${draw[@]}" --size 8x8 -o x
fault 1 "was made for another scene" "$bin/scenedraw" yard_cm/scene.json --cells cells.json -o x

# What the cells see: of the cells of the walk; again the same, with one thread, from a pipe.
mv cells.json grid.json
expect 0 "$bin/pvs" yard/scene.json grid.json --cells path:path.json -o cells.json --json pvs.json
says pvs.json '.cells == 1 and .rays_per_cell > 10000 and .unseen_share >= 0 and .unseen_share < 0.8'
says cells.json '.version == 2 and .seen_by.method == "rays" and ([.cells[] | select(has("unseen"))] | length) == 1'
expect 0 "$bin/pvs" yard/scene.json grid.json --cells path:path.json -j 1 -o - -q
cmp -s "$log/out" cells.json || fail "threads see other things"
fault 1 "was not tested for what it sees" "$bin/depthcap" yard/scene.json cells.json --resolution 256 -o x
fault 2 "--eyes" "$bin/pvs" yard/scene.json grid.json --eyes 1 -o x
expect 0 "$bin/depthcap" yard/scene.json cells.json --cells path:path.json --resolution 256 -o captures
expect 0 "$bin/svmesh" yard/scene.json cells.json captures --cells path:path.json -o sv
expect 0 "$bin/mvmesh" yard/scene.json cells.json captures --cells path:path.json -o mv
expect 0 "$bin/cellpack" yard/scene.json cells.json captures sv mv --cells path:path.json -o bundle
rm -r yard
expect 0 "$bin/play" bundle --path path.json --frames 6 --size 160x160 --modes frustum,raycast,hybrid --reference frustum --stats stats.json --save frames --save-alpha
says stats.json '[.. | objects | select(.mode? == "raycast") | .psnr_covered_db?] | map(select(. != null)) | length == 0 or min > 40'

# Faults.
cp -r yard_1 yard
fault 2 "is not X,Y" "$bin/walkpath" yard/scene.json cells.json --through here -o x
fault 1 "was made for another scene" "$bin/walkpath" yard_cm/scene.json cells.json -o x
fault 1 "cannot open" "$bin/sceneimport" none.glb -o x
fault 2 "--unit" "$bin/sceneimport" yard.obj --unit feet -o x
fault 2 "--up" "$bin/sceneimport" yard.obj --up w -o x
fault 2 "--piece" "$bin/sceneimport" yard.obj --piece 0 -o x
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >flat.obj
fault 1 "pieces" "$bin/sceneimport" yard.obj --unit 10000 --piece 8 -o x
fault 1 "no area" "$bin/sceneimport" flat.obj -o x
# An OBJ's picture with holes makes a mask that is seen from both sides; one with alpha 255 does not.
cp frames/frustum/frame-00000.png leaf.png
sed 's/checker.png/leaf.png/' yard.mtl >leaf.mtl
sed 's/yard.mtl/leaf.mtl/' yard.obj >leaf.obj
expect 0 "$bin/sceneimport" leaf.obj -o leafy --json leafy.json
grep -q "pictures have holes, drawn as masks, both sides (1)" "$log/err" || fail "$(cat "$log/err")"
says leafy/scene.json '[.materials[] | select(.alpha == "mask" and .double_sided)] | length == 1'
says yard_1/scene.json '[.materials[] | select(.alpha == "mask")] | length == 0'

# Pictures and libraries that are missing or broken: the material's colour, said by name.
left_out() {  # TEXT
  expect 0 "$bin/sceneimport" yard.obj -o left_out --json left.json
  grep -qF "$1" "$log/err" || fail "no '$1': $(cat "$log/err")"
  says left.json '.pictures == 0 and .materials > 1'
}
mv checker.png away.png
left_out "checker.png: cannot open"
head -c 100 away.png >checker.png
left_out "checker.png"
mv away.png checker.png
mv yard.mtl away.mtl
expect 0 "$bin/sceneimport" yard.obj -o left_out --json left.json
grep -q "libraries that are not there (1)" "$log/err" || fail "$(cat "$log/err")"
grep -v mtllib yard.obj >bare.obj
expect 0 "$bin/sceneimport" bare.obj -o left_out --json left.json
says left.json '.pictures == 0 and .objects > 10'
[ "$n_faults" -eq 16 ] || fail "$n_faults faults were tried"
echo "sceneimport.sh: all well"
