#!/usr/bin/env bash
# scripts/configure: a build folder of another compiler or checkout is refused in one line, never built on.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/lib.sh"
start "$1"
top=$(cd "$here/../.." && pwd)
compiler=$(command -v g++ || command -v c++)
version=$("$compiler" -dumpfullversion -dumpversion)

# built FROM COMPILER VERSION: the folder b, as an earlier configuration left it.
built() {
  rm -rf b && mkdir b
  printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\nCMAKE_CXX_COMPILER:FILEPATH=%s\n' "$1" "$2" >b/CMakeCache.txt
  echo "$3" >b/compiler-version
  touch b/build.ninja
}
configure() { env -u CXX "$@" "$top/scripts/configure" b; }
# refused TEXT [VARIABLE=VALUE]: exit 1, one line with the text and what to do, the folder as it was.
refused() {
  local text=$1
  shift
  fault_of 1 "$text" configure "$@"
}
fault_of() {
  local code=$1 text=$2 got=0
  shift 2
  snapshot >"$log/before"
  "$@" >"$log/out" 2>"$log/err" || got=$?
  snapshot >"$log/after"
  [ $got -eq "$code" ] || { cat "$log/err" >&2; fail "exits with $got, not $code"; }
  [ "$(wc -l <"$log/err")" -eq 1 ] || { cat "$log/err" >&2; fail "says more than a line"; }
  grep -qF -- "$text" "$log/err" || { cat "$log/err" >&2; fail "does not say '$text'"; }
  grep -q 'rm -r b' "$log/err" || fail "does not say what to do"
  cmp -s "$log/before" "$log/after" || fail "changes the folder"
}

built "$top" "$compiler" "$version"
configure >"$log/out" 2>"$log/err" || fail "refuses a folder of its own"
[ ! -s "$log/err" ] || fail "has something to say of a folder of its own"
built /elsewhere/viewcell "$compiler" "$version"
refused 'from /elsewhere/viewcell'
built "$top" "$compiler" 1.2.3
refused "$compiler 1.2.3, which is $version now"
built "$top" /no/such/g++ "$version"
refused 'by /no/such/g++, which is not there'
built "$top" "$compiler" "$version"
printf '#!/bin/sh\nexit 0\n' >other && chmod +x other
refused "not by $PWD/other" CXX="$PWD/other"

# Without CMake: what brings it.
mkdir programs
for p in bash sed cat grep dirname readlink; do ln -s "$(type -P "$p")" programs/; done
rm -rf b
got=0
PATH=$PWD/programs "$(type -P bash)" "$top/scripts/configure" b >"$log/out" 2>"$log/err" || got=$?
[ $got -eq 3 ] && grep -q 'no cmake; scripts/install-deps' "$log/err" || { cat "$log/err" >&2; fail "without CMake: $got"; }
[ ! -e b ] || fail "makes a folder without CMake"
echo "configure.sh: all well"
