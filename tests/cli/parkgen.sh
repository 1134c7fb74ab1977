#!/usr/bin/env bash
# Types parkgen's commands and holds exit codes, streams, files and reports. First argument: the
# folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
parkgen=$bin/parkgen

# The words.
expect 0 "$parkgen" --help
grep -q "Example:" "$log/out" || fail "--help has no example"
expect 0 "$parkgen" --version
expect 0 "$parkgen" --list
[ "$(wc -l <"$log/out")" -eq 9 ] || fail "--list has not a heading and eight lines"
head -n 1 "$log/out" | grep -q "^kind.triangles.width" || fail "no heading: $(head -n 1 "$log/out")"
grep -qP '^dragon\t202520\t57.3\t25.6\t40.4\t4\t10\t18\t' "$log/out" || fail "--list: $(cat "$log/out")"

# A park: the report alone on stdout, the summary on stderr.
expect 0 "$parkgen" --preset demo -o demo -j 2 --json -
head -c 1 "$log/out" | grep -q "{" || fail "stdout is not only JSON"
for fact in '.objects == 132' '.triangles == 4188885' '.preset == "demo"' \
  '12 <= .path_cells and .path_cells <= 14' '0 < .coverage_estimate and .coverage_estimate < 1'; do
  says "$log/out" "$fact" || fail "not $fact: $(cat "$log/out")"
done
[ "$(wc -l <"$log/err")" -eq 1 ] || fail "more than a summary: $(cat "$log/err")"
[ "$(find demo -name '*.ply' | wc -l)" -eq 8 ] || fail "not eight meshes"

# The same bytes for any number of threads, and over an old park.
expect 0 "$parkgen" -q --preset demo -o again -j 1
[ ! -s "$log/err" ] || fail "-q says: $(cat "$log/err")"
diff -r demo again || fail "-j 1 and -j 2 differ"
expect 0 "$parkgen" -q --preset demo -o again --seed 4
cmp -s demo/meshes/dragon.ply again/meshes/dragon.ply || fail "the seed changes a statue"
differ demo/scene.json again/scene.json || fail "the seed changes nothing"

# Real models; kinds without one are procedural, with a note.
mkdir models
cube() { printf 'OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n'; }
for kind in dragon bunny statue cattle horse easter camel; do cube >models/$kind.off; done
expect 0 "$parkgen" --preset 2m --models models -o cubes --json report.json
grep -q "venus: no model in models, procedural instead" "$log/err" || fail "no note: $(cat "$log/err")"
says report.json '.triangles == 11840' || fail "56 cubes and 8 busts: $(cat report.json)"  # 56*12+8*1396
says cubes/scene.json '[.. | objects | .dragon? | strings | test("^[0-9a-f]{16}$")] == [true]' || fail "no hash of the model in scene.json"
! grep -q "$work" cubes/scene.json cubes/path.json || fail "an absolute path in an artefact"

# A kill while meshes are written leaves whole ones, and no scene, not even an old one. A kill that
# comes when all are there does not count, and is tried again.
mkdir killed
for at in 1 4; do
  for ((try = 0; try < 10; try++)); do
    rm -rf killed/meshes killed/path.json
    echo old >killed/scene.json
    if struck $at 'killed/meshes/*.ply' "$parkgen" -q --preset 2m -o killed; then
      [ "$(count_files 'killed/meshes/*.ply')" -eq 8 ] || break
    fi
  done
  [ $try -lt 10 ] || fail "no kill met parkgen with $at of 8 meshes written"
  [ ! -e killed/scene.json ] || fail "a scene with $at of its meshes"
  for mesh in killed/meshes/*.ply; do
    cmp "$mesh" "demo/meshes/${mesh##*/}" || fail "a kill leaves half of $mesh"
  done
done

# Misuse.
fault 2 "-o FOLDER is missing" "$parkgen" --preset demo
fault 2 "'16m' is not demo" "$parkgen" --preset 16m -o no
fault 2 "--seed" "$parkgen" --seed many -o no
fault 2 "--speed" "$parkgen" --speed 3 -o no

# Bad input: one line, no output.
fault 1 "none: is not a folder of models" "$parkgen" --models none -o no
echo '{"format": "viewcell-models", "version": 1, "models": [{"name": "teapot", "file": "x.off"}]}' >models/models.json
fault 1 "models/models.json: models[0].name: 'teapot' is not a kind" "$parkgen" --models models -o no
echo '{"format": "viewcell-models", "version": 1, "models": [{"name": "venus", "file": "../a.off"}]}' >models/models.json
fault 1 "leaves the file's folder" "$parkgen" --models models -o no
head -c 200000 /dev/zero | tr '\0' '[' >models/models.json
fault 1 "nested deeper" "$parkgen" --models models -o no
rm models/models.json
printf 'OFF\n3 4000000000 0\n0 0 0\n' >models/camel.off
fault 1 "camel.off" "$parkgen" --models models -o no
[ ! -e no ] || fail "bad input leaves output"
cube >models/camel.off && cube >models/venus.off
: >file
fault 1 "file: is a file, not a folder" "$parkgen" --models models -o file
[ -z "$(find . -name '.tmp-*' -not -path './killed/*')" ] || fail "temporaries are left"
echo "parkgen.sh: all well"
