#!/usr/bin/env bash
# Types pmesh's commands and holds exit codes, streams, reports and bytes. First argument: the folder
# of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
pmesh=$bin/pmesh

ball 24 1 >ball.off
# A square grid in relief, with texture coordinates.
awk 'BEGIN {
  n = 16
  for (y = 0; y <= n; y++) for (x = 0; x <= n; x++)
    printf "v %g %g %g\nvt %g %g\n", x, y, sin(x) * cos(y * 0.7), x / n, y / n
  for (y = 0; y < n; y++) for (x = 0; x < n; x++) {
    a = y * (n + 1) + x + 1; b = a + 1; c = a + n + 1; d = c + 1
    printf "f %d/%d %d/%d %d/%d\nf %d/%d %d/%d %d/%d\n", a, a, b, b, d, d, a, a, d, d, c, c
  }
}' >relief.obj

expect 0 "$pmesh" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$pmesh" --version

# Every metric: built, asked about, taken out at a size, and whole again.
for metric in qem3 qem5 aps mapping lt; do
  expect 0 "$pmesh" build relief.obj --metric $metric -o $metric.pm --json report.json
  grep -q "512 -> " "$log/err" || fail "no summary: $(cat "$log/err")"
  has_keys report.json faces_in faces_base collapses refused timing cost_evaluations
  expect 0 "$pmesh" info $metric.pm
  says "$log/out" ".faces == 512 and ([.. | objects | .metric? | strings] | index(\"$metric\") != null)" ||
    fail "info $metric: $(cat "$log/out")"
  expect 0 "$pmesh" extract $metric.pm --faces 100 -o $metric-100.ply --json report.json
  says report.json '.faces == 99 or .faces == 100' || fail "100 faces: $(cat report.json)"
  expect 0 "$pmesh" extract $metric.pm --faces 100000 -o $metric-all.ply
  cmp -s $metric-all.ply qem3-all.ply || fail "$metric: the finest level is not the input"
  expect 0 "$pmesh" build relief.obj --metric $metric -o again.pm -q
  [ ! -s "$log/err" ] || fail "words on stderr with -q"
  cmp -s again.pm $metric.pm || fail "$metric: other bytes the second time"
done
expect 0 "$pmesh" build relief.obj --metric mapping --measure mean -o mean.pm
differ mean.pm mapping.pm || fail "--measure mean changes nothing"
expect 0 "$pmesh" build relief.obj --metric mapping --error incremental -o step.pm
differ step.pm mapping.pm || fail "--error incremental changes nothing"

# A bound is a distance that meshdist does not pass.
for metric in qem3 lt "mapping --placement full"; do
  # shellcheck disable=SC2086  # options are words
  expect 0 "$pmesh" build relief.obj --metric $metric --bounded 0.2 -o bounded.pm --json report.json
  says report.json '.refused.bound > 0' || fail "$metric: the bound refused nothing"
  expect 0 "$pmesh" extract bounded.pm --faces 1000000 -o whole.ply
  base=$("$pmesh" info bounded.pm | jq .faces_base)
  expect 0 "$pmesh" extract bounded.pm --faces "$base" -o coarse.ply --json report.json
  says report.json '.timing.level_s > 0' || fail "no timing"
  says report.json '0.1 <= .error_bound and .error_bound <= 0.2' || fail "error_bound: $(cat report.json)"
  expect 0 "$bin/meshdist" whole.ply coarse.ply --samples 20000 --fail-above 0.2
done
# Without refusing anything.
expect 0 "$pmesh" build relief.obj --metric lt --stop-at 100 -o plain.pm
expect 0 "$pmesh" build relief.obj --metric lt --stop-at 100 --track-error -o tracked.pm
for name in plain tracked; do
  expect 0 "$pmesh" extract $name.pm --faces 100 -o $name.ply --json $name.json
done
cmp -s plain.ply tracked.ply || fail "--track-error changes the mesh"
says plain.json 'has("error_bound") and .error_bound == null' || fail "a bound from nowhere"
bound=$(jq .error_bound tracked.json)
holds "$bound > 0" || fail "no bound of the tracked mesh"
expect 0 "$bin/meshdist" whole.ply tracked.ply --samples 20000 --fail-above "$bound"

# The coarsest level within a distance: its bound is not above, that of the next coarser is.
expect 0 "$pmesh" extract tracked.pm --within 0.1 -o near.ply --json level.json
near=$(jq .faces level.json)
says level.json '0 < .error_bound and .error_bound <= 0.1' || fail "--within: $(cat level.json)"
expect 0 "$bin/meshdist" whole.ply near.ply --samples 20000 --fail-above 0.1
expect 0 "$pmesh" extract tracked.pm --faces $((near - 1)) -o x.ply --json level.json
says level.json '.error_bound > 0.1' || fail "--within is not the coarsest: $(cat level.json)"
expect 0 "$pmesh" extract tracked.pm --within 1e9 -o x.ply --json level.json
says level.json '.faces == 99 or .faces == 100' || fail "--within 1e9 is not the base: $(cat level.json)"
expect 0 "$pmesh" info tracked.pm
is error_bound_base "$bound"
expect 0 "$pmesh" info plain.pm
says "$log/out" 'has("error_bound_base") and .error_bound_base == null' || fail "error_bound_base from nowhere: $(cat "$log/out")"
rm x.ply

# A target that cannot be reached is said, with the reasons, and what there is is written.
expect 5 "$pmesh" build ball.off --stop-at 2 -o stuck.pm
[ "$(wc -l <"$log/err")" -eq 1 ] && grep -q "ball.off: 2 faces were asked for, .* by link" "$log/err" ||
  fail "stuck: $(cat "$log/err")"
cp stuck.pm stuck-2.pm
expect 5 "$pmesh" build ball.off --stop-at 1 -o stuck.pm
grep -q "ball.off: 1 faces were asked for" "$log/err" || fail "stuck at 1: $(cat "$log/err")"
expect 0 "$pmesh" info stuck.pm
expect 5 "$pmesh" extract stuck.pm --faces 1 -o few.ply
grep -q "its base has" "$log/err" || fail "too few: $(cat "$log/err")"
expect 0 "$pmesh" build ball.off --stop-at 300 -o some.pm
expect 0 "$pmesh" info some.pm
is faces_base 300
expect 0 "$pmesh" build ball.off --stop-at 0.01 -o cheap.pm

# From pipes.
expect 0 "$pmesh" build ball.off --stop-at 300 -o piped.pm
for from in - /dev/stdin; do
  "$pmesh" build $from --stop-at 300 -o again.pm -q <ball.off || fail "build $from"
  cmp piped.pm again.pm || fail "build $from: other bytes"
  cat ball.off | "$pmesh" build $from --stop-at 300 -o again.pm -q || fail "build $from"
  cmp piped.pm again.pm || fail "build $from: other bytes from a pipe"
  cat piped.pm | "$pmesh" extract $from --faces 400 -o again.ply -q || fail "extract $from"
  cat piped.pm | "$pmesh" info $from >info.json || fail "info $from"
  "$pmesh" info piped.pm | cmp - info.json || fail "info $from differs"
done
expect 0 "$pmesh" build <(cat ball.off) --stop-at 300 -o again.pm
cmp piped.pm again.pm || fail "build <(): other bytes"
expect 0 "$pmesh" extract <(cat piped.pm) --faces 400 -o piped.ply
cmp piped.ply again.ply || fail "extract <(): other bytes"
for ((cut = 0; cut < 3000; cut += 700)); do
  fault 1 "/dev/fd/" "$pmesh" extract <(head -c $cut piped.pm) --faces 400 -o x.ply
done

# To a pipe, and from a kilometre to a nanometre.
"$pmesh" extract some.pm --faces 400 -o - -q | head -c 3 | grep -q ply || fail "-o -"
for size in 1e30 1e-30; do
  ball 12 $size >sized.off
  expect 0 "$pmesh" build sized.off --metric lt --stop-at 100 -o sized.pm
  expect 0 "$pmesh" extract sized.pm --faces 100 -o sized.ply
done
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >one.off
expect 0 "$pmesh" build one.off -o one.pm
expect 0 "$pmesh" extract one.pm --faces 1 -o one.ply

# A room with lamps: they go before it does, and come back; --keep-pieces keeps them.
{ ball 24 20
  for lamp in 1 2 3 4 5 6 7 8; do ball 8 0.05 | awk -v at=$lamp 'NR > 2 && NF == 3 { $1 += at; $2 += at - 3 } 1'; done
} | awk '$1 == "OFF" { getline; first += n; n = $1; next } NF == 3 { v[++nv] = $0; next }
  { f[++nf] = $1 " " $2 + first " " $3 + first " " $4 + first }
  END { print "OFF"; print nv, nf, 0; for (i = 1; i <= nv; i++) print v[i]; for (i = 1; i <= nf; i++) print f[i] }' >lamps.off
expect 0 "$pmesh" build lamps.off --track-error -o lamps.pm --json report.json
grep -q "lamps.off: pieces, .* vanish whole .*--keep-pieces keeps them) (8)" "$log/err" || fail "not said: $(cat "$log/err")"
says report.json '.pieces == 9 and .pieces_vanished == 8' || fail "pieces: $(cat report.json)"
expect 0 "$pmesh" info lamps.pm
is pieces_vanished_base 8
expect 0 "$pmesh" extract lamps.pm --faces 200 -o lamps.ply --json report.json
grep -q "lamps.pm: pieces have vanished whole at this level (8)" "$log/err" || fail "not said: $(cat "$log/err")"
says report.json '.pieces_vanished == 8' || fail "pieces: $(cat report.json)"
expect 0 "$bin/meshdist" lamps.off lamps.ply --samples 20000 --fail-above "$(jq .error_bound report.json)"
expect 0 "$pmesh" extract lamps.pm --faces 100000 -o lamps.ply --json report.json
says report.json '.pieces_vanished == 0 and (has("remarks") | not)' || fail "pieces: $(cat report.json)"
expect 0 "$bin/meshdist" lamps.off lamps.ply --samples 20000 --fail-above 0.000001
expect 0 "$pmesh" build lamps.off --bounded 1 -o lamps.pm --json report.json
says report.json '.pieces_vanished == 0 and .refused.bound >= 8' || fail "vanished: $(cat report.json)"
expect 0 "$pmesh" build lamps.off --keep-pieces -o lamps.pm --json report.json
says report.json '.pieces_vanished == 0' || fail "vanished: $(cat report.json)"

# Charts hold collapses back, unless texture coordinates are left out.
awk '/^vt/ { next } /^f/ { n += 3; print "vt", n, 0; print "vt", n + 1, 0; print "vt", n, 1
  gsub("/[0-9]*", ""); print "f", $2 "/" n - 2, $3 "/" n - 1, $4 "/" n; next } 1' relief.obj >cut.obj
expect 5 "$pmesh" build cut.obj --stop-at 100 -o cut.pm
grep -q "by chart.*; --no-texture leaves charts out" "$log/err" || fail "not held back: $(cat "$log/err")"
expect 0 "$pmesh" build cut.obj --stop-at 100 --no-texture -o uncut.pm
# An atlas of one chart a triangle: whatever the metric says of refusals, charts are named.
ball 12 1 | awk 'NR > 2 && NF == 3 { print "v", $0 }
  NR > 2 && NF == 4 { x = int(n / 30) / 30; y = n++ % 30 / 30
    print "vt", x, y; print "vt", x + 0.02, y; print "vt", x, y + 0.02
    print "f " $2 + 1 "/" 3 * n - 2, $3 + 1 "/" 3 * n - 1, $4 + 1 "/" 3 * n }' >atlas.obj
for metric in qem3 mapping; do
  expect 0 "$pmesh" build atlas.obj --metric $metric -o atlas.pm --json atlas.json
  grep -q "528 -> 528 faces" "$log/err" || fail "$metric: an atlas of triangles collapses: $(cat "$log/err")"
  says atlas.json '.remarks[0].count == 528 and (.remarks[0].what | test("hold collapses back: .*--no-texture.*--engine rebake --onto"))' ||
    fail "$metric: charts are not named: $(cat atlas.json)"
done
expect 0 "$pmesh" build atlas.obj --metric qem5 -o atlas.pm
grep -q "back: --metric qem3 --no-texture" "$log/err" || fail "qem5 needs coordinates"
expect 0 "$pmesh" build atlas.obj --no-texture -o atlas.pm --json atlas.json
says atlas.json 'has("remarks") | not' || fail "charts are named without a texture"

# --flip-v turns v, and turns it back.
expect 0 "$pmesh" build relief.obj --metric mapping -o straight.pm
expect 0 "$pmesh" build relief.obj --metric mapping --flip-v -o turned.pm
expect 0 "$pmesh" extract turned.pm --faces 512 -o turned.obj
differ straight.pm turned.pm || fail "--flip-v does nothing"
expect 0 "$pmesh" build turned.obj --metric mapping --flip-v -o again.pm
expect 0 "$pmesh" extract again.pm --faces 512 -o again.obj
expect 0 "$pmesh" extract straight.pm --faces 512 -o straight.obj
cmp -s <(grep '^vt' straight.obj) <(grep '^vt' again.obj) || fail "--flip-v twice is not the identity"
expect 0 "$pmesh" info uncut.pm
says "$log/out" '.texture_coordinates == false' || fail "texture left: $(cat "$log/out")"
# Triangles that turn over in the texture, on request.
awk '/^vt/ { print "vt", $2 + 0.1 * sin(37 * $3), $3; next } 1' relief.obj >wavy.obj
expect 0 "$pmesh" build wavy.obj --no-folds -o nofolds.pm --json report.json
says report.json '.refused.fold > 0' || fail "no fold refused: $(cat report.json)"

# Bad input: one line, nothing written.
for metric in qem5 aps mapping; do
  fault 1 "ball.off: has no texture coordinates" "$pmesh" build ball.off --metric $metric -o x.pm
done
fault 2 "placement" "$pmesh" build ball.off --metric lt --placement half -o x.pm
# Half of the faces without texture coordinates.
awk '/^f / && ++n % 2 == 0 { gsub("/[0-9/]*", "") } { print }' relief.obj >half.obj
expect 0 "$pmesh" build half.obj --metric aps -o x.pm
grep -q "faces without area in the texture, by which metric aps measures" "$log/err" ||
  fail "aps: faces without texture coordinates are not said: $(cat "$log/err")"
fault 2 "placement" "$pmesh" build relief.obj --metric aps --placement full -o x.pm
fault 2 "mapping with --placement full" \
  "$pmesh" build relief.obj --metric mapping --error incremental --placement full -o x.pm
fault 2 "is no metric" "$pmesh" build ball.off --metric best -o x.pm
fault 2 "needs -o" "$pmesh" build ball.off
fault 2 "needs -o" "$pmesh" extract some.pm --faces 400
for stop in 0 -3 many 1e 0.0 +5 0x10 " 500" 5e2 1e9 500f . .e3 1.5e 1.5e99 -0.5 0x1.8 nan 4000000001 ""; do
  fault 2 "--stop-at '$stop' is neither" "$pmesh" build ball.off --stop-at "$stop" -o x.pm
done
for faces in -1 0 1.5 99999999999999999999999 4000000001 +5 ""; do
  fault 2 "--faces" "$pmesh" extract some.pm --faces "$faces" -o x.ply
done
for within in -1 nan x ""; do fault 2 "--within" "$pmesh" extract some.pm --within "$within" -o x.ply; done
fault 2 "needs --faces or --within" "$pmesh" extract some.pm -o x.ply
fault 2 "--within" "$pmesh" extract some.pm --faces 9 --within 1 -o x.ply
fault 1 "some.pm: has no error bounds; pmesh build --track-error" "$pmesh" extract some.pm --within 1 -o x.ply

# Nothing is written over what is read, or twice.
ln -s some.pm link.pm
ln ball.off hard.pm
fault 2 "-o is the mesh that is read" "$pmesh" build hard.pm -o ./hard.pm
fault 2 "-o is the mesh that is read" "$pmesh" build ball.off -o hard.pm
fault 2 "--json is the mesh that is read" "$pmesh" build ball.off -o x.pm --json ./ball.off
fault 2 "-o is the progressive mesh that is read" "$pmesh" extract whole.ply --faces 5 -o whole.ply
fault 2 "--json is the progressive mesh that is read" "$pmesh" extract some.pm --faces 5 -o x.ply --json link.pm
fault 2 "--json is the progressive mesh that is read" "$pmesh" info link.pm --json some.pm
fault 2 "-o and --json are one file" "$pmesh" build ball.off -o x.pm --json ./x.pm
fault 2 "cannot both be standard output" "$pmesh" build ball.off -o - --json -
rm link.pm hard.pm
# Endings tell what is written.
fault 2 "-o is a progressive mesh: it does not end in .pm" "$pmesh" build ball.off -o x.ply
fault 2 "it does not end in .ply or .obj or .stl or .off or .glb" "$pmesh" extract some.pm --faces 100 -o x.xyz
expect 0 "$pmesh" build ball.off -o /dev/null
expect 0 "$pmesh" extract some.pm --faces 400 -o some.obj
expect 0 "$pmesh" extract some.pm --faces 400 -o some.ply
[ "$(grep -c '^f ' some.obj)" -eq 400 ] || fail "no OBJ of 400 faces"
expect 0 "$bin/meshdist" some.obj some.ply --samples 1000 --fail-above 1e-12

# Every format that is written holds the same surface; what it does not hold is said.
{ printf 'mtllib my own.mtl\nmtllib /elsewhere/b.mtl\n'
  awk '/^v / { n++; print $0, (n % 7) / 6, 0.5, (n % 256) / 255; next } /^f/ { if (++f % 99 == 1) print "usemtl m" int(f / 99) } 1' relief.obj
} >colored.obj
expect 0 "$pmesh" build colored.obj -o colored.pm
for ending in ply obj stl off glb; do
  expect 0 "$pmesh" extract colored.pm --faces 100000 -o colored-out.$ending --json report.json
  expect 0 "$bin/meshdist" colored-out.$ending colored.obj --samples 1000 --fail-above 1e-9
  expect 0 "$pmesh" extract colored.pm --faces 300 -o colored-out.$ending --json report.json
  if [ $ending = obj ]; then
    says report.json 'has("remarks") | not' || fail "an OBJ leaves something out: $(cat report.json)"
  else
    says report.json '[.remarks[] | select(.what | startswith("materials, ")) | .count] == [6]' ||
      fail "$ending: $(cat report.json)"
  fi
done
head -3 colored-out.obj | grep -qx "mtllib my own.mtl" || fail "mtllib is lost"
head -4 colored-out.obj | grep -qx "mtllib /elsewhere/b.mtl" || fail "mtllib is lost"
[ "$(grep '^v ' colored-out.obj | awk 'NF == 7' | wc -l)" -eq "$(grep -c '^v ' colored-out.obj)" ] || fail "no colours"
grep -q '^usemtl m3$' colored-out.obj || fail "materials are lost"

# A patch of another material, and one of another colour, keep their size, unless they are ignored.
awk '/^f/ { print "usemtl", (int((NR - 579) / 2) % 16 < 8 ? "left" : "right") } 1' relief.obj >halves.obj
awk '/^v / { print $0, ($2 < 8 ? "1 0 0" : "0 0 1"); next } 1' relief.obj >painted.obj
awk '/^v/ { if ($1 == "v") print "v", $2, $3, 0; next } /^f/ { gsub("/[0-9]*", "") } 1' halves.obj >flat-halves.obj
left_area() { # FILE: of flat faces of material left
  awk '/^v / { x[++n] = $2; y[n] = $3 } /^usemtl/ { m = $2 } /^f/ && m == "left" {
    split($2, a, "/"); split($3, b, "/"); split($4, c, "/"); i = a[1]; j = b[1]; k = c[1]
    s += ((x[j] - x[i]) * (y[k] - y[i]) - (x[k] - x[i]) * (y[j] - y[i])) / 2 } END { print s + 0 }' "$1"
}
for metric in qem3 lt "mapping --placement full" "mapping --placement full --measure mean"; do
  # shellcheck disable=SC2086  # options are words
  expect 0 "$pmesh" build flat-halves.obj --metric $metric -o halves.pm --json report.json
  says report.json '.region_edges == 16' || fail "$metric: $(cat report.json)"
  expect 0 "$pmesh" extract halves.pm --faces 20 -o halves-20.obj
  holds "$(left_area halves-20.obj) > 127 && $(left_area halves-20.obj) < 129" ||
    fail "$metric: $(left_area halves-20.obj) of 128 is left"
done
expect 0 "$pmesh" build halves.obj -o with.pm
expect 0 "$pmesh" build halves.obj --ignore materials -o without.pm --json report.json
says report.json '.region_edges == 0' || fail "materials are not ignored: $(cat report.json)"
differ with.pm without.pm || fail "--ignore materials changes nothing"
expect 0 "$pmesh" build painted.obj -o with.pm
expect 0 "$pmesh" build painted.obj --ignore colours -o without.pm
differ with.pm without.pm || fail "--ignore colours changes nothing"
expect 0 "$pmesh" build painted.obj --ignore materials,colours -o without.pm
for word in "" normals materials, materials,x; do
  fault 2 "is neither materials nor colours" "$pmesh" build painted.obj --ignore "$word" -o x.pm
done

# Normals by corner come through: six of a cube, at any level.
awk 'BEGIN { n = 4
  for (s = 0; s < 6; s++) { a = int(s / 2); for (y = 0; y <= n; y++) for (x = 0; x <= n; x++) {
    p[a] = (s % 2) * n; p[(a + 1) % 3] = x; p[(a + 2) % 3] = y; print "v", p[0], p[1], p[2] }
    q[0] = q[1] = q[2] = 0; q[a] = s % 2 ? 1 : -1; print "vn", q[0], q[1], q[2]
    for (y = 0; y < n; y++) for (x = 0; x < n; x++) { i = s * (n + 1) * (n + 1) + y * (n + 1) + x + 1
      c[0] = i; c[1] = i + 1; c[2] = i + n + 2; c[3] = i + n + 1
      if (s % 2 == 0) { t = c[1]; c[1] = c[3]; c[3] = t }
      print "f", c[0] "//" s + 1, c[1] "//" s + 1, c[2] "//" s + 1
      print "f", c[0] "//" s + 1, c[2] "//" s + 1, c[3] "//" s + 1 } } }' >cube.obj
for placement in half full; do
  expect 0 "$pmesh" build cube.obj --placement $placement -o cube.pm
  for faces in 192 60 12; do
    expect 0 "$pmesh" extract cube.pm --faces $faces -o cube-out.obj
    awk '/^vn/ { for (k = 2; k <= 4; k++) printf "%d ", int($k * 100 + 1000.5) - 1000; print "" }' cube-out.obj | sort -u >normals.txt
    [ "$(wc -l <normals.txt)" -eq 6 ] || fail "$placement, $faces faces: $(cat normals.txt)"
  done
done

# What is nearly at one place is welded, and said; lengths are shares of the box, too.
awk '/^v / { x[++n] = $2; y[n] = $3; z[n] = $4; next } /^f/ { for (k = 2; k <= 4; k++) { split($k, c, "/"); i = c[1]
  printf "v %.7f %.7f %.7f\n", x[i] + 4e-6 * sin(++m), y[i] + 4e-6 * sin(m * 1.7), z[i] }; print "f", m - 2, m - 1, m }' relief.obj >soup.obj
expect 0 "$pmesh" build soup.obj -o soup.pm --json report.json
says report.json '.vertices_welded_apart > 1000 and .pieces == 1' || fail "not welded: $(cat report.json)"
grep -q "soup.obj: vertices welded to others up to .* away (--weld 0 leaves them apart)" "$log/err" || fail "$(cat "$log/err")"
expect 0 "$pmesh" extract soup.pm --faces 150 -o soup.ply
expect 0 "$bin/meshdist" soup.ply relief.obj --samples 20000 --fail-above 0.5
expect 0 "$pmesh" build soup.obj --weld 0 -o soup.pm --json report.json
says report.json '.vertices_welded_apart == 0 and .pieces > 1' || fail "welded: $(cat report.json)"
expect 0 "$pmesh" build soup.obj --weld 0.001% -o soup.pm --json report.json
says report.json '.pieces == 1' || fail "--weld 0.001%: $(cat report.json)"
for length in -1 x 1%% "" nan; do fault 2 "--weld" "$pmesh" build soup.obj --weld "$length" -o x.pm; done

# Tiles that are built one by one fit.
expect 0 "$pmesh" build relief.obj --lock-borders -o locked.pm --json report.json
says report.json '.vertices_locked == 64' || fail "locked: $(cat report.json)"
expect 0 "$pmesh" extract locked.pm --faces 200 -o locked.obj
awk '/^v / && ($2 == 0 || $2 == 16 || $3 == 0 || $3 == 16)' relief.obj | wc -l >rim.txt
[ "$(awk '/^v / && ($2 == 0 || $2 == 16 || $3 == 0 || $3 == 16)' locked.obj | wc -l)" -eq "$(cat rim.txt)" ] || fail "the rim has moved"

# Far from the origin: through build and extract, in every format that holds it.
awk '/^v / { printf "v %.6f %.6f %.6f\n", 500000 + $2 / 8, 4649776 + $3 / 8, $4 / 8; next } 1' relief.obj >far.obj
awk '/^v / { printf "v %.6f %.6f %.6f\n", $2 / 8, $3 / 8, $4 / 8; next } 1' relief.obj >near.obj
for metric in qem3 lt; do
  expect 0 "$pmesh" build far.obj --metric $metric -o far.pm
  grep -q "far.obj: far from the origin: positions are kept about (500002, 4649778, 0) (289)" "$log/err" || fail "$(cat "$log/err")"
  expect 0 "$pmesh" info far.pm
  says "$log/out" '.offset == [500002, 4649778, 0]' || fail "info: $(cat "$log/out")"
  for ending in ply obj stl off; do
    expect 0 "$pmesh" extract far.pm --faces 100000 -o far-out.$ending
    expect 0 "$bin/meshdist" far-out.$ending far.obj --samples 1000 --fail-above 1e-6
  done
  expect 0 "$pmesh" extract far.pm --faces 100 -o far-100.ply
  expect 0 "$bin/meshdist" far-100.ply far.obj --samples 20000 --json far.json
  expect 0 "$pmesh" build near.obj --metric $metric -o near.pm
  expect 0 "$pmesh" extract near.pm --faces 100 -o near-100.ply
  expect 0 "$bin/meshdist" near-100.ply near.obj --samples 20000 --json near.json
  holds "$(jq .symmetric.max far.json) < 1.01 * $(jq .symmetric.max near.json)" || fail "$metric: farther is worse"
done

# Options that the metric has no use for.
useless() { fault 2 "$1 does nothing under --metric $3" "$pmesh" build relief.obj $1 $2 --metric $3 -o x.pm; }
for metric in qem3 qem5 lt; do useless --error total $metric; done
for metric in qem3 qem5 lt aps; do useless --measure max $metric; done
for metric in aps mapping lt; do useless --unweighted "" $metric; useless --boundary-weight 2 $metric; done
useless --mean "" lt
for metric in qem3 aps mapping lt; do useless --texture-weight 2 $metric; done
fault 2 "--no-texture" "$pmesh" build relief.obj --no-folds --no-texture -o x.pm
for metric in qem5 aps mapping; do
  fault 2 "--metric $metric needs the texture coordinates that --no-texture" \
    "$pmesh" build relief.obj --no-texture --metric $metric -o x.pm
done
expect 0 "$pmesh" build relief.obj --no-texture --metric mapping --placement full --stop-at 300 -o x.pm
rm x.pm
fault 1 "for a patch, and --placement full needs none" "$pmesh" build ball.off --metric mapping -o x.pm
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n0 0 0\n1 0 0\n3 0 1 2\n3 3 1 0\n' >flat.off
fault 1 "flat.off: has no triangle with three different corners" "$pmesh" build flat.off -o x.pm
fault 1 "gone.off" "$pmesh" build gone.off -o x.pm
fault 1 "gone.pm" "$pmesh" info gone.pm
fault 1 "ball.off: is not a progressive mesh (.pm)" "$pmesh" info ball.off
cp some.pm bad.pm
size=$(stat -c %s bad.pm)
for cut in 0 10 100 $((size / 2)) $((size - 1)); do
  head -c $cut some.pm >bad.pm
  fault 1 "bad.pm" "$pmesh" extract bad.pm --faces 400 -o x.ply
done
for at in 9 40 700 $((size / 3)) $((size - 9)); do
  cp some.pm bad.pm
  overwrite bad.pm $at '\377\376\375'
  fault 1 "bad.pm" "$pmesh" extract bad.pm --faces 400 -o x.ply
done
fault 3 "nowhere/x.pm" "$pmesh" build ball.off -o nowhere/x.pm
[ "$n_faults" -ge 95 ] || fail "$n_faults faults typed"
echo "pmesh.sh: $n_faults faults"
