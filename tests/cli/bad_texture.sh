#!/usr/bin/env bash
# Types broken input and a failing machine at texadapt and pmesh: the right exit code, one line on
# stderr, and no file made or changed. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
texadapt=$bin/texadapt

ball 12 1 >ball.off
expect 0 "$bin/uvpatch" ball.off --faces 200 --texture-size 64 -o patch.obj
expect 0 "$bin/pmesh" build patch.obj --metric mapping -o patch.pm
expect 0 "$texadapt" patch.pm patch.png --faces 60 -o good.png --log patch.adapt --index-map map.exr
level=("$texadapt" patch.pm patch.png --faces 60 -q)

# --- files that are not whole, or hold more ---
for bytes in 0 15 100 600 $(($(stat -c %s patch.pm) - 1)); do
  head -c "$bytes" patch.pm >bad.pm
  fault 1 bad.pm "$texadapt" bad.pm patch.png --faces 60 -o x.png
  fault 1 bad.pm "$bin/pmesh" extract bad.pm --faces 60 -o x.ply
done
for more in x "$(head -c 40 /dev/zero | tr '\0' y)"; do
  { cat patch.pm; printf %s "$more"; } >bad.pm
  fault 1 "bad.pm: ${#more} bytes follow its last section" "$texadapt" bad.pm patch.png --faces 60 -o x.png
  { cat patch.adapt; printf %s "$more"; } >bad.adapt
  fault 1 "bad.adapt: ${#more} bytes follow" "${level[@]}" --replay bad.adapt -o x.png
done
for bytes in 0 100 600 $(($(stat -c %s map.exr) - 1)); do
  head -c "$bytes" map.exr >bad.exr
  fault 1 bad.exr "${level[@]}" --from 100=bad.exr -o x.png
done
mkdir folder
for wrong in folder ball.off; do
  fault 1 "$wrong" "$texadapt" "$wrong" patch.png --faces 60 -o x.png
  fault 1 "$wrong" "$texadapt" patch.pm "$wrong" --faces 60 -o x.png
  fault 1 "$wrong" "${level[@]}" --replay "$wrong" -o x.png
  fault 1 "$wrong" "${level[@]}" --from "100=$wrong" -o x.png
done
name=$'a\nline \e[1m\xc3\xbc.pm'  # names do not break the line
fault 1 "a line" "$texadapt" "$name" patch.png --faces 60 -o x.png
cp patch.pm "$name"
expect 0 "$texadapt" "$name" patch.png --faces 60 -o same.png
cmp -s same.png good.png || fail "another picture under an odd name"

fault 1 "no charts that could be kept apart" "$bin/pmesh" build ball.off --charts-apart 64 -o x.pm

# --- what is typed ---
fault 2 "gl" "${level[@]}" --gl vulkan -o x.png
fault 2 "-o" "${level[@]}" -o ''
fault 2 "faces" "$texadapt" patch.pm patch.png --faces -1 -o x.png
fault 2 "size" "${level[@]}" --size 32769x1 -o x.png
fault 2 "-o is the texture" "${level[@]}" -o ./folder/../patch.png
ln -s patch.png link.png
fault 2 "-o is the texture" "${level[@]}" -o link.png

# --- outputs that cannot be made, said before any is ---
for option in --mesh=no/x.ply --log=no/x.adapt --json=no/x.json --index-map=no/x.exr \
  --also=patch.png=no/x.png --normal-map=flat=no/x.png; do
  fault 3 "'no' is no folder" "${level[@]}" -o x.png "$option"
done
fault 3 "no/x.png" "${level[@]}" -o no/x.png
mkdir folder.png
fault 3 "folder.png: cannot write: is a folder" "${level[@]}" -o folder.png
fault 3 "no/x.json" "$bin/pmesh" build patch.obj -q -o x.pm --json no/x.json
fault 3 "ball.off/x.pm" "$bin/pmesh" build patch.obj -q -o ball.off/x.pm

# --- a machine that fails: nothing is left over ---
limited() {  # BLOCKS COMMAND...: no file may grow beyond so many KB
  ulimit -f "$1"
  "${@:2}"
}
small() { # TEXT COMMAND...
  local text=$1 got=0
  shift
  snapshot >"$log/before"
  (limited 1 "$@") >"$log/out" 2>"$log/err" || got=$?
  snapshot >"$log/after"
  [ $got -eq 3 ] || fail "ulimit -f: '$*' exits with $got"
  grep -q "$text: cannot write: File too large" "$log/err" || fail "ulimit -f: $(cat "$log/err")"
  cmp -s "$log/before" "$log/after" || fail "ulimit -f: '$*' leaves files"
}
small x.exr "${level[@]}" -o x.exr
small x.adapt "${level[@]}" -o x.png --log x.adapt
small x.pm "$bin/pmesh" build patch.obj -q -o x.pm
fault 3 "No space left" "${level[@]}" -o /dev/full
fault 3 "No space left" "${level[@]}" -o x.png --log /dev/full

# --- a flat fan of a soup: its apex, more wedges than a byte counts, would go first ---
awk 'BEGIN {
  n = 300; printf "OFF\n%d %d 0\n", 3 * n, n
  for (i = 0; i < n; i++)
    printf "0 0 0\n%.7g %.7g 0\n%.7g %.7g 0\n", cos(i * 8 * atan2(1, 1) / n),
      sin(i * 8 * atan2(1, 1) / n), cos((i + 1) % n * 8 * atan2(1, 1) / n), sin((i + 1) % n * 8 * atan2(1, 1) / n)
  for (i = 0; i < n; i++) printf "3 %d %d %d\n", 3 * i, 3 * i + 1, 3 * i + 2
}' >soup.off
expect 0 "$bin/pmesh" build soup.off -o soup.pm
[ "$n_faults" -ge 40 ] || fail "$n_faults faults were tried"
echo "bad_texture.sh: $n_faults faults"
