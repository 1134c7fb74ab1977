#!/usr/bin/env bash
# Holds what the tools write against docs/schemas, where Python's jsonschema is installed; otherwise
# it says so and passes. First argument: the folder of binaries.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
schemas=$here/../../docs/schemas
python3 -c 'import jsonschema' 2>/dev/null || {
  echo "schemas.sh: skipped, there is no python3 with jsonschema"
  exit 0
}
. "$here/lib.sh"
start "$1"

bake bundle
expect 0 "$bin/play" bundle --path park/path.json --frames 2 --size 64x64 \
  --modes geometry,frustum,lod,hybrid,raycast,lod-equal,geometry-two-sided,frustum-two-sided \
  --stats stats.json
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
sys.exit(1 if errors else 0)
PY
check() { python3 check.py "$schemas/$1.schema.json" "$2"; }
for pair in scene:park/scene.json path:park/path.json cells:cells.json \
  captures:captures/captures.json bundle:bundle/bundle.json scene:bundle/scene.json \
  stats:stats.json stats:some.json stats:none.json; do
  check "${pair%%:*}" "${pair#*:}" || fail "$pair"
done
# They bite.
sed 's/"columns": 4/"columns": "four"/' cells.json >bad.json
check cells bad.json 2>/dev/null && fail "a bad cells.json passes"
sed 's/"psnr_db"/"psnr"/' stats.json >bad.json
check stats bad.json 2>/dev/null && fail "a bad stats.json passes"
echo "schemas.sh: all well"
