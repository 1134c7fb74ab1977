#!/usr/bin/env bash
# Types meshshot's commands: pictures, the sheet, the report, frames, exit codes. First argument: the
# folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"

shot=("$bin/meshshot" --size 64 --views 3)

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
for key in made_by triangles frame centre radius reach views eye forward up covered_px timing; do
  grep -q "\"$key\": " "$log/a.json" || fail "no $key in the report"
done
covered=$(grep -o '"covered_px": [0-9]*' "$log/a.json" | grep -o '[0-9]*$' | sort -n)
[ "$(head -n 1 <<<"$covered")" -gt 300 ] || fail "a ball of few pixels: $covered"
[ $(($(tail -n 1 <<<"$covered") - $(head -n 1 <<<"$covered"))) -le 60 ] || fail "covered: $covered"
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
grep -q warning "$log/err" && fail "a warning without reason"
expect 0 "${shot[@]}" moved.off --like ball.off -o far --no-sheet
grep -q "warning: moved.off reaches" "$log/err" || fail "nothing says that the mesh is cut off"
expect 0 "${shot[@]}" square.obj --like ball.off --no-sheet --json - -o up
grep -q '"up": "z"' "$log/out" || fail "--like does not give the up axis"

# Styles change pictures; a texture is one more.
expect 0 "${shot[@]}" square.obj --texture gray.png -o s-texture --no-sheet --json -
grep -q '"up": "y"' "$log/out" || fail "an OBJ has y up"
"${shot[@]}" square.obj --texture - -o s-stdin --no-sheet -q <gray.png || fail "--texture -"
diff -r s-texture s-stdin || fail "--texture - gives other pictures"
previous=s-texture
for style in --unlit --fixed-light --wireframe "--samples 1"; do
  # shellcheck disable=SC2086
  expect 0 "${shot[@]}" square.obj $style -o "s$style" --no-sheet
  diff -qr "s$style" "$previous" >/dev/null && fail "$style gives the pictures of $previous"
  previous=s$style
done

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

# Bad input.
fault 1 "missing.off" "${shot[@]}" missing.off -o x
fault 1 "missing.off" "${shot[@]}" ball.off --like missing.off -o x
fault 1 "ball.off: has no texture coordinates" "${shot[@]}" ball.off --texture gray.png -o x
fault 1 "missing.png" "${shot[@]}" square.obj --texture missing.png -o x
fault 1 "ball.off: is not a PNG" "${shot[@]}" square.obj --texture ball.off -o x
head -c 60 gray.png >cut.png
fault 1 "cut.png" "${shot[@]}" square.obj --texture cut.png -o x
printf 'OFF\n3 1 0\n1 2 3\n1 2 3\n1 2 3\n3 0 1 2\n' >point.off
fault 1 "point.off: has no extent" "${shot[@]}" point.off -o x
fault 1 "--box: has no extent" "${shot[@]}" ball.off --box 1,1,1:1,1,1 -o x
fault 1 "ball.off" "${shot[@]}" ball.off -o ball.off
# A folder with views that would stay is refused before anything is read.
fault 1 "a: has 'view-02.png', which is none of the 2" "$bin/meshshot" ball.off --views 2 -o a
[ "$n_faults" -eq 19 ] || fail "$n_faults faults typed"
[ -z "$(find . -name '.tmp-*')" ] || fail "temporaries are left"
echo "meshshot.sh: all well"
