#!/usr/bin/env bash
# scripts/install-deps on machines that are not as wanted: one line that says what to do, exit 3. The
# machine is made of stand-ins for the programs that it calls.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/lib.sh"
start "$1"
script=$here/../../scripts/install-deps

mkdir programs
for p in bash env true grep tail mktemp rm cat; do ln -s "$(type -P "$p")" programs/; done
# stand_in NAME <TEXT: a program of that name.
stand_in() { { echo '#!/bin/bash'; cat; } >programs/"$1"; chmod +x programs/"$1"; }
run() { PATH=$PWD/programs "$(command -v bash)" "$script" >out 2>err; }
# refused TEXT...: exit 3, and the last line on stderr has the texts.
refused() {
  local code=0 text
  run || code=$?
  [ $code -eq 3 ] || { cat err >&2; fail "exits with $code, not 3"; }
  [ ! -s out ] || fail "writes to stdout"
  for text; do
    tail -n 1 err | grep -qF -- "$text" || { cat err >&2; fail "does not say '$text'"; }
  done
}

# The packages that are asked about are known but for three of them.
stand_in dpkg-query <<'END'
for p; do case $p in
  -*) ;;
  cmake) echo "cmake not-installed" ;;
  libglm-dev | time) ;;
  *) echo "$p installed" ;;
esac; done
exit 1
END
refused 'no apt-get' 'cmake' 'libglm-dev' 'time'

stand_in apt-get <<<'exit 0'
stand_in id <<<'echo 1000'
refused 'takes root rights' 'apt-get install -y --no-install-recommends cmake libglm-dev time'
stand_in sudo <<<'exit 1'
refused 'takes root rights'

# By sudo: what is missing is installed, nothing else.
stand_in sudo <<<'[ "$1" = -n ] || exit 1; shift; exec "$@"'
stand_in apt-get <<<'echo "$*" >>calls; echo noise; echo noise >&2'
run || { cat err >&2; fail "fails"; }
[ ! -s out ] || fail "writes to stdout"
[ "$(wc -l <err)" -eq 2 ] || { cat err >&2; fail "says more than two lines"; }
diff calls - <<'END' || fail "calls apt-get otherwise"
update -qq --error-on=any
install -y -qq --no-install-recommends cmake libglm-dev time
END

# No network: what update said, not that packages are unknown.
stand_in apt-get <<'END'
echo "W: some"; case $1 in
  update) echo "E: Failed to fetch x  Temporary failure resolving 'host'" ;;
  *) echo "E: Unable to locate package cmake" ;;
esac; exit 100
END
refused "Temporary failure resolving 'host'" 'check the network' 'libglm-dev'
# A package that is gone.
stand_in apt-get <<<'[ "$1" = update ] && exit 0; echo "E: Unable to locate package libglm-dev"; exit 100'
refused 'Unable to locate package libglm-dev'
# One of several sources is gone: the packages come from the others.
stand_in apt-get <<<'[ "$1" != update ]'
run || fail "a source that is gone stops it"

# Nothing is missing: not a word, and apt-get is not asked.
stand_in dpkg-query <<<'for p; do echo "$p installed"; done'
stand_in apt-get <<<'echo called >>called; exit 100'
run || fail "fails"
[ ! -s out ] && [ ! -s err ] && [ ! -e called ] || fail "does something where nothing is missing"
echo "install_deps.sh: all well"
