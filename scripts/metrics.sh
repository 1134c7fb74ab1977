# Sourced by the scripts that compare the metrics of pmesh: their names and options, and how to read
# what the tools report.

# name=options of pmesh build, in the order of tables and legends
metrics=(
  "qem3=--metric qem3"
  "qem5=--metric qem5"
  "aps=--metric aps"
  "mapping=--metric mapping"
  "mapping-mean=--metric mapping --measure mean"
  "qem3-full=--metric qem3 --placement full"
  "mapping-full=--metric mapping --placement full"
  "mapping-mean-full=--metric mapping --measure mean --placement full"
  "lt=--metric lt"
)

# value REPORT PATH: a number of a report, by jq's path.
value() {
  local numbers
  numbers=$(jq -r "$2 | numbers" "$1") && [ -n "$numbers" ] ||
    { echo "$(basename "$0"): $1 has no number $2" >&2; return 1; }
  echo "$numbers"
}

# build_pm MESH OPTIONS PM REPORT: pmesh build; a mesh that cannot go as far as asked is whole, too.
# Returns 1 for a metric that needs texture coordinates which the mesh has not; exits 1 for any
# other failure.
build_pm() {
  local code=0
  # shellcheck disable=SC2086  # options are words
  "$bin/pmesh" build "$1" $2 -o "$3" -q --json "$4" 2>"$3.err" || code=$?
  [ $code -eq 0 ] || [ $code -eq 5 ] && return 0
  grep -q 'has no texture coordinates' "$3.err" && return 1
  cat "$3.err" >&2
  exit 1
}
