#!/usr/bin/env bash
# Types texadapt's commands and holds exit codes, pictures and reports. First argument: the folder of
# binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
texadapt=$bin/texadapt

ball 24 1 >ball.off
expect 0 "$bin/uvpatch" ball.off --faces 900 --texture-size 512 -o patch.obj  # with a check-board
expect 0 "$bin/pmesh" build patch.obj --metric mapping -o patch.pm
expect 0 "$texadapt" --help
grep -q "Example:" "$log/out" || fail "--help has no example"

expect 0 "$texadapt" patch.pm patch.png --faces 200 -o adapted.png --mesh coarse.ply --json report.json
has_keys report.json faces collapses adaptations texels refused timing
says report.json '.faces == 199 or .faces == 200' || fail "faces: $(cat report.json)"
# Seen from the same places, the adapted texture is nearer to the original than the one as it was.
shots() { expect 0 "$bin/meshshot" "$1" --texture "$2" --unlit --views 4 --size 128 --like patch.obj --no-sheet -q -o "$3"; }
shots patch.obj patch.png original
shots coarse.ply patch.png plain
shots coarse.ply adapted.png follows
mean() { "$bin/psnr" original "$1" | awk '$1 == "mean" { print $3 }'; }
holds "$(mean follows) > $(mean plain) + 1" ||
  fail "PSNR with adaptation $(mean follows), without $(mean plain)"
# The input's own level changes nothing; the same bytes every time, for any number of threads.
expect 0 "$texadapt" patch.pm patch.png --faces 100000 -o same.png
expect 0 "$bin/psnr" patch.png same.png
grep -q "100.000     100.000" "$log/out" || fail "the finest level's texture differs: $(cat "$log/out")"
expect 0 "$texadapt" patch.pm patch.png --faces 200 -o again.png -q -j1
[ ! -s "$log/err" ] || fail "words on stderr with -q"
cmp -s again.png adapted.png || fail "other bytes the second time"
expect 0 "$texadapt" patch.pm patch.png --faces 200 -o again.png --no-pack
cmp -s again.png adapted.png || fail "other bytes one by one"
"$texadapt" patch.pm patch.png --faces 200 -q -o - | cmp -s - adapted.png || fail "-o -"

# Several levels in one pass, coarser and finer again; each as if it were the only one.
expect 0 "$texadapt" patch.pm patch.png --levels 400,200 -o l.png --index-map l.exr --json report.json
cmp -s l-200.png adapted.png || fail "--levels: another picture than --faces"
without_texture() { LC_ALL=C grep -av '^comment TextureFile' "$1"; }
cmp -s <(without_texture l-200.ply) <(without_texture coarse.ply) || fail "--levels: another mesh than --mesh"
grep -aq '^comment TextureFile l-200.png$' l-200.ply || fail "the mesh does not name its texture"
[ -s l-400.exr ] && [ -s l-400.ply ] || fail "--levels: files are missing"
expect 0 "$texadapt" patch.pm patch.png --levels 200,100000 -o up.png
cmp -s up-100000.png same.png || fail "all the way back the texture is another"

# The map is the texture, and drawing through it shows the same.
expect 0 "$texadapt" patch.pm patch.png --faces 200 -o map.exr
cmp -s map.exr l-200.exr || fail "-o map.exr is not --index-map"
expect 0 "$bin/meshshot" coarse.ply --texture patch.png --index-map map.exr --unlit --views 4 --size 128 --like patch.obj --no-sheet -q -o through
holds "$(mean through) > $(mean follows) - 0.5" ||
  fail "through the map $(mean through) dB, baked $(mean follows)"
# From a map of one level on to another, by a log: what the tool does in one go.
expect 0 "$texadapt" patch.pm patch.png --faces 400 -o m400.exr --log patch.adapt
expect 0 "$texadapt" patch.pm patch.png --replay patch.adapt --from 400=m400.exr --faces 200 -o m200.png
expect 0 "$bin/psnr" adapted.png m200.png --fail-below 50
expect 0 "$texadapt" patch.pm patch.png --replay patch.adapt --from 200=map.exr --faces 100000 -o back.png
cmp -s back.png same.png || fail "--from 200 up to the finest level"

# GLB: the mesh with its texture; further textures; coarse texels; the texture itself; rebaked.
expect 0 "$texadapt" patch.pm patch.png --levels 200 --normal-map patch.png=n.png -o g.glb --json report.json
has_keys report.json clamped
shots g-200.glb g-200.glb glb
follows=$(mean follows)
holds "$(mean glb) > $follows - 0.01 && $(mean glb) < $follows + 0.01" || fail "GLB"
shots g-200.glb "g-200.glb#normal" normal
shots coarse.ply n-200.png normal-png
expect 0 "$bin/psnr" normal normal-png --no-ssim --fail-below 60
# With a flat normal map a level of a bumpy ball is shaded nearly as the finest mesh is; the same bytes.
awk 'NR < 3 || NF == 4 { print; next }
  { k = 1 + 0.06 * sin(9 * $1) * sin(9 * $2 + 1); print k * $1, k * $2, k * $3 }' ball.off >bumpy.off
expect 0 "$bin/uvpatch" bumpy.off --faces 900 --texture-size 512 -o bumpy.obj
expect 0 "$bin/pmesh" build bumpy.obj --metric mapping -o bumpy.pm
expect 0 "$texadapt" bumpy.pm bumpy.png --faces 200 --normal-map flat=flat.png --mesh normals.ply -o f.png -j1
expect 0 "$texadapt" bumpy.pm bumpy.png --faces 200 --normal-map flat=flat2.png -o f.png -j2
cmp -s flat.png flat2.png || fail "other normals on two threads"
lit() { expect 0 "$bin/meshshot" "$1" --fixed-light --views 4 --size 128 --like bumpy.obj --no-sheet -q "${@:2}"; }
lit bumpy.obj -o lit-original
lit normals.ply -o lit-own
lit normals.ply --normal-map flat.png -o lit-flat
lit_mean() { "$bin/psnr" lit-original "$1" | awk '$1 == "mean" { print $3 }'; }
holds "$(lit_mean lit-flat) > $(lit_mean lit-own) + 3" ||
  fail "lit: $(lit_mean lit-flat) dB with a flat normal map, $(lit_mean lit-own) without"
expect 0 "$texadapt" patch.pm patch.png --faces 200 --also patch.png=also.png --size 256x256 -o x256.png
cmp -s also.png x256.png || fail "--also makes another texture of the same"
for texels in half 16 8 texture; do
  expect 0 "$texadapt" patch.pm patch.png --faces 200 --texels $texels -o $texels.png
  shots coarse.ply $texels.png $texels
done
holds "$(mean 16) > $follows - 0.3 && $(mean 16) > $(mean 8)" ||
  fail "16 bits $(mean 16) dB, 8 bits $(mean 8), float $(mean follows)"
expect 0 "$texadapt" patch.pm patch.png --faces 200 --engine rebake -o rebaked.png
shots coarse.ply rebaked.png rebaked
holds "$(mean rebaked) < $follows + 1.5 && $(mean rebaked) > $(mean plain) + 1" || fail "rebaked $(mean rebaked) dB"
expect 0 "$texadapt" patch.pm patch.png --faces 200 --engine gl -o drawn.png
expect 0 "$bin/psnr" adapted.png drawn.png --fail-below 45
# Full-edge collapses.
expect 0 "$bin/pmesh" build patch.obj --metric mapping --placement full -o full.pm
expect 0 "$texadapt" full.pm patch.png --faces 200 -o full.png --mesh full.obj
shots full.obj patch.png full-plain
shots full.obj full.png full-follows
holds "$(mean full-follows) > $(mean full-plain) + 1" ||
  fail "full-edge: PSNR with adaptation $(mean full-follows), without $(mean full-plain)"
expect 0 "$bin/pmesh" build patch.obj --stop-at 300 -o stopped.pm
expect 5 "$texadapt" stopped.pm patch.png --levels 400,60 -o base.png
[ -s base-60.png ] || fail "the base is not written"

# Bad input: one line, nothing written.
expect 0 "$bin/pmesh" build ball.off -o bare.pm
fault 1 "has no texture coordinates" "$texadapt" bare.pm patch.png --faces 60 -o x.png
sed 's/^vt \([0-9]\)/vt 1\1/' patch.obj >wide.obj
expect 0 "$bin/pmesh" build wide.obj --metric mapping -o wide.pm
expect 0 "$texadapt" wide.pm patch.png --faces 200 -o wide.png
grep -q -- '-10 is added to u' "$log/err" || fail "a mesh in another tile moves without a word"
"$bin/psnr" adapted.png wide.png --fail-below 40 -q -o /dev/null || fail "another picture from another tile"
rm wide.png
# Two patches side by side, the second in another tile of the picture: what the first shows is as it
# was alone, and the second one's chart is moved; both are over the same texels then.
awk '/^vt/ { n++ } /^v / { m++ } { print }
  /^v / { v[m] = "v " $2 + 9 " " $3 " " $4 } /^vt/ { t[n] = "vt " $2 + 2 " " $3 } /^f/ { f[++k] = $0 }
  END { for (i = 1; i <= m; i++) print v[i]; for (i = 1; i <= n; i++) print t[i]
    for (i = 1; i <= k; i++) { c = split(f[i], w, " "); s = "f"
      for (j = 2; j <= c; j++) { split(w[j], p, "/"); s = s " " p[1] + m "/" p[2] + n } print s } }' patch.obj |
  grep -v '^vn\|^usemtl\|^mtllib' | sed '/^f/s#\([0-9]*/[0-9]*\)/[0-9]*#\1#g' >tiles.obj
expect 0 "$bin/pmesh" build tiles.obj --metric mapping -o tiles.pm
fault 1 "lie over one another" "$texadapt" tiles.pm patch.png --faces 400 -o x.png
expect 0 "$texadapt" tiles.pm patch.png --faces 400 --allow-overlap -o tiles.png --mesh tiles.ply
grep -q '1 of 2 charts lie in other tiles' "$log/err" || fail "charts in other tiles move without a word"
rm tiles.png
sed 's/^vt 0\.\([5-9]\)/vt 3.\1/' patch.obj >wide.obj
expect 0 "$bin/pmesh" build wide.obj -o wide.pm
fault 1 "a picture that repeats" "$texadapt" wide.pm patch.png --faces 60 -o x.png
expect 0 "$texadapt" patch.pm patch.png --faces 400 -o from.exr
fault 1 "another level than --from 300" "$texadapt" patch.pm patch.png --from 300=from.exr --faces 60 -o x.png
expect 0 "$bin/pmesh" build patch.obj --metric qem3 -o other.pm
fault 1 "another progressive mesh" "$texadapt" other.pm patch.png --from 400=from.exr --faces 60 -o x.png
rm from.exr
cat >over.obj <<'EOF'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 5
v 1 0 5
v 1 1 5
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3
f 1/1 3/3 4/4
f 5/1 6/2 7/3
EOF
expect 0 "$bin/pmesh" build over.obj -o over.pm
fault 1 "lie over one another" "$texadapt" over.pm patch.png --faces 2 -o x.png
expect 0 "$texadapt" over.pm patch.png --faces 2 --allow-overlap -o over.png
fault 1 "another progressive mesh" "$texadapt" full.pm patch.png --replay patch.adapt --faces 60 -o x.png
for bytes in 10 300 5000; do
  head -c "$bytes" patch.adapt >cut.adapt
  fault 1 "cut.adapt" "$texadapt" patch.pm patch.png --replay cut.adapt --faces 60 -o x.png
done
fault 1 "patch.png" "$texadapt" patch.pm patch.png --replay patch.png --faces 60 -o x.png
fault 1 "gone.png" "$texadapt" patch.pm gone.png --faces 60 -o x.png
fault 1 "gone.png" "$texadapt" patch.pm patch.png --also gone.png=y.png --faces 60 -o x.png
fault 2 "size" "$texadapt" patch.pm patch.png --from 400=m400.exr --size 64x64 --faces 60 -o x.png
fault 2 "faces" "$texadapt" patch.pm patch.png --faces 0 -o x.png
fault 2 "faces" "$texadapt" patch.pm patch.png -o x.png
fault 2 "levels" "$texadapt" patch.pm patch.png --levels 3,,4 -o x.png
fault 2 "twice" "$texadapt" patch.pm patch.png --levels 30,30 -o x.png
fault 2 "also" "$texadapt" patch.pm patch.png --also patch.png --faces 60 -o x.png
fault 2 "size" "$texadapt" patch.pm patch.png --size 0x5 --faces 60 -o x.png
fault 2 "from" "$texadapt" patch.pm patch.png --from m400.exr --faces 60 -o x.png
fault 2 "-o" "$texadapt" patch.pm patch.png --faces 60 -o patch.png
fault 2 "-o" "$texadapt" patch.pm patch.png --faces 60 -o x.jpg
fault 2 "mesh" "$texadapt" patch.pm patch.png --faces 60 -o x.glb --mesh y.ply
fault 2 "indexing map" "$texadapt" patch.pm patch.png --texels texture --index-map x.exr --faces 60 -o x.png
fault 2 "rebake" "$texadapt" patch.pm patch.png --engine rebake --log x.adapt --faces 60 -o x.png
fault 2 "normal-map" "$texadapt" patch.pm patch.png --normal-map patch.png --faces 60 -o x.png
fault 2 "indexing map" "$texadapt" patch.pm patch.png --engine rebake --normal-map flat=y.png --faces 60 -o x.png
fault 1 "gone.png" "$texadapt" patch.pm patch.png --normal-map gone.png=y.png --faces 60 -o x.png
head -c 500 patch.pm >cut.pm
fault 1 "cut.pm" "$texadapt" cut.pm patch.png --faces 60 -o x.png
[ ! -e x.png ] && [ ! -e x.exr ] && [ ! -e x.glb ] && [ ! -e y.png ] || fail "a fault has left a file"
[ "$n_faults" -eq 30 ] || fail "$n_faults faults were tried"
echo "texadapt.sh: $n_faults faults"
