#!/usr/bin/env bash
# Types subdivide's commands: counts, reports, formats, pipes, the same bytes, broken input. First
# argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
subdivide=$bin/subdivide

# Two triangles of a square, the corners of one edge twice, in two charts with a gap between them.
cat >square.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 0.4 0
vt 0.4 0.4
vt 0.5 0.5
vt 0.9 0.9
vt 0.5 0.9
usemtl red
f 1/1 2/2 3/3
usemtl blue
f 4/4 5/5 6/6
OBJ

# --- words, counts, files ---
expect 0 "$subdivide" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$subdivide" square.obj --times 2 -o a.obj --json -
is faces_in 2; is faces 32; is vertices 25; is welded 2; is dropped 0; is flipped.after 0; is drift.compared 32; is drift.elsewhere 0
grep -q "32 triangles, 25 vertices" "$log/err" || fail "no summary"
[ "$(grep -c '^f ' a.obj)" -eq 32 ] && [ "$(grep -c '^v ' a.obj)" -eq 25 ] || fail "counts of the OBJ"
[ "$(grep -c '^vt ' a.obj)" -eq 30 ] || fail "charts are joined: $(grep -c '^vt ' a.obj)"
[ "$(grep ^usemtl a.obj | tr '\n' ' ')" = "usemtl red usemtl blue " ] || fail "materials"
head -n 1 a.obj | grep -q '"options":{"times":2,"scheme":"loop","texcoords":"inside"}' || fail "provenance"
grep -qx "vt 0 0" a.obj && ! grep -qx "v 0 0 0" a.obj || fail "corners of charts stay, of the border not"
expect 0 "$subdivide" square.obj --times 1 --texcoords smooth -o b.obj -q
! grep -qx "vt 0 0" b.obj || fail "--texcoords smooth keeps corners"
expect 0 "$subdivide" square.obj --times 1 --scheme midpoint -o b.obj -q
for corner in "0 0 0" "1 0 0" "0.5 0.5 0"; do grep -qx "v $corner" b.obj || fail "no v $corner"; done
expect 0 "$subdivide" square.obj --times 0 -o b.obj -q
[ "$(grep -c '^v ' b.obj)" -eq 4 ] && [ "$(grep -c '^vt ' b.obj)" -eq 6 ] || fail "--times 0"

# --- the same bytes, other formats, pipes ---
for j in 1 2; do
  expect 0 "$subdivide" square.obj --times 2 -o b.obj -q -j $j
  [ ! -s "$log/out" ] && [ ! -s "$log/err" ] && cmp a.obj b.obj || fail "-j $j"
done
expect 0 "$subdivide" square.obj --times 2 -o - -q
cmp a.obj "$log/out" || fail "another mesh on stdout"
"$subdivide" - --times 2 -o - -q <square.obj | cmp - a.obj || fail "a mesh from stdin"
ball 6 1 >ball.off
expect 0 "$subdivide" ball.off --times 1 -o ball.ply --json - -q
is faces 480; is vertices 242
! grep -q flipped "$log/out" || fail "turned triangles of no texture"
expect 0 "$subdivide" ball.ply --times 1 -o ball.PLY --json - -q
is faces 1920

# --- what cannot be done, misuse ---
fault 1 "ball.off: 120 triangles become more than 100000000 when subdivided 10 times" \
  "$subdivide" ball.off --times 10 -o x.obj
printf 'OFF\n3 1 0\n0 0 0\n0 0 0\n0 1 0\n3 0 1 2\n' >none.off
fault 1 "none.off: has no triangle of three different positions" "$subdivide" none.off --times 1 -o x.obj
fault 1 "missing.obj" "$subdivide" missing.obj --times 1 -o x.obj
head -c 60 square.obj >cut.obj
fault 1 "cut.obj" "$subdivide" cut.obj --times 1 -o x.obj
for times in -1 1.5 14 many; do fault 2 "--times" "$subdivide" ball.off "--times=$times" -o x.obj; done
fault 2 "--times is required" "$subdivide" ball.off -o x.obj
fault 2 "is required" "$subdivide" ball.off --times 1
fault 2 "--scheme" "$subdivide" ball.off --times 1 --scheme catmull -o x.obj
fault 2 "--texcoords" "$subdivide" ball.off --times 1 --texcoords none -o x.obj
fault 2 "does not end in .ply or .obj or .stl or .off or .glb" "$subdivide" ball.off --times 1 -o x.xyz
fault 2 "the mesh that is read" "$subdivide" square.obj --times 1 -o square.obj
fault 3 "nowhere/x.obj" "$subdivide" ball.off --times 1 -o nowhere/x.obj
echo "subdivide.sh: all well ($n_faults faults)"
