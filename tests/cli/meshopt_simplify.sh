#!/usr/bin/env bash
# Runs scripts/meshopt-simplify with a stand-in for the package: there is no network here. Skipped where
# node is missing, and where npm is, in its last part. First argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../scripts" && pwd)
start "$1"
ball 6 1 >ball.off
expect 0 "$bin/uvpatch" ball.off --faces 90 --texture-size 64 -o a.obj -q

# Words, and a machine without node.
simplify=$scripts/meshopt-simplify
expect 0 "$simplify" --help
grep -q 'meshopt-simplify MESH --faces N -o OUT' "$log/out" || fail "--help"
got=0
PATH=$log "$BASH" "$simplify" a.obj --faces 9 -o x.obj 2>"$log/err" || got=$?
[ $got -eq 3 ] && [ "$(cat "$log/err")" = "meshopt-simplify: node is missing; install it (Debian: apt-get install nodejs npm)" ] ||
  fail "$got $(cat "$log/err")"
command -v node >/dev/null || skip "there is no node (Debian: nodejs)"

# A stand-in that keeps the first faces asked for.
mkdir stand_in
export MESHOPTIMIZER=$PWD/stand_in CALL=$log/call
fault 3 "has no meshopt_simplifier.js" "$simplify" a.obj --faces 9 -o x.obj
echo '{"type": "module", "version": "9.8.7"}' >stand_in/package.json
cat >stand_in/meshopt_simplifier.js <<'JS'
import { writeFileSync } from 'node:fs';
const say = (name, lock, n, flags) =>
  writeFileSync(process.env.CALL, [name, lock === null ? 'free' : Array.from(lock).join(''), n, ...flags].join(' '));
export const MeshoptSimplifier = {
  ready: Promise.resolve(),
  simplifyWithAttributes(indices, at, stride, uv, uv_stride, weights, lock, n, error, flags) {
    say(`attributes ${at.length / stride} ${uv.length / uv_stride} ${weights}`, lock, n, flags);
    return [indices.slice(0, n), 0.5];
  },
  simplifyWithUpdate(indices, at, stride, uv, uv_stride, weights, lock, n, error, flags) {
    say('update', lock, n, flags);
    for (let i = 0; i < at.length; ++i) at[i] += 1;
    indices.reverse();
    return [6, 0.5];
  },
};
JS
# Four squares in a row but for the last; two charts that meet at x = 1; corners and vertices said twice.
cat >strip.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 1 0 0
v 2 0 0
v 2 1 0
v 0.1 0 0
vt 0 0
vt 0.4 0
vt 0.4 0.4
vt 0 0.4
vt 0.5 0
vt 0.9 0
vt 0.9 0.4
vt 0.5 0.4
vt 0 0
vn 0 0 1
f 1/1/1 2/2/1 3/3/1 4/4/1
f -4/5 6/6 7/7
f 3/8 5/5 7/7
f 4/4/1 1/9/1 2/2/1
OBJ
expect 0 "$simplify" strip.obj --faces 5 -o s.obj
cat >wanted.obj <<'OBJ'
# meshoptimizer 9.8.7 simplifyWithAttributes weight 10 flags none, 5 faces asked
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 0
v 2 1 0
vt 0 0
vt 0.400000006 0
vt 0.400000006 0.400000006
vt 0 0.400000006
vt 0.5 0
vt 0.899999976 0
vt 0.899999976 0.400000006
vt 0.5 0.400000006
f 1/1 2/2 3/3
f 1/1 3/3 4/4
f 2/5 5/6 6/7
f 3/8 2/5 6/7
f 4/4 1/1 2/2
OBJ
cmp s.obj wanted.obj || fail "$(diff s.obj wanted.obj)"
[ "$(cat "$CALL")" = 'attributes 8 8 10,10 free 15' ] || fail "$(cat "$CALL")"
grep -qx 'meshopt-simplify: 5 faces, error 0.5000' "$log/err" || fail "no summary"
expect 0 "$simplify" strip.obj --faces 2 --weight 0.5 --flags Permissive,Prune --protect -o t.obj -q
[ "$(cat "$CALL")" = 'attributes 8 8 0.5,0.5 02202002 6 Permissive Prune' ] || fail "$(cat "$CALL")"
expect 5 "$simplify" strip.obj --faces 1 --update -o t.obj
grep -qx 'f 1/1 2/2 3/3' t.obj && grep -qx 'v 2 1 1' t.obj || fail "$(cat t.obj)"
grep -q 'strip.obj: 1 faces were asked for, it stops at 2' "$log/err" || fail "$(cat "$log/err")"
bad_obj() { printf "$1" >bad.obj; fault 1 "bad.obj: $2" "$simplify" bad.obj --faces 1 -o x.obj; }
bad_obj 'v 0 0\n' 'line 1: are not 3 numbers'
bad_obj 'v 0 0 0\nvt 0 0\nf 1/1 1/1 2/1\n' "line 3: '2' is no index"
bad_obj 'v 0 0 0\nvt 0 0\nf 1/1 1/1 1\n' "line 3: a corner has no texture coordinate"
bad_obj 'v 0 0 0\nvt 0 0\nf 1/1 1/1\n' "line 3: a face has fewer"
bad_obj 'v 0 0 0\n' "has no faces"
fault 1 "missing.obj: cannot be read" "$simplify" missing.obj --faces 1 -o x.obj
fault 3 "cannot write no/x.obj" "$simplify" strip.obj --faces 5 -o no/x.obj
for words in "--faces 0" "--faces 9 --weight nan" "--faces 9 --flags All" "" "--faces 9 --protect" "--faces 9 b.obj"; do
  # shellcheck disable=SC2086  # words
  fault 2 "scripts/meshopt-simplify --help" "$simplify" strip.obj -o x.obj $words
done
[ "$n_faults" -eq 14 ] || fail "$n_faults faults typed"

# A copy of the scripts, and nobody at the registry's address.
command -v npm >/dev/null || skip "all but fetching the package: there is no npm (Debian: npm)"
unset MESHOPTIMIZER
mkdir copy copy/scripts
cp "$scripts"/meshopt-simplify* copy/scripts
expect 3 env npm_config_registry=http://127.0.0.1:9 npm_config_fetch_retries=0 npm_config_cache="$log/npm" \
  copy/scripts/meshopt-simplify strip.obj --faces 5 -o x.obj
[ "$(wc -l <"$log/err")" -eq 1 ] && grep -q 'npm cannot fetch meshoptimizer@1' "$log/err" || fail "$(cat "$log/err")"
[ -z "$(ls -A copy/out)" ] && [ ! -e x.obj ] || fail "left over: $(ls -A copy/out)"
echo "meshopt_simplify.sh: all well ($n_faults faults)"
