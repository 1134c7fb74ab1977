#!/usr/bin/env bash
# Holds what the tools write against docs/schemas, by Python's jsonschema. First argument: the folder of
# binaries.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
schemas=$here/../../docs/schemas
. "$here/lib.sh"
# Debian's own, where another python3 comes first in PATH and has no jsonschema.
for python in python3 /usr/bin/python3 ''; do
  [ -n "$python" ] || skip "there is no python3 with jsonschema (Debian: python3-jsonschema)"
  ! "$python" -c 'import jsonschema' >/dev/null 2>&1 || break
done
start "$1"

bake bundle
expect 0 "$bin/play" bundle --path park/path.json --frames 2 --size 64x64 \
  --modes geometry,frustum,lod,hybrid,raycast,lod-equal,geometry-two-sided,frustum-two-sided \
  --stats stats.json
sed 's/100, 60, 8/100, 60, 80/' park/path.json >off.json
expect 0 "$bin/play" bundle --path off.json --frames 2 --size 64x64 --stats off_stats.json
expect 0 "$bin/play" bundle --path park/path.json --frames 3 --size 64x64 --quality-every 2 --stats some.json
expect 0 "$bin/play" bundle --path park/path.json --frames 2 --size 64x64 --no-quality --stats none.json
cat >check.py <<'PY'
import json, sys
import jsonschema
schema = json.load(open(sys.argv[1]))
jsonschema.Draft202012Validator.check_schema(schema)
errors = list(jsonschema.Draft202012Validator(schema).iter_errors(json.load(open(sys.argv[2]))))
for error in errors:
    print(f"{sys.argv[2]}: {error.json_path}: {error.message}", file=sys.stderr)
sys.exit(5 if errors else 0)
PY
check() { "$python" check.py "$schemas/$1.schema.json" "$2"; }
refused() {  # SCHEMA FILE TEXT: for the reason that the text says
  expect 5 "$python" check.py "$schemas/$1.schema.json" "$2"
  grep -qF -- "$3" "$log/err" || fail "no '$3' in: $(cat "$log/err")"
}
for pair in scene:park/scene.json path:park/path.json cells:cells.json \
  captures:captures/captures.json bundle:bundle/bundle.json scene:"$(bake_of bundle)/scene.json" \
  stats:stats.json stats:some.json stats:none.json stats:off_stats.json; do
  check "${pair%%:*}" "${pair#*:}" || fail "$pair"
done
cat >models.json <<'JSON'
{"format": "viewcell-models", "version": 1,
 "models": [{"name": "bunny", "file": "hare.ply", "up": "-z", "rotate_z_deg": 90, "substitutes": "a hare", "source": "x"}]}
JSON
check models models.json || fail "models.json"
jq '.meshes[0] |= . + {"place": "ground", "up": "-y"}' park/scene.json >ground.json
check scene ground.json || fail "place"
# Kinds in the schema are the tool's.
"$bin/parkgen" --list | tail -n +2 | cut -f 1 >kinds
jq -r '.properties.models.items.properties.name.enum[]' "$schemas/models.schema.json" | cmp -s - kinds ||
  fail "the schema has other kinds"
# They bite.
jq '.models[0].up = "up"' models.json >bad.json
refused models bad.json "'up' is not one of"
jq '.columns = "four"' cells.json >bad.json
refused cells bad.json "columns: 'four' is not of type 'integer'"
jq '.modes |= map_values(del(.psnr_db))' stats.json >bad.json
refused stats bad.json "'psnr_db' is a required property"
for file in scene:park/scene.json path:park/path.json captures:captures/captures.json bundle:bundle/bundle.json; do
  jq '.version = 99' "${file#*:}" >bad.json
  refused "${file%%:*}" bad.json '$.version: ' 
done
echo "schemas.sh: all well"
