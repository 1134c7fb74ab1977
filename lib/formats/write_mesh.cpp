#include <algorithm>
#include <cctype>

#include "formats/mesh_file.h"
#include "formats/write_glb.h"

namespace viewcell {

const std::vector<std::string> kWrittenEndings = {".ply", ".obj", ".stl", ".off", ".glb"};

MeshFormat written_format(const std::filesystem::path& file, MeshFormat otherwise) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::find(kWrittenEndings.begin(), kWrittenEndings.end(), ending);
  return found == kWrittenEndings.end() ? otherwise
                                        : static_cast<MeshFormat>(found - kWrittenEndings.begin());
}

void write_mesh(const std::filesystem::path& file, MeshFormat format, const TriMesh& mesh,
                const std::vector<std::string>& comments, Remarks* remarks) {
  switch (format) {
    case MeshFormat::ply:
      return write_ply(file, mesh, comments, remarks);
    case MeshFormat::obj:
      return write_obj(file, mesh, {comments, "", ""});
    case MeshFormat::stl:
      return write_stl(file, mesh, comments, remarks);
    case MeshFormat::off:
      return write_off(file, mesh, comments, remarks);
    case MeshFormat::glb:
      return write_glb(file, mesh, {"", "", comments.empty() ? "" : comments[0]}, remarks);
  }
}

}  // namespace viewcell
