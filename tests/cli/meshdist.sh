#!/usr/bin/env bash
# Types meshdist's commands and holds exit codes, streams, reports and the coloured mesh. First
# argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
meshdist=$bin/meshdist

ball 24 1 >a.off
ball 40 1.5 >b.off
square() {  # SIZE HEIGHT: two triangles, to stdout
  printf 'OFF\n4 2 0\n0 0 %s\n%s 0 %s\n%s %s %s\n0 %s %s\n3 0 1 2\n3 0 2 3\n' \
    "$2" "$1" "$2" "$1" "$1" "$2" "$1" "$2"
}
square 2 0 >low.off
square 2 1 >high.off
square 2e30 0 >huge_low.off
square 2e30 1e30 >huge_high.off

# The words and the numbers.
expect 0 "$meshdist" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$meshdist" --version
expect 0 "$meshdist" low.off high.off --samples 1000
for word in forward backward symmetric "forward is largest at" "max/diagonal %"; do
  grep -q "$word" "$log/out" || fail "no '$word' in the table"
done
grep -Eq '^symmetric +1 +1 +1 ' "$log/out" || fail "shifted squares are not 1 apart"
grep -q "million samples in" "$log/err" || fail "no summary on stderr"
expect 0 "$meshdist" a.off a.off --samples 1000 -q
[ ! -s "$log/err" ] || fail "words on stderr with -q"
awk '$1 == "symmetric" { n++; worst = $2 } END { exit !(n == 1 && worst ~ /^[0-9]/ && worst + 0 < 1e-14) }' "$log/out" ||
  fail "d(A, A): $(cat "$log/out")"

# JSON, alone on stdout when asked for there.
expect 0 "$meshdist" a.off b.off --samples 5000 --json -
head -c 1 "$log/out" | grep -q "{" || fail "stdout is not only JSON"
has_keys "$log/out" forward backward symmetric max mean rms p50 p95 p99 samples bbox_diagonal worst
is samples 5000
! grep -q histogram "$log/out" || fail "a histogram that nobody asked for"
cp "$log/out" first
for j in 1 2 7; do
  expect 0 "$meshdist" a.off b.off --samples 5000 --json - -j $j
  cmp -s "$log/out" first || fail "-j $j gives another report"
done
expect 0 "$meshdist" a.off b.off --samples 5000 --json - --seed 1
differ "$log/out" first || fail "--seed changes nothing"
expect 0 "$meshdist" a.off b.off --samples 5000 --json report.json -o table.txt
[ ! -s "$log/out" ] && cmp -s report.json first && [ -s table.txt ] || fail "-o and --json"
expect 0 "$meshdist" low.off high.off --samples 1000 --histogram 4 --json report.json
says report.json '[.forward, .backward | .histogram] == [[0, 0, 0, 1000], [0, 0, 0, 1000]]' || fail "histogram: $(cat report.json)"
grep -Eq '^1 +100.0000 +100.0000$' "$log/out" || fail "no lines of the histogram"
expect 0 "$meshdist" low.off high.off --samples 1000 --histogram 4 --histogram-to 2 --json report.json
says report.json '[.forward, .backward | .histogram] == [[0, 0, 1000, 0], [0, 0, 1000, 0]]' || fail "--histogram-to: $(cat report.json)"
says report.json '.histogram_to == 2' || fail "histogram_to: $(cat report.json)"
grep -Eq '^1.5 +100.0000 +100.0000$' "$log/out" || fail "lines of another range"

# A limit that is typed holds for what is read.
fault 1 "at most 1 are read (--max-triangles N)" "$meshdist" low.off high.off --max-triangles 1

# Units: those of A, or of the unit cube; any size.
expect 0 "$meshdist" low.off high.off --samples 1000 --unit-cube
grep -Eq '^symmetric +0.5 +0.5 +0.5 ' "$log/out" || fail "--unit-cube does not halve"
expect 0 "$meshdist" huge_low.off huge_high.off --samples 1000
grep -Eq '^symmetric +1e\+30 +1e\+30 +1e\+30 ' "$log/out" || fail "1e30: $(cat "$log/out")"

# The threshold.
expect 0 "$meshdist" low.off high.off --samples 100 --fail-above 1
expect 5 "$meshdist" low.off high.off --samples 100 --fail-above 0.999 -q
grep -qx "meshdist: symmetric maximum 1 is above 0.999" "$log/err" || fail "--fail-above: $(cat "$log/err")"
grep -q "^symmetric" "$log/out" || fail "no table beside exit code 5"

# The coloured mesh: the same bytes each time, read again, and its colours.
expect 0 "$meshdist" a.off b.off --samples 5000 --color color.ply
for j in 1 2; do
  expect 0 "$meshdist" a.off b.off --samples 5000 --color again.ply -j $j
  cmp -s color.ply again.ply || fail "--color is not the same with -j $j"
done
for line in "property float distance" "property uchar red" "comment provenance" "element vertex 1106"; do
  grep -aq "^$line" color.ply || fail "no '$line' in the coloured mesh"
done
expect 0 "$meshdist" color.ply a.off --samples 1000 --fail-above 1e-6
color_of() {  # RANGE: the first vertex's red, green, blue and distance, of low.off to high.off
  expect 0 "$meshdist" low.off high.off --samples 100 --color c.ply --range "$1"
  local header
  header=$(($(grep -abo end_header c.ply | cut -d: -f1) + 11))
  tail -c +$((header + 13)) c.ply | head -c 7 | od -An -tu1 | xargs
}
[ "$(color_of 1:2)" = "0 255 0 0 0 128 63" ] || fail "green near zero: $(color_of 1:2)"
[ "$(color_of 0.5:1.5)" = "255 0 0 0 0 128 63" ] || fail "red in between"
[ "$(color_of 0:1)" = "0 0 255 0 0 128 63" ] || fail "blue far"
[ "$(color_of 0:0.5)" = "0 0 255 0 0 128 63" ] || fail "blue beyond the range"
[ "$(color_of 0:4)" = "255 255 0 0 0 128 63" ] || fail "yellow"
expect 0 "$meshdist" low.off low.off --samples 100 --color c.ply  # an empty range
rm -f c.ply again.ply color.ply first report.json table.txt

# Misuse.
fault 2 "B is required" "$meshdist" a.off
for n in 0 -5 1.5 nan many 1e99 99999999999; do
  fault 2 "--samples" "$meshdist" a.off b.off --samples=$n --color x.ply
done
for range in 1 1:1 2:1 nan:1 0:inf :1 0: a:b 0:1:2 ""; do
  fault 2 "--range" "$meshdist" a.off b.off --range "$range" --color x.ply
done
for limit in nan -1 x; do fault 2 "--fail-above" "$meshdist" a.off b.off --fail-above=$limit; done
for n in 0 -1 x 1e9; do fault 2 "--histogram" "$meshdist" a.off b.off --histogram=$n; done
for x in 0 -1 nan x; do
  fault 2 "--histogram-to" "$meshdist" a.off b.off --histogram 4 --histogram-to=$x
done
fault 2 "--histogram-to requires" "$meshdist" a.off b.off --histogram-to 1
for seed in -1 1.5 x 18446744073709551616 99999999999999999999999; do
  fault 2 "--seed" "$meshdist" a.off b.off --seed=$seed
done
expect 0 "$meshdist" low.off high.off --samples 10 --seed 18446744073709551615
fault 2 "--colour" "$meshdist" a.off b.off --colour x.ply
fault 2 "--threads" "$meshdist" a.off b.off -j -1

# Bad input, on either side; nothing is written.
bad() {  # FILE TEXT
  fault 1 "$1: $2" "$meshdist" "$1" a.off --color x.ply --json x.json
  fault 1 "$1: $2" "$meshdist" a.off "$1" --color x.ply --json x.json
}
triangle='0 0 0\n1 0 0\n0 1 0\n'
: >empty.ply
noise 3000 >noise.ply
head -c 3000 a.off >cut.off
printf "OFF\n3 0 0\n$triangle" >faceless.off
printf "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" >nan.off
printf "OFF\n3 1 0\n1e39 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" >infinite.off
printf "OFF\n3 1 0\n${triangle}3 0 1 3\n" >index.off
printf "OFF\n3 2 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n3 1 1 1\n" >line.off
mkdir folder.ply
bad missing.ply "cannot open"
bad folder.ply ""
bad line.off "has no area"
printf 'OFF\n0 0 0\n' >nothing.off
bad nothing.off "has no vertices"
for file in empty.ply noise.ply cut.off nan.off infinite.off index.off; do bad $file ""; done
cp noise.ply noise.xyz
bad noise.xyz "is of no known mesh format"
bad - "is of no known mesh format"  # there is nothing

# Point clouds: every point, one way, whichever is named first.
printf 'OFF\n3 0 0\n1 1 0\n0.5 0.5 3\n1 1 -2\n' >cloud.off
expect 0 "$meshdist" low.off cloud.off --histogram 3 --json report.json
grep -Eq '^forward +3 +1.66667 +' "$log/out" || fail "a cloud: $(cat "$log/out")"
grep -q "^forward is from the points of B, a point cloud" "$log/out" || fail "which is not said"
! grep -Eq "^(backward|symmetric)" "$log/out" || fail "a way back from a cloud"
says report.json '.points == "B" and .forward.max == 3 and .forward.vertices == 3 and .forward.histogram == [1, 0, 2]' ||
  fail "a cloud: $(cat report.json)"
says report.json '[.backward, .symmetric, .samples, .seed] == [null, null, null, null]' || fail "a cloud: $(cat report.json)"
expect 0 "$meshdist" cloud.off low.off --json report.json --color c.ply --range 0:3
says report.json '.points == "A" and .forward.mean > 1.66 and .forward.p50 == 2' || fail "A: $(cat report.json)"
grep -aq "^element vertex 3" c.ply && ! grep -aq "^element face" c.ply || fail "coloured points"
expect 5 "$meshdist" low.off cloud.off --fail-above 2.9 -q
grep -qx "meshdist: forward maximum 3 is above 2.9" "$log/err" || fail "--fail-above of points"
for option in "--samples 100" "--seed 1" "--color x.ply"; do
  # shellcheck disable=SC2086  # words
  fault 1 "${option%% *}" "$meshdist" low.off cloud.off $option
  grep -q "cloud.off: is a point cloud" "$log/err" || fail "$option: $(cat "$log/err")"
done
fault 1 "cloud.off: is a point cloud, all of whose points are measured: --samples" "$meshdist" cloud.off low.off --samples 100
fault 1 "cloud.off: has no faces, and neither has faceless.off" "$meshdist" faceless.off cloud.off
printf 'OFF\n1 0 0\n1 1 1\n' >point.off
fault 1 "point.off: is one point, which --unit-cube" "$meshdist" point.off low.off --unit-cube
rm -f c.ply report.json

# Far from the origin: floats are half a unit apart there.
awk 'BEGIN { print "OFF"; print "8 12 0" } NR > 2 && NF == 3 { printf "%.3f %.3f %.3f\n", 500000 + $1 / 8, 4649776 + $2 / 8, $3 / 8 } NF == 4 { print }' \
  <(printf 'OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n'
    printf '3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n') >far.off
sed 's/^500000.125/500000.130/' far.off >farther.off
expect 0 "$meshdist" far.off farther.off --samples 1000 --json report.json
says report.json '.symmetric.max > 0.00499 and .symmetric.max < 0.00501' || fail "far: $(cat report.json)"
says report.json '.forward.worst.point[0] == 500000.125' || fail "places: $(cat report.json)"
says report.json '[.remarks[].what | startswith("far from the origin")] == [true, true]' || fail "no remark: $(cat report.json)"
grep -q "forward is largest at (500000.125, 46497" "$log/out" || fail "digits: $(cat "$log/out")"
expect 0 "$meshdist" far.off far.off --samples 1000 --color c.ply --fail-above 1e-9
expect 0 "$meshdist" far.off c.ply --samples 1000 --fail-above 1e-9
rm -f c.ply report.json

# From pipes, told by what they hold, and names without a known ending.
expect 0 "$meshdist" a.off b.off --samples 1000
cp "$log/out" wanted.txt
cp a.off a.xyz
cat a.off | "$meshdist" - b.off --samples 1000 -q | cmp - wanted.txt || fail "- as A"
cat b.off | "$meshdist" a.xyz /dev/stdin --samples 1000 -q | cmp - wanted.txt || fail "/dev/stdin as B"
"$meshdist" <(cat a.off) <(cat b.off) --samples 1000 -q | cmp - wanted.txt || fail "<()"
fault 2 "A and B cannot both be standard input" "$meshdist" - - --samples 1000
fault 2 "A and B cannot both be standard input" "$meshdist" - /dev/stdin --samples 1000

# Nothing is written over what is read, or twice; endings tell what is written.
cp a.off a.ply
ln -s b.off b.ply
fault 2 "--color is A" "$meshdist" a.ply b.off --color a.ply
fault 2 "--color is B" "$meshdist" a.off b.off --color ./b.ply
fault 2 "-o is B" "$meshdist" a.off b.off -o b.off
fault 2 "--json and --color are one file" "$meshdist" a.off b.off --color c.ply --json c.ply
fault 2 "-o and --json cannot both be standard output" "$meshdist" a.off b.off -o - --json -
fault 2 "--color is a PLY: it does not end in .ply" "$meshdist" a.off b.off --color c.png
rm a.ply b.ply

# The machine's fault, and nothing left behind.
fault 3 "no/x.ply" "$meshdist" a.off b.off --samples 100 --color no/x.ply
got=0
"$meshdist" low.off high.off --samples 100 >/dev/full 2>"$log/err" || got=$?
[ $got -eq 3 ] && grep -q "No space left" "$log/err" || fail "a full disk: $got"
[ -z "$(find . -name '.tmp-*')" ] || fail "temporaries are left"
echo "meshdist.sh: all well ($n_faults faults)"
