# Sourced by the scripts that measure texture adaptation: the cases, and how to prepare one.
# They set $from, the folder of models, $out, $bin and $here, and source metrics.sh.

# NAME; title; faces to simplify to; mesh; texture or - for uvpatch's check-board; how the mesh is made:
# "patch OPTIONS" of uvpatch, "subdivide OPTIONS", "turn": v runs down in the file, - for the file as it is. Mesh and texture are looked
# for by name, NAME|NAME..., in FROM and its folders.
cases='
swirl; Swirl; 399; 951gaspra_21_MLfix.obj; -; patch --faces 7688 --distort swirl
bunnyhead; Bunny head; 500; bunny.ply|bunny70k.ply; -; patch --up y --faces 17483
leeperrysmith; LeePerrySmith; 500; LeePerrySmith.glb; Map-COL.jpg; turn
josie; Josie; 300; josie.obj; josie.png; -
gaspra; Gaspra; 800; 951gaspra_21_MLfix.obj; 951gaspra.png; -
spot; Spot; 300; spot_triangulated.obj; spot_texture.png; -
blub; Blub; 800; blub_triangulated.obj; blub_texture.png; -
horse; Textured horse; 800; horse-textured-10k/horse.obj; horse-textured-10k/color.jpg; -
egyptiancat; Egyptian cat; 500; egyptian-cat-5k/cat.glb; egyptian-cat-5k/cat.glb; -
spotfour; Spot, subdivided, to 4 %; 3748; spot_triangulated.obj; spot_texture.png; subdivide --times 2
spotone; Spot, subdivided, to 1 %; 936; spot_triangulated.obj; spot_texture.png; subdivide --times 2
'

find_file() {  # NAME|NAME...: the first that FROM holds
  local candidate file
  for candidate in ${1//|/ }; do
    file=$(find -L "$from" -path "*/$candidate" -type f 2>/dev/null | sort | head -1)
    [ -z "$file" ] || { echo "$file"; return; }
  done
}

# prepare NAME FOLDER: sets $title, $faces, $mesh and $texture; what has to be made is made in FOLDER.
# Returns 1, with a line, where FROM does not hold the files or there is no such case.
prepare() {
  local row files textures how
  row=$(grep "^$1;" <<<"$cases") || { echo "$(basename "$0"): there is no case '$1'" >&2; return 1; }
  IFS=';' read -r _ title faces files textures how <<<"$row"
  title=${title# } faces=${faces# } files=${files# } textures=${textures# } how=${how# }
  mesh=$(find_file "$files") texture=
  [ "$textures" = - ] || texture=$(find_file "$textures")
  if [ -z "$mesh" ] || { [ -z "$texture" ] && [ "$textures" != - ]; }; then
    [ -n "$mesh" ] && files=$textures
    echo "$(basename "$0"): $1: no $files in $from, left out" >&2
    return 1
  fi
  mkdir -p "$2"
  # shellcheck disable=SC2086  # options are words
  case $how in
    patch\ *)
      [ -f "$2/mesh.obj" ] || "$bin/uvpatch" "$mesh" ${how#patch} -o "$2/mesh.obj" -q
      mesh=$2/mesh.obj
      [ -n "$texture" ] || texture=$2/mesh.png
      ;;
    subdivide\ *)
      [ -f "$2/mesh.obj" ] || "$bin/subdivide" "$mesh" ${how#subdivide} -o "$2/mesh.obj" -q
      mesh=$2/mesh.obj
      ;;
    turn)
      [ -f "$2/mesh.obj" ] || turn_texcoords "$mesh" "$2"
      mesh=$2/mesh.obj
      ;;
  esac
}

turn_texcoords() {  # MESH FOLDER: FOLDER/mesh.obj
  "$bin/subdivide" "$1" --times 0 -q -o - |
    awk '$1 == "vt" { $3 = sprintf("%.9g", 1 - $3) } { print }' >"$2/turned.new"
  mv "$2/turned.new" "$2/mesh.obj"
}

names_of_cases() { sed -n 's/^\([a-z0-9]*\);.*/\1/p' <<<"$cases"; }
