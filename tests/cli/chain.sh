#!/usr/bin/env bash
# Types the whole chain on a scene of two balls: it works, is resumed, may be cut in slices, and
# gives the same bytes for any number of threads. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"

bake bundle
same() { diff -r "$1" "$2" >"$log/diff" || { cat "$log/diff" >&2; fail "$1 and $2 differ"; }; }

# Words: help with an example, the version, nothing on stderr with -q, JSON alone on stdout.
for tool in parkgen hexcells depthcap svmesh mvmesh cellpack psnr play; do
  expect 0 "$bin/$tool" --help
  grep -q "Example:" "$log/out" || fail "$tool --help has no example"
  expect 0 "$bin/$tool" --version
  grep -q "^$tool (viewcell) " "$log/out" || fail "$tool --version"
done
expect 0 "$bin/hexcells" park/scene.json --size 50 --eye-height 6:10 --choose paper -o - -q
[ ! -s "$log/err" ] || fail "words in spite of -q"
cmp -s "$log/out" cells.json || fail "-o - is not what -o cells.json is"
mkfifo pipe
cat pipe >piped &
expect 0 "$bin/hexcells" park/scene.json --size 50 --eye-height 6:10 --choose paper -o pipe
wait
cmp -s piped cells.json && [ -p pipe ] || fail "a pipe as -o"
expect 0 "$bin/hexcells" park/scene.json --size 50 -o x.json --svg map.svg --path park/path.json --json -
is cells 12
grep -q "<svg" map.svg || fail "no map"

# A second run keeps what is there; a damaged or missing file is made again.
snapshot >"$log/before"
expect 0 "$bin/depthcap" park/scene.json cells.json --resolution 128 -o captures --json -
is kept "$(key centres)"
for tool in sv:svmesh mv:mvmesh; do
  expect 0 "$bin/${tool#*:}" park/scene.json cells.json captures -o ${tool%:*} --json -
  is kept 12
done
snapshot | grep -v captures.json >"$log/after"
grep -v captures.json "$log/before" | cmp -s - "$log/after" || fail "a second run writes again"
cp -r captures captures_2
head -c 5000 captures/centre-00007.exr >captures_2/centre-00007.exr
rm captures_2/centre-00008.exr
expect 0 "$bin/depthcap" park/scene.json cells.json --resolution 128 -o captures_2 --json -
is kept 26
same captures captures_2
cp -r sv sv_2
head -c 700 sv/cell-00003.ply >sv_2/cell-00003.ply
: >sv_2/cell-00004.ply
expect 0 "$bin/svmesh" park/scene.json cells.json captures -o sv_2 --json -
is kept 10
same sv sv_2
# Other options make other meshes, in place of the ones that are there; and back.
expect 0 "$bin/svmesh" park/scene.json cells.json captures --tl 2 -o sv_2 --json -
is kept 0
differ sv/cell-00000.ply sv_2/cell-00000.ply || fail "--tl changes nothing"
expect 0 "$bin/svmesh" park/scene.json cells.json captures -o sv_2
same sv sv_2

# Any number of threads, and slices on two machines.
for j in 1 2 5; do
  rm -rf j
  expect 0 "$bin/depthcap" park/scene.json cells.json --resolution 128 -o j/captures -j $j
  expect 0 "$bin/svmesh" park/scene.json cells.json j/captures -o j/sv -j $j
  expect 0 "$bin/mvmesh" park/scene.json cells.json j/captures -o j/mv -j $j
  expect 0 "$bin/cellpack" park/scene.json cells.json j/captures j/sv j/mv -o j/bundle -j $j
  for folder in captures sv mv bundle; do same $folder j/$folder; done
done
for i in 1 2; do
  expect 0 "$bin/depthcap" park/scene.json cells.json --resolution 128 --slice $i/2 -o half/captures
  expect 0 "$bin/svmesh" park/scene.json cells.json captures --slice $i/2 -o half/sv --json -
  is cells 6
  expect 0 "$bin/mvmesh" park/scene.json cells.json captures --slice $i/2 -o half/mv
done
for folder in captures sv mv; do same $folder half/$folder; done

# Lists of cells.
files() { (cd "$1" && ls); }
expect 0 "$bin/svmesh" park/scene.json cells.json captures --cells 0,2,5-7,6 -o few
[ "$(files few | wc -l)" -eq 5 ] && cmp -s few/cell-00007.ply sv/cell-00007.ply || fail "--cells"
printf '0\n2 5-6\n7,\n' >list
expect 0 "$bin/svmesh" park/scene.json cells.json captures --cells @list -o listed
same few listed
expect 0 "$bin/svmesh" park/scene.json cells.json captures --cells path:park/path.json -o walked
[ "$(files walked)" = cell-00001.ply ] || fail "the path's cells: $(files walked)"

# Killed before, early in and late in its work, and run again. A kill that comes too late does not
# count, and is tried again.
n_centres=$(count_files 'captures/*.exr')
for at in 0 1 9 20; do
  for ((try = 0; try < 10; try++)); do
    rm -rf killed
    if struck $at 'killed/*.exr' "$bin/depthcap" park/scene.json cells.json --resolution 128 -o killed -q -j 2; then
      n_written=$(count_files 'killed/*.exr')
      [ "$n_written" -eq "$n_centres" ] || break
    fi
  done
  [ $try -lt 10 ] || fail "no kill met depthcap with $at of $n_centres files written"
  expect 0 "$bin/depthcap" park/scene.json cells.json --resolution 128 -o killed --json -
  is kept "$n_written"
  same captures killed  # and nothing is left
done

# The bundle needs nothing beside it.
mkdir away
mv bundle away/
cp park/path.json away/
cd away
expect 0 "$bin/play" bundle --path path.json --frames 3 --size 64x64 --stats stats.json --save frames
has_keys stats.json frames width_px height_px renderer gl_threads modes triangles_mean frame_ms psnr_db \
  psnr_covered_db texture_bytes_mean draws_mean missing_px_mean yardstick coverage_mean speedup \
  hybrid_over_frustum per_frame
find frames -name '*.png' | grep -q . || fail "no frames saved"
# Saved frames are opaque, unless their alpha is wanted.
frame=frustum/frame-00000.png
expect 0 "$bin/psnr" frames/$frame frames/$frame --json -
is covered_px 4096
expect 0 "$bin/play" bundle --path path.json --frames 1 --size 64x64 --save seen --save-alpha
expect 0 "$bin/psnr" seen/$frame seen/$frame --json -
holds "$(key covered_px) > 0 && $(key covered_px) < 4096"
# Frames that are not compared do not break the lines of plots.
expect 0 "$bin/play" bundle --path path.json --frames 7 --size 64x64 --quality-every 3 --plots plots
grep -q '<path d="M[^"]*L[^"]*" fill="none" stroke="#' plots/psnr.svg || fail "no curves: $(cat plots/psnr.svg)"
echo "chain.sh: all well"
