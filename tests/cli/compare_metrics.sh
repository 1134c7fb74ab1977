#!/usr/bin/env bash
# Runs the scripts that compare metrics, on a small mesh without texture coordinates, and writes their
# results into a document. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../scripts" && pwd)
start "$1"
export BIN=$bin SAMPLES=3000 CURVE_SAMPLES=1000 LEVELS=3

ball 8 5 >ball.off  # 224 faces
mkdir -p out/ball
expect 0 env JOBS=2 TITLE="A ball" "$scripts/compare-metrics" ball.off 60 out/ball "exact=--metric qem3 --exact"
# Every metric that needs no texture coordinates, and the one that was added.
[ "$(sed -n '3,$p' out/ball/table.md | cut -d' ' -f2 | tr '\n' ' ')" = "qem3 qem3-full mapping-full mapping-mean-full lt exact " ] ||
  fail "$(cat out/ball/table.md)"
grep -q '^mapping: needs texture coordinates$' "$log/err" || fail "nothing says why mapping is left out"
head -n -1 "$log/out" | cmp -s - out/ball/table.md || fail "the table is not on stdout"
# Bold is the lowest of a column, and the last line names it.
awk -F'|' '
  NR > 2 { for (c = 10; c <= 12; c++) {
    x = $c; bold = gsub(/\*/, "", x) > 0; x += 0
    if (!(c in best) || x < best[c]) best[c] = x
    if (bold) { n[c]++; mark[c] = x }
  } }
  END { for (c = 10; c <= 12; c++) if (n[c] < 1 || mark[c] != best[c] || best[c] <= 0) exit 1 }' out/ball/table.md ||
  fail "bold: $(cat out/ball/table.md)"
lowest=$(awk -F'|' '$10 ~ /\*/ { gsub(/ /, "", $2); print $2; exit }' out/ball/table.md)
tail -n 1 "$log/out" | grep -Eq "^lowest maximum: $lowest[a-z, -]*; mean: [a-z]+.*; RMS: [a-z]+" ||
  fail "no line of the lowest: $(tail -n 1 "$log/out")"
[ "$(grep -c '^[a-z3-]*: built in [0-9.]* s$' "$log/err")" -eq 6 ] || fail "no progress: $(cat "$log/err")"
# The curves: three levels each, fewer faces and a larger maximum from each to the next; the last is
# the table's.
awk -F, '
  NR == 1 { if ($0 != "metric,faces,max,mean,rms") bad = 1; next }
  { n[$1]++; if ($3 < $5 || $5 < $4 || $4 <= 0) bad = 1 }
  n[$1] > 1 && ($2 >= faces || $3 < max / 2) { bad = 1 }
  { faces = $2; max = $3 }
  n[$1] == 3 && ($2 > 60 || $2 < 57) { bad = 1 }
  END { for (m in n) { k++; if (n[m] != 3) bad = 1 } exit bad || k != 6 }' out/ball/curves.csv ||
  fail "$(cat out/ball/curves.csv)"
for name in qem3 lt; do
  max=$(awk -F'|' -v m=" $name " '$2 == m { gsub(/\*/, ""); print $10 + 0 }' out/ball/table.md)
  awk -F, -v m=$name -v max="$max" '$1 == m { last = $3 } END { exit !(max > 1 && (last - max) ^ 2 < 1e-6) }' out/ball/curves.csv ||
    fail "the curve of $name does not end at the table's $max"
done
# The histograms: the same bins for all, nearly all of the surface.
awk -F, '
  NR > 1 { sum[$1] += $3; bins[$1] = bins[$1] " " $2 }
  END { for (m in sum) { k++; if (sum[m] < 95 || sum[m] > 100.1 || bins[m] != bins["qem3"]) bad = 1 } exit bad || k != 6 }' \
  out/ball/histogram.csv || fail "$(cat out/ball/histogram.csv)"
grep -q '>A ball<' out/ball/curves.svg && grep -q '>A ball, 224 -&gt; 60 faces<' out/ball/histogram.svg || fail "titles"
# Their mean is that of the table, from A to B, but for what lies beyond the last bin.
mean=$(awk -F'|' '$2 == " lt " { print $5 + 0 }' out/ball/table.md)
awk -F, -v mean="$mean" '
  $1 == "lt" { if (n++ == 1) width = $2 - x; x = $2; sum += $3 * x / 100 }
  END { exit !(n == 40 && (sum + width / 2 - mean) ^ 2 < (0.03 * mean) ^ 2) }' out/ball/histogram.csv ||
  fail "the histogram of lt does not have the mean $mean"
for file in sheet.png qem3.ply lt.color.ply; do [ -s "out/ball/$file" ] || fail "no $file"; done

# The same bytes side by side or not, but for times.
expect 0 env JOBS=1 TITLE="A ball" "$scripts/compare-metrics" ball.off 60 again "exact=--metric qem3 --exact"
for file in curves.csv histogram.csv curves.svg histogram.svg sheet.png lt.color.ply; do
  cmp "again/$file" "out/ball/$file" || fail "JOBS changes $file"
done

# A metric that stops early is said, in the sheet, too, and is not the lowest.
expect 0 "$scripts/compare-metrics" ball.off 60 early "stuck=--stop-at 200"
grep -q '^stuck: stops at 200 faces$' "$log/err" || fail "nothing says that stuck stops: $(cat "$log/err")"
grep '^| stuck | 200 ' early/table.md | grep -qv '\*' || fail "stuck is the lowest: $(cat early/table.md)"
! grep 'lowest' "$log/out" | grep -q stuck || fail "stuck is the lowest"

# What fails leaves earlier results as they were, and makes no folder.
find again -type f -exec md5sum {} + | sort >before
touch -d 2001-01-01 again/*
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n' >broken.off
for out in again new/folder; do
  expect 1 "$scripts/compare-metrics" ball.off 224 $out
  grep -q "ball.off has 224 faces, not more than 224" "$log/err" || fail "$(cat "$log/err")"
  for mesh in missing.off broken.off; do
    expect 1 "$scripts/compare-metrics" $mesh 60 $out
    grep -q "$mesh" "$log/err" || fail "$(cat "$log/err")"
  done
done
find again -type f -exec md5sum {} + | sort | cmp -s before - && [ -z "$(find again -type f -newermt 2002-01-01)" ] ||
  fail "earlier results do not stay"
[ ! -e new ] || fail "a folder of nothing"
[ -z "$(find . -name '.tmp-*')" ] || fail "temporaries are left"
for option in -h --help; do
  expect 0 "$scripts/compare-metrics" $option
  grep -q 'scripts/compare-metrics MESH FACES OUT' "$log/out" || fail "$option"
done
for metric in "lt=--metric lt" "a b=" "../x=--mean" "=--mean" noequals; do
  expect 2 "$scripts/compare-metrics" ball.off 60 new "$metric"
  [ "$(wc -l <"$log/err")" -eq 1 ] || fail "'$metric': $(cat "$log/err")"
done
expect 2 "$scripts/compare-metrics" ball.off 60 new "x=--mean" "x=--exact"
grep -q "two metrics 'x'" "$log/err" || fail "$(cat "$log/err")"
expect 2 "$scripts/compare-metrics" ball.off 60
expect 2 "$scripts/compare-metrics" ball.off many again
expect 2 "$scripts/measure-metrics" .
expect 1 "$scripts/measure-metrics" . out
grep -q "none of the models is in ." "$log/err" || fail "$(cat "$log/err")"

# Times: a line a metric, the best of the runs.
expect 0 env RUNS=1 "$scripts/time-metrics" ball.off 60
awk 'NF != 2 || $2 <= 0 { bad = 1 } END { exit bad || NR != 5 }' "$log/out" || fail "$(cat "$log/out")"

# Into a document: the parts that it names, once, and what else it says.
cat >doc.md <<'MD'
before
<!-- ball: table curves sheet -->
old
<!-- end -->
<!-- cube -->
kept
<!-- end -->
MD
expect 0 "$scripts/write-results" doc.md out
expect 0 "$scripts/write-results" doc.md out
{
  printf 'before\n<!-- ball: table curves sheet -->\n'
  cat out/ball/table.md
  printf '\n![](pictures/out/ball-curves.svg)\n\n![](pictures/out/ball-sheet.png)\n\n<!-- end -->\n'
  printf '<!-- cube -->\nkept\n<!-- end -->\n'
} >wanted.md
sed 's/!\[[^]]*\]/![]/' doc.md | cmp -s wanted.md || fail "$(cat doc.md)"
cmp -s pictures/out/ball-curves.svg out/ball/curves.svg && cmp -s pictures/out/ball-sheet.png out/ball/sheet.png ||
  fail "pictures"
sed -i 's/curves sheet/picture/' doc.md
cp doc.md as_it_was.md
expect 1 "$scripts/write-results" doc.md out
grep -q "'picture' is no part of ball" "$log/err" && cmp -s doc.md as_it_was.md || fail "a bad part"
echo "compare_metrics.sh: all well"
