// Source: Wavefront's OBJ and MTL.
#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
#include "formats/model_pictures.h"
#include "formats/mtl.h"
#include "formats/text_cursor.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

class ObjPictureReader {
 public:
  ObjPictureReader(const fs::path& file, PictureFaults faults) : file_(file), faults_(faults) {}

  MaterialPictures read(std::string_view bytes) {
    const MtlNames names = find_mtl_names(skip_byte_order_mark(bytes, file_.string()));
    const bool refuses = faults_ == PictureFaults::refuse;
    if (names.libraries.empty() && refuses)
      throw InputError(file_.string(), "", "names no material library (mtllib), so no pictures");
    used_ = names.used;
    for (const std::string& library : names.libraries) read_libraries(library);
    if (libraries_.empty() && refuses)
      throw InputError(file_.string(), "mtllib",
                       "'" + names.libraries[0] + "' is not there, and with it its pictures");
    add_remark(&out_.remarks, "material libraries that are not there", n_absent_);
    return std::move(out_);
  }

 private:
  // One file whose name may have blanks, or several.
  void read_libraries(std::string names) {
    std::replace(names.begin(), names.end(), '\\', '/');
    const fs::path whole = resolve_inside(file_, "mtllib", names);
    if (is_there(whole)) return read_library(whole);
    for (const std::string& name : split_words(names))
      if (const fs::path library = resolve_inside(file_, "mtllib", name); is_there(library))
        read_library(library);
      else
        ++n_absent_;
  }

  void read_library(const fs::path& library) {
    if (!libraries_.insert(library).second) return;
    const std::string text = read_file(library);
    for (const MtlMaterial& m : parse_mtl(skip_byte_order_mark(text, library.string()))) {
      const bool is_used = std::find(used_.begin(), used_.end(), m.name) != used_.end();
      if (is_used && find_material(out_, m.name) == nullptr) add_material(library, m);
    }
  }

  // A picture shows as it is, whatever it is to be multiplied by.
  void add_material(const fs::path& library, const MtlMaterial& from) {
    PicturedMaterial m;
    m.name = m.look.name = from.name;
    glm::vec3 color = from.color.value_or(glm::vec3(1));
    for (const MtlMap& map : from.maps)
      if (map.keyword != "map_Kd")
        add_remark(&out_.remarks, "pictures of " + map.keyword + ", left out");
      else
        m.color = or_left_out(faults_, out_.remarks, [&] { return picture(library, map); });
    if (m.color >= 0) color = glm::vec3(1);
    for (int k = 0; k < 3; ++k) color[k] = srgb_decode(std::clamp(color[k], 0.0f, 1.0f));
    m.look.base_color_factor = glm::dvec4(color, from.opacity);
    if (from.opacity < 1) m.look.alpha_mode = "BLEND";
    out_.materials.push_back(m);
  }

  // Beside its library, or beside the OBJ.
  int picture(const fs::path& library, const MtlMap& map) {
    const std::string place = "line " + std::to_string(map.line);
    if (!map.moved_by.empty())
      throw InputError(
          library.string(), place,
          map.keyword + " " + map.moved_by + ": a picture that is moved or scaled is not read");
    fs::path file = resolve_inside(library, place, map.file);
    if (const fs::path beside = file_.parent_path() / map.file; !is_there(file) && is_there(beside))
      file = resolve_inside(file_, place, map.file);
    if (const auto found = ids_.find(file); found != ids_.end()) return found->second;
    out_.pictures.push_back({read_file(file), file.string()});
    return ids_[file] = static_cast<int>(out_.pictures.size()) - 1;
  }

  fs::path file_;
  PictureFaults faults_;
  std::vector<std::string> used_;
  std::set<fs::path> libraries_;
  std::size_t n_absent_ = 0;
  std::map<fs::path, int> ids_;
  MaterialPictures out_;
};

}  // namespace

MaterialPictures read_obj_pictures(std::string_view bytes, const fs::path& file,
                                   PictureFaults faults) {
  return ObjPictureReader(file, faults).read(bytes);
}

}  // namespace viewcell
