#!/usr/bin/env bash
# Types runs that are cut short: by signals, kills, a full disk, a second run beside them, inputs that
# change, links that were planted. What was there stays, and nothing is left behind. First argument: the
# folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
bake bundle
scene=(park/scene.json cells.json)
pack=("$bin/cellpack" "${scene[@]}" captures sv mv)
same() { diff -r "$1" "$2" >"$log/diff" || { cat "$log/diff" >&2; fail "$1 and $2 differ"; }; }
no_leftovers() {
  [ -z "$(find . -name '.tmp-*' -o -name '.viewcell-lock')" ] ||
    fail "left after $1: $(find . -name '.tmp-*' -o -name '.viewcell-lock' | head -5)"
}

# --- signals: the process ends as by the signal, a new bake goes, the bundle plays on ---
# cut SIGNAL GLOB COMMAND...: sends it as soon as a file matches; whether it met the command at work.
# Shells start what stands in the background with SIGINT ignored; env gives it back.
cut_short() {
  local signal=$1 glob=$2 got=0 pid
  shift 2
  env --default-signal=INT,TERM,HUP "$@" >"$log/out" 2>"$log/err" </dev/null &
  pid=$!
  while [ -e /proc/$pid/exe ] && [ "$(count_files "$glob")" -eq 0 ]; do sleep 0.002; done
  kill -s "$signal" $pid 2>"$log/kill" || true
  wait $pid 2>"$log/kill" || got=$?
  [ $got -eq 0 ] && return 1
  [ $got -eq $((128 + $(kill -l "$signal"))) ] || fail "'${1##*/}' ends with $got by SIG$signal: $(cat "$log/err")"
  [ ! -s "$log/err" ] || fail "words at SIG$signal: $(cat "$log/err")"
}
meet() {  # tries again where the signal came too late
  local try
  for ((try = 0; try < 20; try++)); do
    rm -rf cut
    if cut_short "$@"; then return; fi
  done
  fail "no SIG$1 met ${3##*/} at work"
}
for signal in INT TERM HUP; do
  meet $signal 'cut/.tmp-*/cells/*.geo' "${pack[@]}" -o cut
  [ ! -e cut ] || same bundle cut  # the signal came last
  meet $signal 'cut/*.exr' "$bin/depthcap" "${scene[@]}" --resolution 128 -o cut
  no_leftovers "SIG$signal"
done
# What is ignored stays ignored.
("$bin/depthcap" "${scene[@]}" --resolution 512 -o ignored -q & echo $! >"$log/pid"; wait $!) &
while [ "$(count_files 'ignored/*.exr')" -eq 0 ]; do sleep 0.002; done
kill -INT "$(cat "$log/pid")"
wait $! || fail "an ignored SIGINT ends depthcap"
[ -f ignored/captures.json ] || fail "an ignored SIGINT stops depthcap"

# --- a kill: the old bundle plays on, and the next run removes what it left ---
cp -r bundle played
met=no
for ((try = 0; try < 20; try++)); do
  if struck 1 'played/.tmp-*-bake/cells' "${pack[@]}" --cells 0-5 -o played -q -j 1; then
    met=yes
    break
  fi
  rm -rf played
  cp -r bundle played
done
[ $met = yes ] || fail "no kill met cellpack at work"
cmp -s bundle/bundle.json played/bundle.json || fail "a killed cellpack changes the manifest"
expect 0 "$bin/play" played --path park/path.json --frames 2 --size 64x64 --texture-memory 8 \
  --no-quality --stats -
is stand_ins.frames 0
expect 0 "${pack[@]}" -o played
same bundle played
# Whoever was killed: what it left goes with the next run into that folder.
for folder in captures sv mv park; do : >$folder/.tmp-$$-0123456789abcdef-x; done
sleep 0 & wait $!
: >captures/.tmp-$!-0-centre-00007.exr
: >captures/.tmp-$$-0-mine  # of a living process
rm captures/centre-00007.exr sv/cell-00000.ply mv/cell-00000.ply
cp -r captures "$log/without"
expect 0 "$bin/depthcap" "${scene[@]}" --resolution 128 -o captures
expect 0 "$bin/svmesh" "${scene[@]}" captures -o sv
expect 0 "$bin/mvmesh" "${scene[@]}" captures -o mv
expect 0 "$bin/hexcells" park/scene.json --size 50 --eye-height 6:10 -o park/x.json
[ "$(find . -name '.tmp-*')" = ./captures/.tmp-$$-0-mine ] || fail "leftovers: $(find . -name '.tmp-*')"
rm captures/.tmp-$$-0-mine park/x.json

# --- a full disk: exit 3, and all is as before ---
mkdir "$log/limited"
for tool in cellpack depthcap svmesh; do
  printf '#!/bin/bash\nulimit -f "$BLOCKS"\nexec "%s" "$@"\n' "$bin/$tool" >"$log/limited/$tool"
  chmod +x "$log/limited/$tool"
done
for blocks in 1 2 3 8; do
  export BLOCKS=$blocks
  for arguments in "--cells 0-5 -o played" "-o played" "-o new"; do
    # shellcheck disable=SC2086  # words
    fault 3 "cannot write: File too large" "$log/limited/cellpack" "${scene[@]}" captures sv mv $arguments
  done
  [ ! -e new ] || fail "a new folder after a full disk"
  same bundle played
done
BLOCKS=1
mkdir full
fault 3 "centre-00000.exr: cannot write: memory or the limit of file sizes" "$log/limited/depthcap" "${scene[@]}" --resolution 128 -j 1 -o full
fault 3 "cell-00000.ply: cannot write: File too large" "$log/limited/svmesh" "${scene[@]}" captures -j 1 -o full
# A disk that is truly full, where one can be mounted.
full_disk() {  # COMMAND: in a folder of 40 kB
  # shellcheck disable=SC2016  # for the inner shell
  timeout 120 unshare -rm bash -c 'mount -t tmpfs -o size=40k none full && shift && exec "$@"' bash "$@"
}
if unshare -rm true 2>"$log/kill" && full_disk bash true 2>"$log/kill"; then
  got=0
  full_disk bash "$bin/depthcap" "${scene[@]}" --resolution 256 -o full 2>"$log/err" || got=$?
  [ $got -eq 3 ] && grep -q "exr: cannot write: No space left on device" "$log/err" ||
    fail "a full disk: $got $(cat "$log/err")"
fi

# --- two runs of other options into one folder: the second is refused, slices of one are not ---
"$bin/depthcap" "${scene[@]}" --resolution 1024 -j 1 -o two -q &
pid=$!
while [ "$(count_files 'two/*.exr')" -eq 0 ]; do sleep 0.002; done
kill -STOP $pid
fault_beside() { expect 1 "$@"; grep -q "two: depthcap is writing there" "$log/err" || fail "$(cat "$log/err")"; }
fault_beside "$bin/depthcap" "${scene[@]}" --resolution 128 -o two
fault_beside "$bin/svmesh" "${scene[@]}" captures -o two
expect 0 "$bin/depthcap" "${scene[@]}" --resolution 1024 --slice 1/12 -o two
kill -CONT $pid
wait $pid || fail "depthcap beside others"
no_leftovers "two runs"
expect 0 "$bin/depthcap" "${scene[@]}" --resolution 1024 -o two --json -
is kept "$(key centres)"

# --- links at the names that temporaries had are not written through ---
echo precious >victim
mkdir planted
for ((pid = $$; pid < $$ + 300; pid++)); do
  ln -s ../victim planted/.tmp-$pid-0-centre-00007.exr
  ln -s ../victim planted/.tmp-$pid-1-centre-00008.exr
done
expect 0 "$bin/depthcap" "${scene[@]}" --resolution 128 --cells 0 -j 1 -o planted
[ "$(cat victim)" = precious ] || fail "written through a planted link"
[ ! -L planted/centre-00007.exr ] && cmp -s planted/centre-00007.exr captures/centre-00007.exr || fail "planted"
rm -r planted

# --- meshes that are replaced while a tool runs: what is written is of one of them, never of both ---
mkdir swapped
cp park/scene.json swapped
ball 4 8 >small.off
ball 5 60 >large.off
for size in small large; do
  cp $size.off swapped/ball.off
  expect 0 "$bin/hexcells" swapped/scene.json --size 50 --eye-height 6:10 -o $size.json
done
differ small.json large.json || fail "both balls stand in the same cells"
(
  while [ ! -e "$log/stop" ]; do
    for size in small large; do
      cp $size.off swapped/new
      mv swapped/new swapped/ball.off
    done
  done
) &
for ((i = 0; i < 40; i++)); do
  expect 0 "$bin/hexcells" swapped/scene.json --size 50 --eye-height 6:10 -o mixed.json
  cmp -s mixed.json small.json || cmp -s mixed.json large.json || fail "a hash of one mesh, cells of another"
done
: >"$log/stop"
wait
no_leftovers "all"
echo "interrupted.sh: all well ($n_faults faults)"
