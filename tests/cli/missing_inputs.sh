#!/usr/bin/env bash
# Types every bake tool with each of its inputs missing, empty, of another kind or of nothing: exit code
# 1, one line that names the input, or says what to run; nothing written. First argument: the folder of
# binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
bake "$log/bundle"
scene=(park/scene.json cells.json)

# --- each input in turn: not there, empty, a folder for a file and a file for a folder, a pipe ---
spoilt() {  # INPUT COMMAND...: of an input that is in the command
  local input=$1
  shift
  mv "$input" "$log/aside"
  fault 1 "$(basename "$input")" "$@"
  : >"$input"
  fault 1 "$(basename "$input")" "$@"
  rm "$input"
  mkdir "$input"
  fault 1 "$(basename "$input")" "$@"
  rmdir "$input"
  mv "$log/aside" "$input"
}
run() {  # TOOL: its command line
  case $1 in
    hexcells) command=("$bin/hexcells" park/scene.json --size 50 -o x.json) ;;
    depthcap) command=("$bin/depthcap" "${scene[@]}" --resolution 128 -o x) ;;
    svmesh) command=("$bin/svmesh" "${scene[@]}" captures -o x) ;;
    cellpack) command=("$bin/cellpack" "${scene[@]}" captures sv mv -o x) ;;
  esac
}
run hexcells
for input in park/scene.json park/ball.off; do spoilt $input "${command[@]}"; done
run depthcap
spoilt cells.json "${command[@]}"
run svmesh
for input in cells.json captures captures/captures.json; do
  spoilt $input "${command[@]}"
  [ ! -e x ] || rmdir x  # an empty folder may stay behind
done
run cellpack
for input in cells.json captures captures/captures.json sv mv sv/cell-00003.ply mv/cell-00011.ply \
  captures/centre-00008.exr; do
  spoilt $input "${command[@]}"
  [ ! -e x ] || fail "cellpack makes a folder without $input"
done

# --- what to run ---
says_run() { fault 1 "run $1" "$bin/cellpack" "${@:2}" -o x; }
mkdir none
says_run depthcap "${scene[@]}" none sv mv
says_run svmesh "${scene[@]}" captures none mv
says_run mvmesh "${scene[@]}" captures sv none
says_run svmesh "${scene[@]}" captures none none
says_run svmesh "${scene[@]}" captures mv mv
says_run mvmesh "${scene[@]}" captures sv sv
says_run svmesh "${scene[@]}" captures mv sv
mv captures/centre-00008.exr "$log"
says_run depthcap "${scene[@]}" captures sv mv
fault 1 "run depthcap" "$bin/svmesh" "${scene[@]}" captures --cells 1 -o x
rmdir x
mv "$log/centre-00008.exr" captures
# Meshes of which objects are missing, as after another --ts; of other captures.
expect 0 "$bin/svmesh" "${scene[@]}" captures --ts 0.01 -o few
says_run "svmesh and mvmesh with the same options" "${scene[@]}" captures few mv
expect 0 "$bin/depthcap" "${scene[@]}" --resolution 64 -o other
says_run "svmesh and mvmesh again" "${scene[@]}" other sv mv

# --- nothing to bake, or nothing any more ---
jq '.objects = []' park/scene.json >park/none.json
expect 0 "$bin/hexcells" park/none.json --size 50 --eye-height 6:10 -o none.json
expect 0 "$bin/depthcap" park/none.json none.json --resolution 128 -o none/captures
for tool in svmesh mvmesh; do expect 0 "$bin/$tool" park/none.json none.json none/captures -o none/$tool; done
nothing=(park/none.json none.json none/captures none/svmesh none/mvmesh)
fault 1 "park/none.json: objects: is empty" "$bin/cellpack" "${nothing[@]}" -o x
fault 1 "park/none.json: objects: is empty" "$bin/cellpack" "${nothing[@]}" --cells 0 -o x
# Meshes that name objects which the scene has not: of a scene that had one.
captures=$(jq -r .key none/captures/captures.json)
for kind in sv mv; do
  for file in $kind/*; do
    LC_ALL=C sed "s/^comment captures .*/comment captures $captures/" "$file" >none/${kind}mesh/$(basename $file)
  done
done
fault 1 "park/none.json: objects: is empty" "$bin/cellpack" "${nothing[@]}" -o x
jq '.objects = [.objects[1]]' park/scene.json >park/one.json
expect 0 "$bin/hexcells" park/one.json --size 50 --eye-height 6:10 -o one.json
expect 0 "$bin/depthcap" park/one.json one.json --resolution 128 -o one/captures
captures=$(jq -r .key one/captures/captures.json)
for kind in sv mv; do
  mkdir one/$kind
  for file in $kind/*; do
    LC_ALL=C sed "s/^comment captures .*/comment captures $captures/" "$file" >one/$kind/$(basename $file)
  done
done
fault 1 "one/" "$bin/cellpack" park/one.json one.json one/captures one/sv one/mv -o x
echo "missing_inputs.sh: all well ($n_faults faults)"
