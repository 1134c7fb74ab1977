// Material libraries of OBJ files. Private to this room.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viewcell {

/// A line that names a picture.
struct MtlMap {
  std::string keyword;   ///< "map_Kd", "bump"
  std::string file;      ///< behind the options; blanks in it as they are, slashes forward
  std::string moved_by;  ///< the option that moves the picture on the surface: "-s"; empty: none
  std::size_t line = 0;
};

struct MtlMaterial {
  std::string name;                ///< as parse_obj names it: one blank between words
  std::optional<glm::vec3> color;  ///< Kd, as it stands
  double opacity = 1;              ///< d, or 1 - Tr
  std::vector<MtlMap> maps;
};

/// Materials in the order of the text. Other lines, and what stands above the first material, are
/// passed over.
std::vector<MtlMaterial> parse_mtl(std::string_view text);

/// The lines "mtllib" of an OBJ: each the name of one library, blanks included, or of several.
struct MtlNames {
  std::vector<std::string> libraries;
  std::vector<std::string> used;  ///< materials of "usemtl", each once
};
MtlNames find_mtl_names(std::string_view obj);

/// The words of a text with one blank between them.
std::string join_words(std::string_view text);
std::vector<std::string> split_words(std::string_view text);

}  // namespace viewcell
