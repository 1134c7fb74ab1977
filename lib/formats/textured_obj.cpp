#include "formats/textured_obj.h"

#include "base/error.h"
#include "base/file.h"
#include "formats/mesh_file.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

// Source: Wavefront's MTL. White, so that the picture shows as it is.
std::string format_material(const std::string& name, const fs::path& picture) {
  return "newmtl " + name + "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd " +
         picture.filename().string() + "\n";
}

void check_can_be_replaced(const fs::path& file) {
  if (fs::is_directory(file))
    throw MachineError(file.string() + ": cannot rename into place: is a folder");
}

}  // namespace

void write_textured_obj(const fs::path& obj, const TriMesh& mesh,
                        const std::string& picture_extension,
                        const std::function<void(const fs::path&)>& write_picture,
                        const std::vector<std::string>& comments) {
  const std::string name = obj.stem().string();
  const fs::path mtl = fs::path(obj).replace_extension(".mtl");
  const fs::path picture = fs::path(obj).replace_extension(picture_extension);
  if (obj.has_parent_path() && !fs::is_directory(obj.parent_path()))
    throw MachineError(obj.string() + ": cannot create: there is no such folder");
  for (const fs::path& file : {picture, mtl, obj}) check_can_be_replaced(file);
  PendingFolder pending(obj);
  const auto pending_file = [&](const fs::path& file) { return pending.path() / file.filename(); };
  write_picture(pending_file(picture));
  write_file(pending_file(mtl), format_material(name, picture));
  write_obj(pending_file(obj), mesh,
            {.comments = comments, .material_library = mtl.filename().string(), .material = name});
  fs::remove(obj);
  for (const fs::path& file : {picture, mtl, obj}) pending.commit(file.filename(), file);
}

}  // namespace viewcell
