#!/usr/bin/env bash
# Types texadapt at models of several materials, and what it makes of their pictures: JPEG, normal maps,
# sizes, meshes baked onto. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
texadapt=$bin/texadapt pmesh=$bin/pmesh

# A board of 64 x 64 texels as JPEG.
base64 -d >board.jpg <<'JPEG'
/9j/4AAQSkZJRgABAQAAAQABAAD/4QAWRXhpZgAASUkqAAgAAAAAAAAAAAD/2wBDAA0JCgsKCA0LCgsODg0PEyAVExISEyccHhcgLikxMC4pLS
wzOko+MzZGNywtQFdBRkxOUlNSMj5aYVpQYEpRUk//2wBDAQ4ODhMREyYVFSZPNS01T09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09P
T09PT09PT09PT09PT09PT0//wAARCABAAEADASIAAhEBAxEB/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAw
UFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNk
ZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09f
b3+Pn6/8QAHwEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoL/8QAtREAAgECBAQDBAcFBAQAAQJ3AAECAxEEBSExBhJBUQdhcRMiMoEIFEKR
obHBCSMzUvAVYnLRChYkNOEl8RcYGRomJygpKjU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6goOEhYaHiImKkpOUlZaXmJ
maoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4uPk5ebn6Onq8vP09fb3+Pn6/9oADAMBAAIRAxEAPwDja9horx6uT/kY/wB3
l+e/3divgCvYaK8eo/5GP93l+e/3dg+AK9horx6j/kY/3eX57/d2D4Ar2GivHqP+Rj/d5fnv93YPgCvYaK8eo/5GP93l+e/3dg+AK9horx6j/k
Y/3eX57/d2D4Ar2GivHqP+Rj/d5fnv93YPgCvYaK8eo/5GP93l+e/3dg+AK9horx6j/kY/3eX57/d2D4Ar2GivHqP+Rj/d5fnv93YPgCvYaK8e
o/5GP93l+e/3dg+AK9horx6j/kY/3eX57/d2D4Ar2GivHqP+Rj/d5fnv93YPgCvYaK8eo/5GP93l+e/3dg+AK9horx6j/kY/3eX57/d2D4Ar2G
ivHqP+Rj/d5fnv93YPgP/Z
JPEG

# shots MESH TEXTURE FOLDER LIKE [OPTION...]; mean A B: dB over covered pixels.
shots() {
  expect 0 "$bin/meshshot" "$1" --texture "$2" --views 3 --size 192 --like "$4" --no-sheet -q -o "$3" "${@:5}"
}
mean() { "$bin/psnr" "$1" "$2" --no-ssim 2>"$log/psnr" | awk '$1 == "mean" { print $3 }'; }
# gltf FILTER FILE: of a GLB's JSON. textures FILE: each picture of a model, in a line.
gltf() { head -c $((20 + $(od -An -tu4 -j12 -N4 "$2"))) "$2" | tail -c +21 | jq -c "$1"; }
textures() { "$bin/meshinfo" "$1" -q --json - | jq -r '.files[0].textures[] | "\(.width_px) \(.format) \(.used_by)"'; }
bytes() { stat -c %s "$1"; }

ball 24 1 >ball.off
awk 'NR < 3 || NF == 4 { print; next }
  { k = 1 + 0.06 * sin(9 * $1) * sin(9 * $2 + 1); print k * $1, k * $2, k * $3 }' ball.off >bumpy.off
expect 0 "$bin/uvpatch" bumpy.off --faces 900 --texture-size 512 -o patch.obj  # with a check-board
expect 0 "$bin/uvpatch" bumpy.off --faces 900 --texture-size 256 -o small.obj
# patches MATERIAL...: so many patches side by side on the same texture coordinates, a material each; "-":
# one without.
patches() {
  echo "mtllib models.mtl"
  awk -v names="$*" '/^v / { v[++m] = $0 } /^vt/ { t[++n] = $0 } /^f/ { f[++k] = $0 }
    END { for (c = split(names, name, " "); p < c; p++) {
      for (i = 1; i <= m; i++) { split(v[i], w, " "); print "v", w[2] + 3 * p, w[3], w[4] }
      for (i = 1; i <= n; i++) print t[i]
      if (name[p + 1] != "-") print "usemtl " name[p + 1]
      for (i = 1; i <= k; i++) { s = "f"
        for (j = 2; j <= split(f[i], w, " "); j++) { split(w[j], q, "/"); s = s " " q[1] + m * p "/" q[2] + n * p }
        print s } } }' patch.obj
}
cat >models.mtl <<'MTL'
newmtl large
map_Kd patch.png
newmtl little
Kd 1 0 0
map_Kd small.png
newmtl plain
Kd 0 0.5 1
newmtl photo
map_Kd board.jpg
MTL

# Two materials over the same texture coordinates: each picture follows its own triangles, at its own
# size. Seen from the same places, the level is nearer to the input than with the pictures as they were.
patches large little >two.obj
expect 0 "$pmesh" build two.obj --metric mapping -o two.pm
expect 0 "$texadapt" two.pm two.obj --levels 800,240 -o two.glb --json report.json -j1
says report.json '.levels[1].faces <= 240 and .adaptations == .collapses and .charts == 2' ||
  fail "two materials: $(cat report.json)"
[ "$(textures two-240.glb | sort)" = "$(printf "256 png baseColor of 'little'\n512 png baseColor of 'large'")" ] ||
  fail "other pictures: $(textures two-240.glb)"
shots two.obj two.obj original two.obj --unlit
shots two-240.glb two.obj plain two.obj --unlit
shots two-240.glb two-240.glb follows two.obj --unlit
holds "$(mean original follows) > $(mean original plain) + 1" ||
  fail "two materials: $(mean original follows) dB adapted, $(mean original plain) as they were"
mkdir others
expect 0 "$texadapt" two.pm two.obj --levels 240 -o others/two.glb
cmp -s two-240.glb others/two-240.glb || fail "other bytes on all threads, or without a level before"
# Each picture is what the patch makes of it alone, but for the order of collapses.
expect 0 "$texadapt" two.pm two.obj --faces 100000 -o finest.glb
shots finest.glb finest.glb finest two.obj --unlit
holds "$(mean original finest) > 60" || fail "the finest level shows another picture: $(mean original finest) dB"
# A GLB of two materials is one that is read again; rebaked from nearest points it is about as near.
expect 0 "$pmesh" build finest.glb --metric mapping -o again.pm
expect 0 "$texadapt" again.pm finest.glb --faces 240 -o again.glb
shots again.glb again.glb again two.obj --unlit
holds "$(mean original again) > $(mean original plain) + 1" || fail "out of a GLB: $(mean original again) dB"
expect 0 "$texadapt" two.pm two.obj --faces 240 --engine rebake -o rebaked.glb
shots rebaked.glb rebaked.glb rebaked two.obj --unlit
holds "$(mean original rebaked) > $(mean original plain) + 1" || fail "rebaked: $(mean original rebaked) dB"

# Faces of no material, and three materials, one without a picture: they keep their colours.
patches - large plain photo >three.obj
expect 0 "$pmesh" build three.obj --metric mapping -o three.pm
expect 0 "$texadapt" three.pm three.obj --faces 350 --size 512x512 -o three.glb
[ "$(gltf '[.materials[] | [.name, .pbrMetallicRoughness.baseColorTexture.index]] | sort' three.glb)" = \
  '[["default",null],["large",0],["photo",1],["plain",null]]' ] || fail "materials: $(gltf .materials three.glb)"
[ "$(gltf '[.images[].mimeType]' three.glb)" = '["image/png","image/jpeg"]' ] || fail "PNG or JPEG: $(gltf .images three.glb)"
shots three.obj three.obj three-original three.obj --unlit
shots three.glb three.glb three-follows three.obj --unlit
shots three.glb three.obj three-plain three.obj --unlit
holds "$(mean three-original three-follows) > $(mean three-original three-plain) + 1" ||
  fail "three materials: $(mean three-original three-follows) dB, $(mean three-original three-plain) as they were"
# One picture, and faces that show none: a PNG of it, and what it is in a GLB.
patches plain large >one.obj
expect 0 "$pmesh" build one.obj --metric mapping -o one.pm
expect 0 "$texadapt" one.pm one.obj --faces 200 -o one.png --mesh one.ply
expect 0 "$texadapt" one.pm one.obj --faces 200 -o one.glb
shots one.obj one.obj one-original one.obj --unlit
shots one.glb one.glb one-follows one.obj --unlit
shots one.glb one.obj one-plain one.obj --unlit
holds "$(mean one-original one-follows) > $(mean one-original one-plain) + 1" ||
  fail "one picture of two materials: $(mean one-original one-follows) dB"

# A picture that repeats, beside one that does not: refused by name, or left as it is.
n_places=$(grep -c '^vt' patch.obj)
patches large photo | awk -v n="$n_places" '/^vt/ && ++i > n { $2 *= 3; $3 *= 3 } { print }' >tiled.obj
expect 0 "$pmesh" build tiled.obj --metric mapping -o tiled.pm
fault 1 "photo: 1 chart wants a picture that repeats" "$texadapt" tiled.pm tiled.obj --faces 400 -o x.glb
fault 1 "(--keep-repeating leaves such pictures of a .glb as they are)" "$texadapt" tiled.pm tiled.obj --faces 400 -o x.glb
expect 0 "$texadapt" tiled.pm tiled.obj --faces 200 --keep-repeating -o tiled.glb
grep -q 'pictures that repeat, left as they are (1)' "$log/err" || fail "left as it is without a word"
shots tiled.obj tiled.obj tiled-original tiled.obj --unlit
shots tiled.glb tiled.glb tiled-follows tiled.obj --unlit
shots tiled.glb tiled.obj tiled-plain tiled.obj --unlit
holds "$(mean tiled-original tiled-follows) > $(mean tiled-original tiled-plain) + 0.5" ||
  fail "beside tiles: $(mean tiled-original tiled-follows) dB, $(mean tiled-original tiled-plain) as they were"

# JPEG stays JPEG, out of a picture and out of a GLB; no larger for fewer faces; smaller for less quality.
picture_bytes() { gltf '.bufferViews[.images[0].bufferView].byteLength' "$1"; }
expect 0 "$pmesh" build patch.obj --metric mapping -o patch.pm
expect 0 "$texadapt" patch.pm board.jpg --faces 100000 -o jpeg.glb
expect 0 "$pmesh" build jpeg.glb --metric mapping -o jpeg.pm
expect 0 "$texadapt" jpeg.pm jpeg.glb --levels 400,200 -o j.glb
[ "$(gltf '.images[0].mimeType' j-200.glb)" = '"image/jpeg"' ] || fail "JPEG becomes another"
holds "$(bytes j-200.glb) < $(bytes jpeg.glb)" || fail "a coarse level is larger: $(bytes j-200.glb), input $(bytes jpeg.glb)"
holds "$(picture_bytes jpeg.glb) < 1.2 * $(bytes board.jpg)" || fail "the same JPEG is larger: $(picture_bytes jpeg.glb)"
expect 0 "$texadapt" jpeg.pm jpeg.glb --faces 200 --quality 5 -o low.glb
holds "$(picture_bytes low.glb) < 0.8 * $(picture_bytes j-200.glb)" ||
  fail "quality 5: $(picture_bytes low.glb) bytes, its own: $(picture_bytes j-200.glb)"
expect 0 "$texadapt" jpeg.pm jpeg.glb --faces 200 --quality 60 -o same.glb
cmp -s same.glb j-200.glb || fail "the quality of the JPEG, 60, is not the default"
expect 0 "$texadapt" patch.pm patch.png --faces 200 --quality 30 -o png.glb
grep -q -- '--quality changes nothing' "$log/err" || fail "--quality without a JPEG, and no word"
expect 0 "$texadapt" jpeg.pm jpeg.glb --faces 200 -o jpeg.png
LC_ALL=C grep -aq '^.PNG' jpeg.png || fail "-o .png is none"

# Smaller pictures.
expect 0 "$texadapt" two.pm two.obj --faces 400 --texture-size 300 -o size.glb
[ "$(textures size.glb | cut -d' ' -f1 | sort | xargs)" = "256 300" ] || fail "--texture-size 300: $(textures size.glb)"
expect 0 "$texadapt" patch.pm patch.png --faces 200 --texture-size 128 --also small.png=also.png -o size.png --mesh size.ply
[ "$(textures size.ply)" = "128 png " ] || fail "--texture-size of a PNG: $(textures size.ply)"
shots patch.obj patch.png of-patch patch.obj --unlit
expect 0 "$texadapt" patch.pm patch.png --faces 200 -o whole.png --mesh whole.ply
shots whole.ply whole.png whole patch.obj --unlit
shots whole.ply size.png smaller patch.obj --unlit
shots whole.ply patch.png unadapted patch.obj --unlit
holds "$(mean of-patch smaller) > $(mean of-patch unadapted) + 1" || fail "small: $(mean of-patch smaller) dB"

# Normal maps of a model follow it: a bumpy ball whose shading is in its map, without bumps.
expect 0 "$texadapt" patch.pm patch.png --faces 800 --normal-map flat -o mapped.glb
expect 0 "$pmesh" build mapped.glb --metric mapping -o mapped.pm
expect 0 "$texadapt" mapped.pm mapped.glb --faces 200 -o level.glb --json report.json
says report.json '.levels[0].normal_map.texels > 50000' || fail "no normal map: $(cat report.json)"
gltf '.materials[0]' level.glb | grep -q normalTexture || fail "the normal map is not in the GLB"
lit() { expect 0 "$bin/meshshot" "$1" --like mapped.glb --fixed-light --views 3 --size 192 --no-sheet -q -o "$2" "${@:3}"; }
lit mapped.glb lit-original --normal-map mapped.glb#normal
lit level.glb lit-follows --normal-map level.glb#normal
lit level.glb lit-stale --normal-map mapped.glb#normal
lit level.glb lit-none
follows=$(mean lit-original lit-follows)
holds "$follows > $(mean lit-original lit-stale) + 2 && $follows > $(mean lit-original lit-none) + 2" ||
  fail "lit: $follows dB, with the map as it was $(mean lit-original lit-stale), without $(mean lit-original lit-none)"
expect 0 "$texadapt" mapped.pm mapped.glb --faces 200 --no-normal-map -o bare.glb --json report.json
! gltf . bare.glb | grep -q normalTexture || fail "--no-normal-map leaves one in"
says report.json '.remarks[0].what == "normal maps, left out" and .remarks[0].count == 1' || fail "$(cat report.json)"
expect 0 "$texadapt" mapped.pm mapped.glb --faces 200 --engine rebake -o bare.glb
grep -q "normal maps, left out: --engine rebake" "$log/err" || fail "rebake drops a normal map without a word"

# Onto a mesh with texture coordinates: what --faces does. Onto one without: an atlas of its own.
expect 0 "$texadapt" patch.pm patch.png --faces 200 --engine rebake -o r.png --mesh r.ply
expect 0 "$texadapt" patch.pm patch.png --engine rebake --onto r.ply -o onto.png
cmp -s r.png onto.png || fail "--onto a level is another picture than --faces"
expect 0 "$pmesh" build patch.obj --no-texture --metric qem3 -o free.pm
expect 0 "$pmesh" extract free.pm --faces 200 -o free.ply
expect 0 "$texadapt" patch.pm patch.png --engine rebake --onto free.ply -o free.glb --json report.json
says report.json '.faces <= 200 and .levels == [{"faces": .faces}]' || fail "$(cat report.json)"
shots free.glb free.glb free patch.obj --unlit
holds "$(mean of-patch free) > $(mean of-patch unadapted) + 1" || fail "--onto: $(mean of-patch free) dB"
expect 0 "$texadapt" patch.pm patch.png --engine rebake --onto free.ply --size 1024x256 -o free.png --mesh atlas.obj
shots atlas.obj free.png atlas patch.obj --unlit
holds "$(mean of-patch atlas) > $(mean of-patch unadapted) + 1" || fail "--onto, an OBJ: $(mean of-patch atlas) dB"
grep -q "vertices farther than" "$log/err" && fail "a mesh that lies where it should is said to be far"
# Twice as large: its boxes meet, its vertices do not.
awk '/^v / { print "v", 2 * $2, 2 * $3, 2 * $4; next } { print }' atlas.obj >large.obj
expect 0 "$texadapt" patch.pm patch.png --engine rebake --onto large.obj -o large.png
grep -q "large.obj: .*vertices farther than a tenth .* from patch.pm" "$log/err" ||
  fail "--onto a mesh of twice the size: no word: $(cat "$log/err")"
# A mesh whose halves share texels; a plate a little above one: its box does not meet the other's.
awk '/^vt / { u = 2 * $2 - 1; print "vt", (u < 0 ? -u : u), $3; next } { print }' patch.obj >mirrored.obj
fault 1 "mirrored.obj: a chart lies over itself" "$texadapt" patch.pm patch.png --engine rebake --onto mirrored.obj -o x.png
expect 0 "$texadapt" patch.pm patch.png --engine rebake --onto mirrored.obj --allow-overlap -o mirrored.png
# Far from the origin, where the two files have offsets of their own.
far() { awk '/^v / { printf "v %.6f %.6f %s\n", $2 + 500000, $3 + 5200000, $4; next } { print }' "$1"; }
far patch.obj >far.obj
expect 0 "$pmesh" extract free.pm --faces 200 -o free.obj
far free.obj >far-free.obj
expect 0 "$pmesh" build far.obj --metric mapping -o far.pm
expect 0 "$texadapt" far.pm patch.png --engine rebake --onto far-free.obj -o far.png --mesh far.ply
expect 0 "$texadapt" patch.pm patch.png --engine rebake --onto free.obj -o near.png --mesh near.ply
expect 0 "$bin/psnr" near.png far.png --no-ssim --fail-below 30

# Advice, where it changes something.
expect 0 "$pmesh" build patch.obj --metric qem3 -o q.pm
expect 0 "$texadapt" q.pm patch.png --faces 60 -o q.png --json q.json
says q.json '.refused.fold > 0' || fail "no step folds: $(cat q.json)"
grep -q 'pmesh build --no-folds' "$log/err" || fail "no advice: $(cat "$log/err")"
expect 0 "$pmesh" build patch.obj --metric qem3 --no-folds -o q.pm
expect 0 "$texadapt" q.pm patch.png --faces 60 -o q.png
! grep -q -- '--no-folds' "$log/err" || fail "advice that has been followed: $(cat "$log/err")"
expect 0 "$texadapt" patch.pm patch.png --faces 60 -o q.png
! grep -q -- '--no-folds' "$log/err" || fail "advice that changes nothing under --metric mapping"
# An atlas of one chart a triangle keeps them all: the line that says so names what goes on.
awk '/^v/ && !/^vt/ { print } /^f/ { x = int(n / 45) / 45; y = n++ % 45 / 45
    print "vt", x, y; print "vt", x + 0.015, y; print "vt", x, y + 0.015
    split($2, a, "/"); split($3, b, "/"); split($4, c, "/")
    print "f " a[1] "/" 3 * n - 2, b[1] "/" 3 * n - 1, c[1] "/" 3 * n }' patch.obj >atlas1.obj
expect 0 "$pmesh" build atlas1.obj -o atlas1.pm
expect 5 "$texadapt" atlas1.pm patch.png --faces 60 -o atlas1.png
grep -q 'charts, and each keeps a face: pmesh build --no-texture goes on' "$log/err" || fail "$(cat "$log/err")"

# Bad input: one line, nothing written.
f() { fault "$1" "$2" "$texadapt" "${@:3}"; }
for quality in 0 101 -3 much; do f 2 "--quality" jpeg.pm jpeg.glb --faces 200 --quality $quality -o x.glb; done
f 2 "--quality" jpeg.pm jpeg.glb --faces 200 -o x.glb --quality
f 2 "--quality" jpeg.pm jpeg.glb --faces 200 --quality 50 -o x.png
for side in 0 -1 40000 wide; do f 2 "--texture-size" two.pm two.obj --faces 400 --texture-size $side -o x.glb; done
f 2 "--texture-size" patch.pm patch.png --faces 200 --texture-size 64 -o x.exr
f 2 "--no-normal-map" mapped.pm mapped.glb --faces 200 --no-normal-map --normal-map flat -o x.glb
f 2 "--no-normal-map" mapped.pm mapped.glb --faces 200 --no-normal-map -o x.png
f 2 "--engine rebake" patch.pm patch.png --onto free.ply -o x.glb
f 2 "--onto" patch.pm patch.png --engine rebake --onto free.ply --faces 60 -o x.glb
f 2 "--onto" patch.pm patch.png --engine rebake --onto free.ply --levels 60 -o x.glb
f 2 "--onto" patch.pm patch.png --engine rebake -o x.glb --onto
f 2 "gets texture coordinates" patch.pm patch.png --engine rebake --onto free.ply -o x.png
f 2 "--onto is for one picture" two.pm two.obj --engine rebake --onto free.ply -o x.glb
f 2 "some show none" one.pm one.obj --engine rebake --onto free.ply -o x.glb
f 1 "gone.ply" patch.pm patch.png --engine rebake --onto gone.ply -o x.glb
f 1 "patch.png" patch.pm board.jpg --engine rebake --onto patch.png -o x.glb
awk '/^v / { $2 += 8 } { print }' free.obj >aside.obj
f 1 "their boxes do not meet" patch.pm patch.png --engine rebake --onto aside.obj -o x.glb
f 1 "lie over one another" patch.pm patch.png --engine rebake --onto two.obj -o x.glb
f 1 "need a larger picture" patch.pm patch.png --engine rebake --onto free.ply --size 32x32 -o x.glb
f 2 "which -o NAME.glb holds" two.pm two.obj --faces 400 -o x.png
f 2 "--index-map" two.pm two.obj --faces 400 -o x.glb --index-map x.exr
f 2 "--also" two.pm two.obj --faces 400 -o x.glb --also patch.png=y.png
f 2 "--log" two.pm two.obj --faces 400 -o x.glb --log x.adapt
f 2 "--normal-map" two.pm two.obj --faces 400 -o x.glb --normal-map patch.png
f 1 "material 'little' is none of three.obj" two.pm three.obj --faces 400 -o x.glb
sed '/^usemtl/d' two.obj >nameless.obj
expect 0 "$pmesh" build nameless.obj -o nameless.pm
f 1 "its faces have no materials" nameless.pm two.obj --faces 400 -o x.glb
sed '/^mtllib/d' two.obj >bare.obj
f 1 "no material library (mtllib)" two.pm bare.obj --faces 400 -o x.glb
sed 's/^mtllib.*/mtllib gone.mtl/' two.obj >lost.obj
f 1 "gone.mtl" two.pm lost.obj --faces 400 -o x.glb
sed 's/^mtllib.*/mtllib moved.mtl/' two.obj >moved.obj
sed 's/map_Kd small/map_Kd -s 2 2 1 small/' models.mtl >moved.mtl
f 1 "moved.mtl: line 5: map_Kd -s" two.pm moved.obj --faces 400 -o x.glb
sed 's/^vt 0\.\([5-9]\)/vt 3.\1/' two.obj >wide.obj
expect 0 "$pmesh" build wide.obj -o wide.pm
f 1 "large: " wide.pm wide.obj --faces 400 -o x.glb
f 2 "--keep-repeating" wide.pm wide.obj --faces 400 --keep-repeating -o x.png
fault 1 "its faces have no materials" "$bin/meshshot" r.ply --texture two.obj -o x
fault 1 "its material 'little' is none of" "$bin/meshshot" two.obj --texture three.obj -o x
[ ! -e x.png ] && [ ! -e x.glb ] && [ ! -e y.png ] && [ ! -e x.adapt ] || fail "a fault has left a file"
[ "$n_faults" -eq 42 ] || fail "$n_faults faults were tried"
echo "texadapt_materials.sh: $n_faults faults"
