#!/usr/bin/env bash
# Types plot's commands and holds exit codes, streams and what is drawn. First argument: the folder of
# binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
plot=$bin/plot
count() { grep -o -- "$2" "$1" | wc -l; }

cat >curves.csv <<'CSV'
metric,faces,max,mean
one,1000,1.5,0.1
one,100,12,1.1
"two, <it>",1000,2,0.2
"two, <it>",300,,0.5
"two, <it>",100,20,2
CSV
expect 0 "$plot" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$plot" --version
expect 0 "$plot" curves.csv --x faces --y max,mean --by metric --log-x --log-y --points --title 'A & B' \
  --y-label distance -o a.svg --json report.json
[ ! -s "$log/out" ] && [ ! -s "$log/err" ] || fail "words that nobody asked for"
[ "$(count a.svg 'fill="none" stroke=.* marker-start')" -eq 4 ] || fail "not four lines"
[ "$(count a.svg '>two, &lt;it&gt;<')" -eq 1 ] || fail "the legend"
[ "$(count a.svg '>A &amp; B</text>')" -eq 1 ] && [ "$(count a.svg '>distance<')" -eq 1 ] || fail "words"
[ "$(count a.svg '>faces<')" -eq 2 ] && [ "$(count a.svg '>mean<')" -eq 1 ] || fail "two panels"
[ "$(count a.svg '>1k<')" -eq 2 ] || fail "no tick at 1000"
says report.json '.rows == 5 and [.panels[].points] == [4, 5]' || fail "$(cat report.json)"
# An empty field breaks its line: two parts in the first panel, one in the second.
[ "$(grep '#d55e00.* marker-start' a.svg | head -1 | grep -o '[" ]M' | wc -l)" -eq 2 ] || fail "no break"
[ "$(grep '#d55e00.* marker-start' a.svg | tail -1 | grep -o '[" ]M' | wc -l)" -eq 1 ] || fail "a break"

# The same bytes, from a pipe, to a pipe, with any number of threads.
options=(--x faces --y max,mean --by metric --log-x --log-y --points --title 'A & B' --y-label distance)
for j in 1 2; do
  "$plot" - "${options[@]}" -j $j -o - <curves.csv >b.svg
  cmp -s a.svg b.svg || fail "other bytes by a pipe and -j $j"
done
sed 's/$/\r/' curves.csv | "$plot" - "${options[@]}" -o - | cmp -s a.svg || fail "other bytes with CRLF"
# Each option changes the picture.
previous=a.svg
for option in "--y-least 1" "--y-most 5" "--x-label n" "--y-label d"; do
  # shellcheck disable=SC2086
  expect 0 "$plot" curves.csv "${options[@]:0:8}" $option -o c.svg
  differ c.svg "$previous" || fail "$option changes nothing"
  cp c.svg previous.svg
  previous=previous.svg
done

# Steps: four corners of two bins, down to zero.
printf 'from,percent\n0,75\n0.5,25\n' >histogram.csv
expect 0 "$plot" histogram.csv --x from --y percent --steps -o h.svg
[ "$(grep '<path' h.svg | grep -o '[ML]' | wc -l)" -eq 4 ] || fail "not two steps"
grep -q '>1</text>' h.svg && grep -q '>0</text>' h.svg || fail "the last bin or zero is cut off"

# Misuse.
fault 2 "CSV is required" "$plot" --x a --y b -o x.svg
fault 2 "--x is required" "$plot" curves.csv --y b -o x.svg
fault 2 "--output is required" "$plot" curves.csv --x faces --y max
fault 2 "--y" "$plot" curves.csv --x faces --y a,b,c,d,e -o x.svg
fault 2 "names a column twice" "$plot" curves.csv --x faces --y max,max -o x.svg
fault 2 "--points" "$plot" curves.csv --x faces --y max --points --steps -o x.svg
fault 2 "--y-least is not below" "$plot" curves.csv --x faces --y max --y-least 3 --y-most 3 -o x.svg
fault 2 "--log-y needs" "$plot" curves.csv --x faces --y max --log-y --y-most 0 -o x.svg
fault 2 "--y-most" "$plot" curves.csv --x faces --y max --y-most nan -o x.svg
fault 2 "-o is an SVG: it does not end in .svg" "$plot" curves.csv --x faces --y max -o x.png
cp curves.csv curves.svg
fault 2 "-o is the table that is read" "$plot" curves.svg --x faces --y max -o ./curves.svg
rm curves.svg
fault 2 "cannot both be" "$plot" curves.csv --x faces --y max -o - --json -

# Bad input.
fault 1 "missing.csv" "$plot" missing.csv --x faces --y max -o x.svg
fault 1 "curves.csv: header: has no column 'rms'; it has metric, faces, max, mean" \
  "$plot" curves.csv --x faces --y rms -o x.svg
fault 1 "has no column 'kind'" "$plot" curves.csv --x faces --y max --by kind -o x.svg
fault 1 "curves.csv: line 2: metric: 'one' is not a number" "$plot" curves.csv --x metric --y max -o x.svg
: >empty.csv
fault 1 "empty.csv: has no header" "$plot" empty.csv --x a --y b -o x.svg
echo a,b >rows.csv
fault 1 "rows.csv: has no rows" "$plot" rows.csv --x a --y b -o x.svg
printf 'a,b\n1,2\n3\n' >short.csv
fault 1 "short.csv: line 3: has 1 fields, the header has 2" "$plot" short.csv --x a --y b -o x.svg
printf 'a,b\n1,2\n3,"4\n' >open.csv
fault 1 "open.csv: line 3: a quote does not end" "$plot" open.csv --x a --y b -o x.svg
printf 'a,b\n1,nan\n2,\n' >nan.csv
fault 1 "nan.csv: b: has no point to draw" "$plot" nan.csv --x a --y b -o x.svg
printf 'a,b\n1,0\n2,-1\n' >zero.csv
fault 1 "no point to draw on logarithmic axes" "$plot" zero.csv --x a --y b --log-y -o x.svg
printf 'a,b\n1,0\n2,-1\n3,4\n5,\n' >some.csv
expect 0 "$plot" some.csv --x a --y b --log-y -o x.svg
grep -q 'not above 0.*(2)' "$log/err" || fail "points are left out without a word: $(cat "$log/err")"
expect 0 "$plot" some.csv --x a --y b -o x.svg
[ ! -s "$log/err" ] || fail "a word of nothing: $(cat "$log/err")"
rm x.svg
fault 1 "curves.csv: line 3: x does not grow" "$plot" curves.csv --x faces --y max --steps -o x.svg
noise 5000 >noise.csv
fault 1 "noise.csv" "$plot" noise.csv --x a --y b -o x.svg
fault 1 "is a folder" "$plot" . --x a --y b -o x.svg

# The machine's fault.
fault 3 "no/x.svg" "$plot" curves.csv --x faces --y max -o no/x.svg
[ "$n_faults" -eq 26 ] || fail "$n_faults faults typed"
echo "plot.sh: all well"
