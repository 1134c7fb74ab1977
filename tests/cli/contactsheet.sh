#!/usr/bin/env bash
# Types contactsheet's commands and holds exit codes, streams and sheets. First argument: the folder
# of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
sheet=$bin/contactsheet
size() { jq -r '"\(.width_px) \(.height_px)"' "$1"; }

# Two gray pictures of 20 x 15 and one of 15 x 20; a ball's, with empty borders.
base64 -d >a.png <<<iVBORw0KGgoAAAANSUhEUgAAABQAAAAPCAAAAADB87CJAAAAEUlEQVR42mNIwQIYRgWJEAQAHnt1MQgniOIAAAAASUVORK5CYII=
base64 -d >b.png <<<iVBORw0KGgoAAAANSUhEUgAAABQAAAAPCAAAAADB87CJAAAAEUlEQVR42mNIxQIYRgWJEAQA1w12XfyOKaoAAAAASUVORK5CYII=
base64 -d >turned.png <<<iVBORw0KGgoAAAANSUhEUgAAAA8AAAAUCAAAAAB3rDjOAAAAEElEQVR42mNIQQUMo3yS+ABDh3UxH8eBBAAAAABJRU5ErkJggg==
ball 6 8 >ball.off
expect 0 "$bin/meshshot" ball.off --views 1 --size 64 -o ball --no-sheet

expect 0 "$sheet" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$sheet" --version
expect 0 "$sheet" a.png b.png -o s.png --json one.json
expect 0 "$sheet" a.png b.png a.png --columns 2 -o s.png --json two.json
[ ! -s "$log/out" ] && [ ! -s "$log/err" ] || fail "words that nobody asked for"
read -r w1 h1 <<<"$(size one.json)"
read -r w2 h2 <<<"$(size two.json)"
[ "$w1" -eq "$w2" ] && [ "$h2" -gt $((h1 + 15)) ] || fail "sheets of $w1 x $h1 and $w2 x $h2"
says two.json '.rows == 2' || fail "rows"
# An empty word leaves a blank; notes and titles show; the same bytes every time.
expect 0 "$sheet" a.png "" a.png --columns 2 -o blank.png
differ s.png blank.png || fail "no blank"
expect 0 "$sheet" a.png b.png a.png --columns 2 --note one --note two --title three -o words.png
differ s.png words.png || fail "no words"
for j in 1 2; do
  expect 0 "$sheet" a.png b.png a.png --columns 2 --note one --note two --title three -o again.png -j $j
  cmp -s words.png again.png || fail "-j $j gives other bytes"
done
"$sheet" - b.png -o stdin.png <a.png && "$sheet" a.png b.png -o file.png
cmp -s stdin.png file.png || fail "other bytes by a pipe"
# --tile shrinks, --trim cuts.
ball=ball/view-00.png
expect 0 "$sheet" $ball $ball -o ball.png --json full.json
expect 0 "$sheet" $ball $ball -o ball.png --tile 32 --json small.json
expect 0 "$sheet" $ball $ball -o trim.png --trim --json trim.json
expect 0 "$sheet" $ball $ball -o ball.png
[ "$(size full.json | cut -d' ' -f1)" -eq $((8 + 2 * 72)) ] || fail "width $(size full.json)"
[ "$(size small.json | cut -d' ' -f1)" -eq $((8 + 2 * 40)) ] || fail "width $(size small.json)"
[ "$(size trim.json | cut -d' ' -f1)" -lt $((2 * 72)) ] || fail "nothing trimmed"

expect 0 "$sheet" $ball $ball -o few.png --bits 4
[ "$(stat -c %s few.png)" -lt "$(stat -c %s ball.png)" ] || fail "--bits makes no smaller file"

# A key of colours below; letters beyond ASCII, or boxes and a word where there is no font.
expect 0 "$sheet" a.png -o plain.png --json plain.json
expect 0 "$sheet" a.png -o key.png --json key.json --key 00ff00=near --key "0000FF=far=away"
[ "$(size key.json | cut -d' ' -f2)" -gt "$(size plain.json | cut -d' ' -f2)" ] || fail "no line for the key"
expect 0 "$sheet" a.png -o de.png --note "Größe"
expect 0 "$sheet" a.png -o ascii.png --note "Grose"
differ de.png ascii.png || fail "letters beyond ASCII do not show"
if [ -s /usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf ]; then
  expect 0 "$sheet" a.png -o de.png --note "Größe π é"
  [ ! -s "$log/err" ] || fail "words: $(cat "$log/err")"
fi
expect 0 "$sheet" a.png -o box.png --note "山"
grep -q "drawn as boxes.* (1)$" "$log/err" || fail "no word of boxes: $(cat "$log/err")"
fault 2 "--key" "$sheet" a.png -o x.png --key green=near
fault 2 "--key" "$sheet" a.png -o x.png --key 00ff00=

# Misuse and bad input.
fault 2 "PICTURE is required" "$sheet" -o x.png
fault 2 "--output is required" "$sheet" a.png
fault 2 "-o names a file" "$sheet" a.png -o -
fault 2 "-o is a PNG: it does not end in .png" "$sheet" a.png -o x.svg
fault 2 "-o is picture b.png, which is read" "$sheet" a.png b.png -o ./b.png
fault 2 "more --note than pictures" "$sheet" a.png --note a --note b -o x.png
fault 2 "every place is blank" "$sheet" "" "" -o x.png
fault 2 "--columns" "$sheet" a.png --columns 0 -o x.png
fault 2 "--bits" "$sheet" a.png --bits 9 -o x.png
fault 2 "--tile" "$sheet" a.png --tile 15 -o x.png
fault 1 "turned.png: is not of the size of the first picture, 20 x 15" "$sheet" a.png turned.png -o x.png
fault 1 "missing.png" "$sheet" a.png missing.png -o x.png
fault 1 "ball.off: is not a PNG" "$sheet" ball.off -o x.png
fault 3 "no/x.png" "$sheet" a.png -o no/x.png
[ "$n_faults" -eq 16 ] || fail "$n_faults faults typed"
echo "contactsheet.sh: all well"
