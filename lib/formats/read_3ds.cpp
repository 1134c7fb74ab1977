// Source: the 3D Studio file format, as in M. Pitts (1994) and Autodesk's 3DS File Toolkit.
// Differs: not by lib3ds (1.3.0 tried), which reads corner 60000 of three vertices while it opens a
// file, to compute normals, and writes a material's name at face 60000 of one.
#include "formats/byte_cursor.h"
#include "formats/face_list.h"
#include "formats/material_ids.h"
#include "formats/readers.h"

namespace viewcell {
namespace {

enum ChunkId : std::uint16_t {
  kMain = 0x4d4d,
  kEditor = 0x3d3d,
  kObject = 0x4000,
  kTriangleMesh = 0x4100,
  kVertices = 0x4110,
  kFaces = 0x4120,
  kFaceMaterial = 0x4130,
  kTexcoords = 0x4140,
  kSmoothing = 0x4150,
};

// One object's arrays, before it is appended to the mesh.
struct Object {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> texcoords;  // per vertex, or empty
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> materials;  // per triangle
};

struct State {
  TriMesh mesh;
  MaterialIds material_ids;
  std::vector<std::int32_t> materials;  // per triangle of the mesh
  bool has_texcoords = false;
  std::size_t n_grouped = 0;  // faces with smoothing groups of their own
};

// Calls body(id, content) for each chunk.
template <typename Body>
void for_each_chunk(ByteCursor cursor, const Body& body) {
  constexpr std::uint32_t kHeaderBytes = 6;
  while (cursor.bytes_left() >= kHeaderBytes) {
    const auto id = cursor.read<std::uint16_t>();
    const auto n_bytes = cursor.read<std::uint32_t>();  // with the header
    if (n_bytes < kHeaderBytes) cursor.fail("a chunk shorter than its header");
    body(id, cursor.part(n_bytes - kHeaderBytes));
  }
}

std::string read_name(ByteCursor& cursor) {
  std::string name;
  while (const char c = cursor.read<char>()) name += c;
  return name;
}

void read_vertex_chunk(ByteCursor cursor, Object& object) {
  object.positions.resize(cursor.read<std::uint16_t>());
  for (glm::vec3& p : object.positions)
    for (int k = 0; k < 3; ++k) p[k] = cursor.read<float>();
}

void read_texcoord_chunk(ByteCursor cursor, Object& object) {
  object.texcoords.resize(cursor.read<std::uint16_t>());
  for (glm::vec2& t : object.texcoords)
    for (int k = 0; k < 2; ++k) t[k] = cursor.read<float>();
}

void read_face_material(ByteCursor cursor, State& state, Object& object) {
  const std::int32_t id = state.material_ids.add(read_name(cursor));
  for (int left = cursor.read<std::uint16_t>(); left > 0; --left) {
    const auto face = cursor.read<std::uint16_t>();
    if (face >= object.materials.size()) cursor.fail("a material is given to a face that is not");
    object.materials[face] = id;
  }
}

// A mask of groups each: where one differs from the first, some edge is hard.
std::size_t count_grouped(ByteCursor cursor, std::size_t n_faces) {
  if (n_faces == 0 || cursor.bytes_left() < 4 * n_faces) return 0;
  const auto first = cursor.read<std::uint32_t>();
  std::size_t n = first == 0;
  for (std::size_t f = 1; f < n_faces; ++f) n += cursor.read<std::uint32_t>() != first;
  return n > 0 ? n_faces : 0;
}

void read_face_chunk(ByteCursor cursor, State& state, Object& object) {
  object.triangles.resize(cursor.read<std::uint16_t>());
  object.materials.assign(object.triangles.size(), MaterialIds::kNone);
  for (Triangle& triangle : object.triangles) {
    for (std::uint32_t& corner : triangle) corner = cursor.read<std::uint16_t>();
    cursor.take(2);  // flags: which edges show
  }
  for_each_chunk(cursor, [&](std::uint16_t id, ByteCursor content) {
    if (id == kFaceMaterial) read_face_material(content, state, object);
    if (id == kSmoothing) state.n_grouped += count_grouped(content, object.triangles.size());
  });
}

// Texture coordinates of objects that have none are zero.
void append_object(const Object& object, State& state, const ByteCursor& cursor) {
  TriMesh& mesh = state.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const bool has_texcoords = !object.texcoords.empty();
  if (has_texcoords && object.texcoords.size() != object.positions.size())
    cursor.fail("an object has not one texture coordinate a vertex");
  state.has_texcoords |= has_texcoords;
  for (const Triangle& triangle : object.triangles) {
    for (const std::uint32_t v : triangle) {
      if (v >= object.positions.size())
        cursor.fail("triangle " + std::to_string(mesh.triangles.size()) + ": vertex " +
                    std::to_string(v) + " does not exist; its object has " +
                    std::to_string(object.positions.size()));
      mesh.texcoords.push_back(has_texcoords ? object.texcoords[v] : glm::vec2(0));
    }
    mesh.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
  }
  mesh.positions.insert(mesh.positions.end(), object.positions.begin(), object.positions.end());
  state.materials.insert(state.materials.end(), object.materials.begin(), object.materials.end());
}

void read_triangle_mesh(ByteCursor cursor, State& state) {
  Object object;
  for_each_chunk(cursor, [&](std::uint16_t id, ByteCursor content) {
    if (id == kVertices) read_vertex_chunk(content, object);
    if (id == kFaces) read_face_chunk(content, state, object);
    if (id == kTexcoords) read_texcoord_chunk(content, object);
  });
  append_object(object, state, cursor);
}

void read_object(ByteCursor cursor, State& state) {
  read_name(cursor);
  for_each_chunk(cursor, [&](std::uint16_t id, const ByteCursor& content) {
    if (id == kTriangleMesh) read_triangle_mesh(content, state);
  });
}

}  // namespace

TriMesh parse_3ds(std::string_view bytes, const std::filesystem::path& file, Remarks* remarks) {
  ByteCursor cursor(bytes, file.string());
  if (bytes.size() < 6 || cursor.read<std::uint16_t>() != kMain)
    throw InputError(file.string(), "", "is not a 3DS file");
  State state;
  for_each_chunk(ByteCursor(bytes, file.string()), [&](std::uint16_t top, const ByteCursor& main) {
    if (top != kMain) return;
    for_each_chunk(main, [&](std::uint16_t id, const ByteCursor& editor) {
      if (id != kEditor) return;
      for_each_chunk(editor, [&](std::uint16_t object_id, const ByteCursor& object) {
        if (object_id == kObject) read_object(object, state);
      });
    });
  });
  if (!state.has_texcoords) state.mesh.texcoords.clear();
  state.material_ids.finish(std::move(state.materials), state.mesh);
  choose_offset_of(corners_of(state.mesh), state.mesh, remarks);
  add_remark(remarks, "faces with smoothing groups, passed over: all edges are smooth",
             state.n_grouped);
  return std::move(state.mesh);
}

}  // namespace viewcell
