#!/usr/bin/env bash
# Programs that call nothing of OpenImageIO do not load it: 260 libraries, 0.2 s of each start. First
# argument: the folder of binaries.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
start "$1"
needs_pictures() { readelf -d "$bin/$1" >"$log/needs" && grep -q 'NEEDED.*libOpenImageIO' "$log/needs"; }
needs_pictures psnr || fail "psnr does not name OpenImageIO: look for another way to tell"
for tool in hexcells meshdist parkgen plot pmesh subdivide; do
  ! needs_pictures $tool || fail "$tool loads OpenImageIO"
  [ -s "$log/needs" ] || fail "nothing is known of $tool"
done
echo "libraries.sh: all well"
