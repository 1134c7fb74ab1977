#!/usr/bin/env bash
# Types meshshot's commands: pictures, the sheet, the report, frames, exit codes. First argument: the
# folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"

shot=("$bin/meshshot" --size 64 --views 3)
hashed() { says "$1" ".made_by.inputs.$2 | test(\"^[0-9a-f]{16}\$\")"; }  # REPORT INPUT

# A ball, the same moved and scaled, one with fewer triangles, a square with texture coordinates.
ball 16 8 >ball.off
awk 'NR < 3 || NF == 4 { print; next } { print 3 * $1 + 20, 3 * $2 - 10, 3 * $3 + 5 }' \
  ball.off >moved.off
ball 5 7 >coarse.off
cat >square.obj <<'OBJ'
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3 4/4
OBJ
base64 -d >gray.png <<<iVBORw0KGgoAAAANSUhEUgAAABQAAAAPCAAAAADB87CJAAAAEUlEQVR42mNIwQIYRgWJEAQAHnt1MQgniOIAAAAASUVORK5CYII=

# The words.
expect 0 "$bin/meshshot" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
grep -q "want --like ORIGINAL" <(tr -s ' \n' ' ' <"$log/out") || fail "--help does not say --like"

# Pictures, the sheet beside the folder, the report.
expect 0 "${shot[@]}" ball.off -o a --json "$log/a.json"
[ "$(ls a)" = "$(printf 'view-%02d.png\n' 0 1 2)" ] || fail "a holds $(ls a)"
[ -s a.sheet.png ] || fail "no contact sheet"
[ ! -s "$log/out" ] || fail "words on stdout"
has_keys "$log/a.json" made_by triangles frame centre radius reach views eye forward up covered_px timing
says "$log/a.json" '[.views[].covered_px] | length == 3 and min > 300 and max - min <= 60' ||
  fail "covered: $(cat "$log/a.json")"
expect 0 "$bin/psnr" a a --fail-below 100
[ "$(wc -l <"$log/out")" -eq 7 ] || fail "psnr takes more than the views"

# The same bytes again, for any number of threads, and under the mesh's own frame.
for more in "-j 1" "-j 2 --like ball.off" "--json - -q"; do
  # shellcheck disable=SC2086
  expect 0 "${shot[@]}" ball.off $more -o again --sheet again.png
  diff -r a again || fail "$more gives other pictures"
  cmp a.sheet.png again.png || fail "$more gives another sheet"
  rm -r again again.png
done
[ ! -s "$log/err" ] || fail "-q writes to stderr"
[ "$(head -c 1 "$log/out")" = "{" ] || fail "--json - is not JSON alone"

# Frames: a mesh in its own, in another's, in a box.
expect 0 "${shot[@]}" moved.off -o moved --no-sheet
[ ! -e moved.sheet.png ] || fail "--no-sheet writes a sheet"
expect 0 "$bin/psnr" a moved --no-ssim --fail-below 60
expect 0 "${shot[@]}" coarse.off -o own --no-sheet
expect 0 "${shot[@]}" coarse.off --like ball.off -o like --no-sheet
expect 5 "$bin/psnr" own like --no-ssim --fail-below 60
expect 0 "${shot[@]}" coarse.off --box -8,-8,-8:8,8,8 -o box --no-sheet
diff -r like box || fail "--box of the original is not --like it"
! grep -q warning "$log/err" || fail "a warning without reason"
expect 0 "${shot[@]}" moved.off --like ball.off -o far --no-sheet
grep -q "warning: moved.off reaches" "$log/err" || fail "nothing says that the mesh is cut off"
expect 0 "${shot[@]}" square.obj --like ball.off --no-sheet --json - -o up
says "$log/out" '.frame.up == "z"' || fail "--like does not give the up axis"

# Styles change pictures; a texture is one more.
expect 0 "${shot[@]}" square.obj --texture gray.png -o s-texture --no-sheet --json -
says "$log/out" '.frame.up == "y"' || fail "an OBJ has y up"
"${shot[@]}" square.obj --texture - -o s-stdin --no-sheet -q <gray.png || fail "--texture -"
diff -r s-texture s-stdin || fail "--texture - gives other pictures"
previous=s-texture
for style in --unlit --fixed-light --wireframe "--samples 1"; do
  # shellcheck disable=SC2086
  expect 0 "${shot[@]}" square.obj $style -o "s$style" --no-sheet
  differ "s$style" "$previous" || fail "$style gives the pictures of $previous"
  previous=s$style
done

# A texture out of a GLB, and through an indexing map: 4 x 2 texels of the identity, one texel that
# holds a corner. (gzip, base64.)
unpack() { base64 -d | gunzip >"$1"; }
unpack square.glb <<<H4sIAAAAAAACA5VUzWsTQRTfthHaQPHuxToHRVnjZjemSS4ln3alZksSihCKTraT7cB+hNnZ2hIDpTfPHrx68iQeBL02iOhF/AM8evA/6EU8+GYz+TAVsQM7875+773f29l13FZtUVGU1wlF+bikKPebVr2PcBgSjgp9dEBYSAMfFZCe0pCKHOIThnnAwOKggYpCGyyooEkpRIV2H/nBXixpu4NddaL1kUfCfYgVRiFKa49Rj3J6IFXMOaOdiAu1j7atptkyrXpcolV9WLasRuWRhgppKE79PWqLOB0SYk4YxW6cX1SgHnZkyk7U7RK2Q8kTVDAglHqkddSDtkdBd3o+cAEIJ4c8YhIUYq/nEjbiFkTMJrJ16ZCUsFOjLhdx+XU9L5L7E0M+tx5zla1Juh32gHDsutRuBJGzD0OLmXrSWMN2PF8oy8b+sS2tog4OSTlwA9YaNSugMAdyKLobiHLYhpmEATvPHVLagdcLfOLz0QDupvWsMEY+vO4MTGA0lp1q2UAxF8hxO53S1HjTUlpMB2q1hT62DdQ/66QvUEdH82j9b2hjgs5O0M1ycavYiN/cFD/LOmbcOeLE6nbjCy3VLeI7HG5iJge5MHOEy8jks/q0lXNQETuLNfT/x+bm6qbnsMY/sHl9Dqvlp4Ql2Rm3rmXg+q+tfYFvumTWYT8+HT1iHW/MyRtSPp3Ks77ZmPFaUMT/YlFZUp5t1++tJq8kQV01NysNOBPiWRYB15+v3IRjJajVwgn22633X+G4alaKreW2/fTVtc/D4csbby9v6t9//Po5PPtUSnxYUC6dJd/VrJMXAmJW65U3pccn0MRv0gUjjKwEAAA=
unpack identity.tif <<<H4sIAAAAAAACA/P01GLgYGBg4GNgYGRmYASyWICYEcpmAmEgG0QLACEzVBykgw3KBmFBRhYwfRSIhZDERZHMEYOyFYBYHKpeGohlkNQbMjIx8APpbUBsi6Q3GOoGRrAIA0NZZmp5cmpOjoKBnqGeAUPFnOSAH/vnH2xsfLjflpm5Iy2AYZJHDUPRc9bdAICxw7HgAAAA
unpack corner.tif <<<H4sIAAAAAAACA/P01GLgYGBg4GNgYGRmYASywBiJzQRkMwFpASBkhoqDdLAhqRFkZAHTR4FYCElcFMoG6ReDshWAWByqnh+IZZDUGzIygcW2AbEtkt5gqBsYwSIMDGWZqeXJqTk5CgZ6hnoGDBVzgOb9/j9LMvUZSzrjfwDqF2K11AAAAA==
square=("$bin/meshshot" square.glb --unlit --size 64 --views 1)
expect 0 "${square[@]}" --texture square.glb -o t-glb --no-sheet --json "$log/t.json"
hashed "$log/t.json" texture || fail "the report does not name the texture"
says "$log/t.json" '.made_by.inputs | has("index_map") and .index_map == null' || fail "a map that was not given"
expect 0 "${square[@]}" --texture square.glb#baseColor -o t-slot --no-sheet
diff -r t-glb t-slot || fail "the base colour is not the GLB's texture"
indexed=("${square[@]}" --texture square.glb --index-map)
expect 0 "${indexed[@]}" identity.tif -o t-identity --no-sheet --json "$log/t.json"
hashed "$log/t.json" index_map || fail "the report does not name the map"
expect 0 "$bin/psnr" t-glb t-identity --no-ssim --json "$log/t.json" --fail-below 48
says "$log/t.json" '[.pairs[].max_abs] | length == 1 and max < 2' || fail "the identity changes colours"
"${indexed[@]}" - -o t-pipe --no-sheet -q -j 1 <identity.tif || fail "--index-map -"
diff -r t-identity t-pipe || fail "--index-map - gives other pictures"
expect 0 "${indexed[@]}" corner.tif -o t-corner --no-sheet
expect 5 "$bin/psnr" t-glb t-corner --no-ssim --fail-below 40

# A normal map: another picture, named by the report, the same from a pipe and through the identity.
lit=("$bin/meshshot" square.glb --size 64 --views 1 --no-sheet)
expect 0 "${lit[@]}" -o n-none --json "$log/n.json"
says "$log/n.json" '.made_by.inputs | has("normal_map") and .normal_map == null' || fail "a normal map that was not given"
expect 0 "${lit[@]}" --normal-map gray.png -o n-up --json "$log/n.json"
hashed "$log/n.json" normal_map || fail "the report does not name the normal map"
"${lit[@]}" --normal-map - --normal-map-y up -o n-pipe -q -j 1 <gray.png || fail "--normal-map -"
diff -r n-up n-pipe || fail "--normal-map - gives other pictures"
expect 0 "${lit[@]}" --normal-map gray.png --normal-map-y down -o n-down --json "$log/n.json"
says "$log/n.json" '.made_by.options.normal_map_y == "down"' || fail "the report does not say where green points"
differ n-up n-down || fail "--normal-map-y changes nothing"
differ n-up n-none || fail "--normal-map changes nothing"
expect 0 "${lit[@]}" --normal-map gray.png --index-map identity.tif -o n-identity
expect 0 "$bin/psnr" n-up n-identity --no-ssim --fail-below 48

# Misuse.
fault 2 "--output is required" "$bin/meshshot" ball.off
fault 2 "-o names a folder" "${shot[@]}" ball.off -o -
fault 2 "--views" "$bin/meshshot" ball.off --views 0 -o x
fault 2 "--size" "$bin/meshshot" ball.off --size 15 -o x
fault 2 "--size times --samples" "$bin/meshshot" ball.off --size 4097 -o x
fault 2 "box '0,0,0:1,1' is not" "${shot[@]}" ball.off --box 0,0,0:1,1 -o x
fault 2 "--box" "${shot[@]}" ball.off --box 0,0,0:1,1,1 --like ball.off -o x
fault 2 "normals 'smooth' are unknown" "${shot[@]}" ball.off --normals smooth -o x
fault 2 "GL engine 'glx'" "${shot[@]}" ball.off --gl glx -o x
fault 2 "--index-map requires --texture" "${shot[@]}" square.glb --index-map identity.tif -o x
fault 2 "--normal-map" "${lit[@]}" --normal-map gray.png --unlit -o x
fault 2 "--normal-map" "${lit[@]}" --normal-map-y down -o x
fault 2 "standard input" "${shot[@]}" square.glb --texture - --index-map - -o x
fault 2 "--json" "${shot[@]}" square.obj --texture square.glb#normal --json square.glb -o x

# Bad input.
fault 1 "missing.off" "${shot[@]}" missing.off -o x
fault 1 "missing.off" "${shot[@]}" ball.off --like missing.off -o x
fault 1 "ball.off: has no texture coordinates" "${shot[@]}" ball.off --texture gray.png -o x
fault 1 "ball.off: has no texture coordinates" "${shot[@]}" ball.off --normal-map gray.png -o x
fault 1 "missing.png" "${lit[@]}" --normal-map missing.png -o x
fault 1 "missing.png" "${shot[@]}" square.obj --texture missing.png -o x
fault 1 "ball.off: is not a PNG" "${shot[@]}" square.obj --texture ball.off -o x
head -c 60 gray.png >cut.png
fault 1 "cut.png" "${shot[@]}" square.obj --texture cut.png -o x
fault 1 "none has a texture in the slot normal" "${shot[@]}" square.glb --texture square.glb#normal -o x
fault 1 "square.glb#skin: is no texture's name" "${shot[@]}" square.glb --texture square.glb#skin -o x
head -c 1100 square.glb >cut.glb
fault 1 "cut.glb" "${shot[@]}" square.obj --texture cut.glb -o x
fault 1 "missing.exr" "${indexed[@]}" missing.exr -o x
fault 1 "gray.png: is not a TIFF or EXR" "${indexed[@]}" gray.png -o x
head -c 100 identity.tif >cut.tif
fault 1 "cut.tif" "${indexed[@]}" cut.tif -o x
noise 3000 >noise.exr
fault 1 "noise.exr" "${indexed[@]}" noise.exr -o x
printf 'OFF\n3 1 0\n1 2 3\n1 2 3\n1 2 3\n3 0 1 2\n' >point.off
fault 1 "point.off: has no extent" "${shot[@]}" point.off -o x
fault 1 "--box: has no extent" "${shot[@]}" ball.off --box 1,1,1:1,1,1 -o x
fault 1 "gray.png" "${shot[@]}" ball.off -o gray.png
# A folder with views that would stay is refused before anything is read.
fault 1 "a: has 'view-02.png', which is none of the 2" "$bin/meshshot" ball.off --views 2 -o a
[ "$n_faults" -eq 33 ] || fail "$n_faults faults typed"
[ -z "$(find . -name '.tmp-*')" ] || fail "temporaries are left"
echo "meshshot.sh: all well"
