#!/usr/bin/env bash
# Types uvpatch's commands: counts, files, reports, the same bytes, broken input. First argument: the
# folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
uvpatch=$bin/uvpatch

ball 12 3 >ball.off  # 528 triangles; vertex 0 is the top

# --- words, counts, files ---
expect 0 "$uvpatch" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$uvpatch" ball.off --faces 200 -o a.obj --json -
is faces 200; is euler 1; is flipped 0; is around 0; is component_faces 528; is strength 0.0
[ "$(grep -c '^f ' a.obj)" -eq 200 ] || fail "not 200 faces in the OBJ"
[ "$(grep -c '^v ' a.obj)" -eq "$(key vertices)" ] || fail "vertices"
# A disk with b boundary vertices has 2 v - b - 2 triangles.
[ $((2 * $(key vertices) - $(key boundary_vertices) - 2)) -eq 200 ] || fail "boundary_vertices"
grep -q "L2 stretch" "$log/err" || fail "no summary"
grep -qx "mtllib a.mtl" a.obj && grep -qx "usemtl a" a.obj && grep -qx "newmtl a" a.mtl &&
  grep -qx "map_Kd a.png" a.mtl && [ -s a.png ] || fail "the files do not name each other"
head -n 1 a.obj | grep -q '"tool":"uvpatch"' || fail "no provenance"
[ "$(ls -A | wc -l)" -eq 4 ] || fail "more files than wanted: $(ls -A)"

# --- the same bytes: for any -j; without MTL on stdout ---
mkdir other
for j in 1 2; do  # the first for a new file, the second over it
  expect 0 "$uvpatch" ball.off --faces 200 -o other/a.obj -q -j $j
  [ ! -s "$log/out" ] && [ ! -s "$log/err" ] || fail "-q writes"
  for kind in obj mtl png; do cmp a.$kind other/a.$kind || fail "-j $j gives another $kind"; done
done
expect 0 "$uvpatch" ball.off --faces 200 -o - -q
cmp <(grep '^[vf]' "$log/out") <(grep '^[vf]' a.obj) || fail "another mesh on stdout"
! grep -q mtl "$log/out" || fail "stdout names a material library"
rm -r other

# --- a patch is a disk: it can be read, and cut, again ---
expect 0 "$uvpatch" a.obj --faces all -o b.obj --json - -q
is faces 200; is component_faces 200
expect 0 "$uvpatch" a.obj --faces 150 --around 7 -o b.obj --json - -q
is faces 150; is around 7

# --- distortions, boundary, up, picture ---
for distort in none swirl stretch uniform; do
  expect 0 "$uvpatch" ball.off --faces 200 --distort $distort -o $distort.obj --json - -q
  is flipped 0; is euler 1
  grep '^vt' $distort.obj >$distort.vt
  [ $distort = none ] || differ none.vt $distort.vt || fail $distort
  cmp <(grep '^v ' none.obj) <(grep '^v ' $distort.obj) || fail "$distort moves vertices"
done
expect 0 "$uvpatch" ball.off --faces 200 --distort swirl --strength 0.125 -o b.obj --json - -q
is strength 0.125
expect 0 "$uvpatch" ball.off --faces 200 --distort swirl --strength 10 -o b.obj --json -
grep -q "strength lowered from 10.000 to" "$log/err" || fail "says nothing of a lowered strength"
expect 0 "$uvpatch" ball.off --faces 200 --relax 0 --boundary square -o b.obj --json - -q
grep '^vt' b.obj >b.vt
differ none.vt b.vt || fail "--boundary does nothing"
expect 0 "$uvpatch" ball.off --faces 9 --up -z -o b.obj --json - -q
is around 265
expect 0 "$uvpatch" ball.off --faces 9 --texture-size 64 --squares 4 -o small.obj -q
[ "$(stat -c %s small.png)" -lt "$(stat -c %s a.png)" ] || fail "--texture-size"
expect 0 "$uvpatch" ball.off --faces 9 --texture small.png -o "with blank.obj" -q
cmp small.png "with blank.png" || fail "the picture is not copied"

# --- what cannot be done ---
fault 1 "ball.off: around vertex 0: 528 were asked for: 527 of the component's 528 triangles" \
  "$uvpatch" ball.off --faces 528 -o x.obj
fault 1 "ball.off: around vertex 0: the component is no disk" "$uvpatch" ball.off --faces all -o x.obj
fault 1 "ball.off: vertex 266: does not exist; there are 266" \
  "$uvpatch" ball.off --faces 9 --around 266 -o x.obj
printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n9 9 9\n3 0 1 2\n' >lone.off
fault 1 "lone.off: vertex 3: is no corner" "$uvpatch" lone.off --faces 1 --around 3 -o x.obj
expect 0 "$uvpatch" lone.off --faces all -o b.obj -q
printf 'OFF\n3 1 0\n0 0 0\n0 0 0\n0 1 0\n3 0 1 2\n' >none.off
fault 1 "none.off: has no triangle" "$uvpatch" none.off --faces 1 -o x.obj

# --- misuse ---
for faces in 0 1.5 99999999999999999999; do
  fault 2 "--faces" "$uvpatch" ball.off "--faces=$faces" -o x.obj
done
fault 2 "is required" "$uvpatch" ball.off --faces 9
fault 2 "--around" "$uvpatch" ball.off --faces 9 --around -1 -o x.obj
fault 2 "--strength" "$uvpatch" ball.off --faces 9 --distort swirl --strength nan -o x.obj
fault 2 "--strength is for" "$uvpatch" ball.off --faces 9 --strength 1 -o x.obj
fault 2 "--squares is more" "$uvpatch" ball.off --faces 9 --texture-size 8 -o x.obj
fault 2 "does not end in .obj" "$uvpatch" ball.off --faces 9 -o x.ply
fault 2 "cannot both be standard output" "$uvpatch" ball.off --faces 9 -o - --json -
cat ball.off | "$uvpatch" - --faces 200 -o - -q | cmp - <("$uvpatch" ball.off --faces 200 -o - -q) ||
  fail "a mesh from a pipe"
fault 2 "is the mesh that is read" "$uvpatch" a.obj --faces 9 -o ./a.obj

# --- bad input, and the machine's fault: no file of the set appears ---
fault 1 "missing.off" "$uvpatch" missing.off --faces 9 -o x.obj
head -c 300 ball.off >cut.off
fault 1 "cut.off" "$uvpatch" cut.off --faces 9 -o x.obj
fault 1 "ball.off: is not a PNG" "$uvpatch" ball.off --faces 9 --texture ball.off -o x.obj
head -c 60 a.png >cut.png
fault 1 "cut.png" "$uvpatch" ball.off --faces 9 --texture cut.png -o x.obj
fault 3 "nowhere/x.obj: cannot write: 'nowhere' is no folder" "$uvpatch" ball.off --faces 9 -o nowhere/x.obj
mkdir a_folder.mtl
fault 3 "a_folder.mtl: cannot write: is a folder" "$uvpatch" ball.off --faces 9 -o a_folder.obj
echo "uvpatch.sh: all well ($n_faults faults)"
