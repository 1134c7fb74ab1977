# Sourced by the scripts beside it: a folder to work in, expectations of a typed command, and a scene of
# two balls that bakes in a second.

# start BIN: sets $bin, the folder of binaries, and goes to an empty folder that is removed at the end;
# $log is a folder outside it.
start() {
  bin=$(cd "$1" && pwd)
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  log=$work/log
  mkdir "$log" "$work/run"
  cd "$work/run"
}

fail() { echo "$(basename "$0"): $*" >&2; exit 1; }

# skip TEXT: ends the script; CTest says that it was skipped.
skip() { echo "$(basename "$0"): skipped: $*"; exit 77; }

# expect CODE COMMAND...: the exit code. stdout and stderr go to $log/out and $log/err.
expect() {
  local code=$1 got=0
  shift
  timeout 120 "$@" >"$log/out" 2>"$log/err" </dev/null || got=$?
  [ "$got" -eq "$code" ] || {
    head -c 2000 "$log/err" >&2
    fail "'${*##*/}' exits with $got, not $code"
  }
}

# What is in the caller's folder: names, sizes, times.
snapshot() { find . -type f -printf '%p %s %T@\n'; }

# fault CODE TEXT COMMAND...: an error: the exit code, nothing on stdout, one line on stderr that
# begins with the tool's name and has the text, and no file made, changed or left over.
n_faults=0
fault() {
  local code=$1 text=${2:?what the error says}
  shift 2
  snapshot >"$log/before"
  expect "$code" "$@"
  snapshot >"$log/after"
  [ ! -s "$log/out" ] || fail "'$*' writes to stdout"
  [ "$(wc -l <"$log/err")" -eq 1 ] || {
    head -c 2000 "$log/err" >&2
    fail "'$*': not one line on stderr"
  }
  grep -q "^${1##*/}: " "$log/err" || fail "'$*': $(cat "$log/err")"
  grep -qF -- "$text" "$log/err" || fail "'$*': no '$text' in: $(cat "$log/err")"
  cmp -s "$log/before" "$log/after" || {
    diff "$log/before" "$log/after" >&2
    fail "'$*' writes files"
  }
  n_faults=$((n_faults + 1))
}

# says FILE FILTER: whether jq's FILTER of a report is true. has_keys FILE KEY...: the report has each,
# however deep.
says() { [ "$(jq "$2" "$1")" = true ]; }
has_keys() {
  local key
  for key in "${@:2}"; do
    says "$1" "[.. | objects | has(\"$key\")] | any" || fail "no $key in the report: $(cat "$1")"
  done
}
# key NAME: the number in the report that the last expect got on stdout. is NAME VALUE: it is that.
key() { jq ".$1 | numbers" "$log/out"; }
is() { says "$log/out" ".$1 == $2" || fail "$1 is $(key "$1"), not $2"; }

# holds "EXPRESSION": of numbers, signs and blanks between them, as awk has them. What is no number, as
# the output of a command that failed, fails.
holds() {
  local number='[-+]?[0-9]+(\.[0-9]*)?(e[-+]?[0-9]+)?'
  [[ $1 =~ ^$number(\ ([-+*/<>]|<=|>=|==|&&)\ $number)*$ ]] || fail "'$1' is not of numbers"
  awk "BEGIN { exit !($1) }"
}

# differ A B: two files, or two folders, that are there and are not alike.
differ() {
  local code=0
  diff -rq "$1" "$2" >"$log/diff" || code=$?
  [ $code -eq 1 ]
}

# count_files GLOB
count_files() { { compgen -G "$1" || true; } | wc -l; }

# struck N GLOB COMMAND...: starts the command and kills it as soon as N files match; whether the kill
# met it at work, with more still to be written than that.
struck() {
  local n=$1 glob=$2 got=0 pid
  shift 2
  "$@" >"$log/out" 2>"$log/err" </dev/null &
  pid=$!
  while [ -e /proc/$pid/exe ] && [ "$(count_files "$glob")" -lt "$n" ]; do sleep 0.002; done
  kill -9 $pid 2>"$log/kill" || true  # it may have ended: what wait says tells
  wait $pid 2>"$log/kill" || got=$?
  [ $got -eq 137 ] || [ $got -eq 0 ] || fail "'${1##*/}' exits with $got: $(cat "$log/err")"
  [ $got -eq 137 ]
}

# ball N RADIUS: a closed sphere of N x 2N patches as OFF, to stdout.
ball() {
  awk -v n="$1" -v r="$2" 'BEGIN {
    pi = atan2(0, -1); m = 2 * n; last = 1 + (n - 1) * m
    printf "OFF\n%d %d 0\n0 0 %g\n", last + 1, 2 * (n - 1) * m, r
    for (i = 1; i < n; i++) for (j = 0; j < m; j++) {
      a = pi * i / n; b = 2 * pi * j / m
      printf "%g %g %g\n", r * sin(a) * cos(b), r * sin(a) * sin(b), r * cos(a)
    }
    printf "0 0 %g\n", -r
    for (j = 0; j < m; j++) printf "3 0 %d %d\n", 1 + j, 1 + (j + 1) % m
    for (i = 0; i < n - 2; i++) for (j = 0; j < m; j++) {
      a = 1 + i * m + j; b = 1 + i * m + (j + 1) % m
      printf "3 %d %d %d\n3 %d %d %d\n", a, a + m, b + m, a, b + m, b
    }
    for (j = 0; j < m; j++)
      printf "3 %d %d %d\n", last, 1 + (n - 2) * m + (j + 1) % m, 1 + (n - 2) * m + j
  }'
}

# make_park FOLDER: scene.json, ball.off and path.json. The path stays in one cell of size 50.
make_park() {
  mkdir -p "$1"
  ball 12 8 >"$1/ball.off"
  cat >"$1/scene.json" <<'JSON'
{"format": "viewcell-scene", "version": 1, "name": "two balls",
 "area": {"lo": [0, 0], "hi": [200, 150]},
 "ground": {"z": 0, "color": [0.1, 0.1, 0.1]},
 "sky": {"color": [0.3, 0.4, 0.6]},
 "light": {"toward_light": [0.6, 0, 0.8], "color": [1, 1, 1],
           "ambient_sky": [0.2, 0.2, 0.3], "ambient_ground": [0.1, 0.1, 0.1]},
 "materials": [{"name": "stone", "base_color": [0.5, 0.5, 0.4], "base_color_texture": null,
                "double_sided": false}],
 "meshes": [{"name": "ball", "file": "ball.off", "up": "z", "scale": 1}],
 "objects": [
  {"name": "near", "mesh": 0, "material": 0, "translation": [40, 40, 8],
   "rotation": [0, 0, 0, 1], "scale": 1},
  {"name": "far", "mesh": 0, "material": 0, "translation": [190, 140, 8],
   "rotation": [0, 0, 0, 1], "scale": 1}]}
JSON
  cat >"$1/path.json" <<'JSON'
{"format": "viewcell-path", "version": 1, "samples": [
 {"time_s": 0, "eye": [90, 50, 8], "forward": [-1, 0, 0]},
 {"time_s": 1, "eye": [100, 60, 8], "forward": [1, 1, 0]}]}
JSON
}

# bake BUNDLE: the whole chain in the caller's folder: park, cells.json, captures, sv, mv, BUNDLE.
bake() {
  make_park park
  expect 0 "$bin/hexcells" park/scene.json --size 50 --eye-height 6:10 --choose paper -o cells.json
  expect 0 "$bin/depthcap" park/scene.json cells.json --resolution 128 -o captures
  expect 0 "$bin/svmesh" park/scene.json cells.json captures -o sv
  expect 0 "$bin/mvmesh" park/scene.json cells.json captures -o mv
  expect 0 "$bin/cellpack" park/scene.json cells.json captures sv mv -o "$1"
}

# bake_of BUNDLE: the folder of its files.
bake_of() { compgen -G "$1/bake-*"; }

# overwrite FILE OFFSET TEXT: the bytes at that place.
overwrite() { printf '%b' "$3" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none; }

# noise N: the same bytes every time, to stdout.
noise() {
  LC_ALL=C awk -v n="$1" 'BEGIN {
    x = 1
    for (i = 0; i < n; i++) { x = (x * 16807) % 2147483647; printf "%c", int(x / 256) % 256 }
  }'
}

# nested: JSON 200,000 deep, to stdout.
nested() {
  head -c 200000 /dev/zero | tr '\0' '['
  head -c 200000 /dev/zero | tr '\0' ']'
}

# json_faults FILE COMMAND...: the ways in which a JSON file that the command reads can be broken.
# FILE is mended afterwards. optional=yes: it may be missing.
json_faults() {
  local file=$1
  shift
  cp "$file" "$log/good.json"
  rm "$file"
  [ -n "${optional-}" ] || fault 1 "$file" "$@"
  : >"$file"
  fault 1 "$file: line" "$@"
  head -c $(($(stat -c %s "$log/good.json") / 2)) "$log/good.json" >"$file"
  fault 1 "$file: line" "$@"
  nested >"$file"
  fault 1 "nested deeper" "$@"
  echo '{"format": "viewcell-nothing", "version": 1}' >"$file"
  fault 1 "$file: \"format\" is not" "$@"
  sed 's/"version": [0-9]/"version": 99/' "$log/good.json" >"$file"
  fault 1 "$file: version" "$@"
  noise 4096 >"$file"
  fault 1 "$file" "$@"
  echo '[]' >"$file"
  fault 1 "$file: is not a JSON object" "$@"
  rm "$file"
  mkdir "$file"
  fault 1 "$file: is a folder" "$@"
  rmdir "$file"
  cp -p "$log/good.json" "$file"
}
