#include "import/import_level.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "formats/material_pictures.h"
#include "formats/texture_file.h"
#include "image/io.h"
#include "image/jpeg.h"
#include "image/shrink.h"
#include "mesh/offset.h"
#include "mesh/used_vertices.h"
#include "mesh/weld.h"

namespace viewcell {
namespace {

constexpr int kJpegQuality = 90;

std::string format_g(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

Wrap wrap_of(int gl_wrap) {
  if (gl_wrap == GlbSampler::kClampToEdge) return Wrap::clamp;
  return gl_wrap == GlbSampler::kMirrored ? Wrap::mirror : Wrap::repeat;
}

// z up, in the scene's units. Gives the height of the mesh's offset in metres.
double turn_and_scale(TriMesh& mesh, const ImportOptions& options) {
  double height = 0;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 unit(0);
    unit[axis] = 1;
    height += double(turn_up_axis(options.up, unit).z) * mesh.offset[axis];
  }
  const auto scale = static_cast<float>(options.unit_m * kUnitsPerMetre);
  for (glm::vec3& p : mesh.positions) p = turn_up_axis(options.up, p) * scale;
  for (glm::vec3& n : mesh.normals) n = turn_up_axis(options.up, n);
  for (glm::vec3& n : mesh.corner_normals) n = turn_up_axis(options.up, n);
  mesh.offset = glm::dvec3(0);  // wherever it was, the scene's origin is there
  return options.unit_m * height;
}

class LevelImporter {
 public:
  LevelImporter(const std::filesystem::path& file, const ImportOptions& options)
      : file_(file), options_(options) {}

  ImportedLevel run() {
    MeshSource source;
    TriMesh mesh = read_surface(file_, &source, options_.limits);
    out_.hash = source.hash;
    out_.remarks = source.remarks;
    set_on_floor(mesh, turn_and_scale(mesh, options_));
    add_materials(mesh);
    out_.piece_m = options_.piece_m > 0 ? options_.piece_m : choose_piece_m(area_m2_of(mesh));
    check_extent(mesh);
    out_.pieces = cut_into_pieces(mesh, {.size = out_.piece_m * kUnitsPerMetre});
    add_remark(&out_.remarks, "triangles without area, dropped", out_.pieces.n_dropped);
    add_objects(mesh);
    set_space();
    return std::move(out_);
  }

 private:
  void set_on_floor(TriMesh& mesh, double offset_m) {
    out_.floor_m = options_.floor_m.value_or(find_floor(mesh, 1 / kUnitsPerMetre) + offset_m);
    const auto height = static_cast<float>((out_.floor_m - offset_m) * kUnitsPerMetre);
    for (glm::vec3& p : mesh.positions) p.z -= height;
  }

  static double area_m2_of(const TriMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) sum += 0.5 * glm::length(area_normal(mesh, t));
    return sum / (kUnitsPerMetre * kUnitsPerMetre);
  }

  void check_extent(const TriMesh& mesh) const {
    constexpr double kMostPieces = 4096;  // along an axis
    const glm::dvec3 size = surface_box(mesh).size() / kUnitsPerMetre;
    const double longest = std::max({size.x, size.y, size.z});
    if (longest <= kMostPieces * out_.piece_m) return;
    throw InputError(file_.string(), "",
                     "is " + format_g(longest) + " m long, more than " + format_g(kMostPieces) +
                         " pieces: say what its unit is, or larger pieces");
  }

  // The materials of the level by name; material 0 is for triangles that have none.
  void add_materials(const TriMesh& mesh) {
    out_.scene.materials = {Material{.name = "none"}};
    if (!has_material_pictures(file_)) return;
    const MaterialPictures model = read_material_pictures(file_, PictureFaults::leave_out);
    for (const auto& [what, n] : model.remarks) add_remark(&out_.remarks, what, n);
    std::vector<std::string> files;  // of the pictures; empty: left out
    for (const ModelPicture& picture : model.pictures) files.push_back(add_picture(picture));
    for (const PicturedMaterial& m : model.materials) {
      material_of_[m.name] = static_cast<int>(out_.scene.materials.size());
      const std::string picture = m.color >= 0 ? files[static_cast<std::size_t>(m.color)] : "";
      out_.scene.materials.push_back(convert(m, mesh, picture));
    }
  }

  Material convert(const PicturedMaterial& m, const TriMesh& mesh, const std::string& picture) {
    Material out;
    out.name = m.name;
    // A glTF's factor is in its vertices' colours already; an OBJ's stand in place of its Kd.
    out.has_vertex_colors = !mesh.colors.empty();
    out.base_color = out.has_vertex_colors
                         ? glm::vec3(1)
                         : glm::clamp(glm::vec3(m.look.base_color_factor), 0.0f, 1.0f);
    if (!picture.empty()) {
      out.base_color_texture = picture;
      out.wrap_u = wrap_of(m.look.color_sampler.wrap_s);
      out.wrap_v = wrap_of(m.look.color_sampler.wrap_t);
    }
    out.double_sided = m.look.is_double_sided;
    // An OBJ does not say whether its pictures' alpha counts; holes in them are there to be seen,
    // and what has some, a leaf or a fence, is thin.
    if (is_obj() && has_holes_.contains(picture)) {
      out.alpha = AlphaMode::mask, out.double_sided = true;
      add_remark(&out_.remarks, "materials whose pictures have holes, drawn as masks, both sides");
    }
    out.opacity = static_cast<float>(std::clamp(m.look.base_color_factor.w, 0.0, 1.0));
    if (m.look.alpha_mode != "OPAQUE") {
      out.alpha = AlphaMode::mask;
      out.alpha_cutoff = static_cast<float>(
          m.look.alpha_mode == "MASK" ? std::clamp(m.look.alpha_cutoff, 0.0, 1.0) : 0.5);
      add_remark(&out_.remarks, "materials that blend, drawn where alpha is 0.5 or more",
                 m.look.alpha_mode == "BLEND");
    }
    out.emissive = glm::clamp(glm::vec3(m.look.emissive), 0.0f, 100.0f);
    return out;
  }

  bool is_obj() const {
    std::string ending = file_.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending == ".obj";
  }

  // Whether a thousandth of it, or more, is below half of what alpha may be.
  static bool is_holed(const ImageRgba8& image) {
    const auto n = std::count_if(image.pixels.begin(), image.pixels.end(),
                                 [](const Rgba8& pixel) { return pixel[3] < 128; });
    return 1000 * static_cast<std::size_t>(n) >= image.pixels.size();
  }

  // The file that it will be; empty, and a remark, where it cannot be read.
  std::string add_picture(const ModelPicture& picture) {
    try {
      return add_readable_picture(picture);
    } catch (const InputError& error) {
      add_remark(&out_.remarks, std::string(error.what()) + ": left out");
      return "";
    }
  }

  // Bytes stay as they are, but for pictures that are too large.
  std::string add_readable_picture(const ModelPicture& picture) {
    const std::string number = std::to_string(1000 + out_.pictures.size()).substr(1);
    const ImageFormat format =
        check_image_header(picture.bytes, picture.name, options_.image_limits);
    std::string ending = extension_of(format), bytes = picture.bytes;
    int lossy_quality = 0;
    const ImageRgba8 image =
        decode_texture(picture, {.limits = options_.image_limits}, &lossy_quality);
    if (std::max(image.width_px, image.height_px) > options_.max_texture_px) {
      const ImageRgba8 smaller = shrink_to_side(image, options_.max_texture_px, PixelKind::color);
      ending = lossy_quality > 0 ? ".jpg" : ".png";
      bytes =
          lossy_quality > 0 ? encode_jpeg(smaller, {.quality = kJpegQuality}) : encode_png(smaller);
      add_remark(&out_.remarks, "pictures made smaller");
    }
    out_.pictures.push_back({"textures/" + number + ending, std::move(bytes)});
    if (is_holed(image)) has_holes_.insert(out_.pictures.back().file);
    return out_.pictures.back().file;
  }

  void add_objects(const TriMesh& level) {
    for (std::size_t i = 0; i < out_.pieces.pieces.size(); ++i) {
      TriMesh& piece = out_.pieces.pieces[i];
      SceneMesh& mesh = out_.scene.meshes.emplace_back();
      mesh.name = "piece-" + std::to_string(100000 + i).substr(1);
      mesh.n_slots = std::max<std::size_t>(piece.material_names.size(), 1);
      mesh.file = "meshes/" + mesh.name + (mesh.n_slots > 1 ? ".obj" : ".ply");
      mesh.n_triangles = piece.triangles.size();
      SceneObject object;
      object.name = mesh.name;
      object.mesh = MeshId(i);
      object.materials.clear();
      for (const std::string& name : piece.material_names)
        object.materials.push_back(place_of(name));
      if (object.materials.empty()) object.materials = {0};
      if (level.colors.empty()) piece.colors.clear();
      add_remark(&out_.remarks, "vertices moved onto others next to them, so that cracks close",
                 close_cracks(piece).n_welded);
      object.translation = bring_near(piece);
      mesh.mesh = std::move(piece);
      out_.scene.objects.push_back(std::move(object));
    }
    out_.pieces.pieces.clear();
  }
  int place_of(const std::string& material) const {
    const auto found = material_of_.find(material);
    return found == material_of_.end() ? 0 : found->second;
  }

  // A small piece far from the scene's origin is written about a place of its own.
  static glm::dvec3 bring_near(TriMesh& piece) {
    change_offset(piece, choose_offset(bounding_box(piece)));
    const glm::dvec3 place = piece.offset;
    piece.offset = glm::dvec3(0);
    return place;
  }

  void set_space() {
    Box box;
    for (const SceneObject& object : out_.scene.objects)
      for (const glm::vec3& p : out_.scene.mesh_of(object).mesh.positions)
        box.add(object.world_from_model(glm::dvec3(p)));
    if (out_.scene.meshes.empty())
      throw InputError(file_.string(), "", "has no triangle with an area");
    out_.box_m = {box.lo / kUnitsPerMetre, box.hi / kUnitsPerMetre};
    out_.scene.name = file_.stem().string();
    out_.scene.area = {glm::dvec2(box.lo), glm::dvec2(box.hi)};
  }

  const std::filesystem::path file_;
  const ImportOptions& options_;
  ImportedLevel out_;
  std::map<std::string, int> material_of_;
  std::set<std::string> has_holes_;  // pictures, by file
};

}  // namespace

double choose_piece_m(double area_m2) {
  constexpr double kLeast_m = 8, kPieces = 1000;
  return std::max(kLeast_m, std::sqrt(area_m2 / kPieces));
}

double find_floor(const TriMesh& mesh, double unit_m) {
  constexpr double kStep_m = 0.05, kLeastCosine = 0.9;
  std::map<std::int64_t, double> areas, heights;  // by step: area, and area times height
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 normal = area_normal(mesh, t);
    const double length = glm::length(normal);
    if (!(normal.z > kLeastCosine * length)) continue;
    const double height =
        unit_m / 3 *
        (double(mesh.positions[t[0]].z) + mesh.positions[t[1]].z + mesh.positions[t[2]].z);
    const auto step =
        static_cast<std::int64_t>(std::floor(std::clamp(height, -1e9, 1e9) / kStep_m));
    areas[step] += length;
    heights[step] += length * height;
  }
  const auto most = std::max_element(
      areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == areas.end() ? 0 : heights[most->first] / most->second;
}

ImportedLevel import_level(const std::filesystem::path& file, const ImportOptions& options) {
  return LevelImporter(file, options).run();
}

void write_level(ImportedLevel& level, const std::filesystem::path& folder, const Json& provenance,
                 const Progress& progress) {
  for (const char* part : {"meshes", "textures"}) make_folder(folder / part);
  for (const ImportedPicture& picture : level.pictures)
    write_file(folder / picture.file, picture.bytes);
  std::vector<SceneMesh>& meshes = level.scene.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::filesystem::path file = folder / meshes[i].file;
    if (meshes[i].n_slots > 1)
      write_obj(file, meshes[i].mesh);
    else
      write_ply(file, meshes[i].mesh);
    meshes[i].hash = hash_file(file);
    if (progress) progress(i + 1, meshes.size());
  }
  write_file(folder / "scene.json", format_json(format_scene(level.scene, provenance)));
}

}  // namespace viewcell
