#include "formats/gltf_draco.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <draco/metadata/metadata_decoder.h>

#include <memory>
#include <span>
#include <stdexcept>

#include "base/child.h"

// Source: the Draco bitstream specification 2.2: header, and what begins the connectivity.

namespace viewcell {
namespace {

// Beside the attributes that the primitive names, others may stand in the bytes.
constexpr std::size_t kOtherBytesPerVertex = 256;

// What decoding may take: several times what whole meshes were seen to take.
constexpr std::size_t kMemoryBytes = 1 << 25, kMemoryBytesPerElement = 512;
constexpr int kCpuSeconds = 2;
constexpr std::size_t kTrianglesPerCpuSecond = 50000;

// Draco allocates what the bytes say, and constant values take no bytes. When it knows the
// attributes, and before it decodes any, they are held against what was wished for.
template <typename Decoder>
class BoundedDecoder : public Decoder {
 public:
  BoundedDecoder(std::size_t n_vertices, std::size_t most_bytes_per_vertex)
      : n_vertices_(n_vertices), most_bytes_per_vertex_(most_bytes_per_vertex) {}
  bool is_stopped() const { return is_stopped_; }

 protected:
  bool DecodeAllAttributes() override {
    const draco::PointCloud& points = *this->point_cloud();
    std::size_t n_bytes = 0;
    for (int i = 0; i < points.num_attributes(); ++i)
      n_bytes += std::size_t{8} * points.attribute(i)->num_components();
    is_stopped_ = points.num_points() != n_vertices_ || n_bytes > most_bytes_per_vertex_;
    return !is_stopped_ && Decoder::DecodeAllAttributes();
  }

 private:
  std::size_t n_vertices_, most_bytes_per_vertex_;
  bool is_stopped_ = false;
};

draco::DecoderBuffer buffer_of(std::string_view packed) {
  draco::DecoderBuffer buffer;
  buffer.Init(packed.data(), packed.size());
  return buffer;
}

draco::DracoHeader read_header(draco::DecoderBuffer& buffer, const JsonCursor& extension) {
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
    extension.fail("is damaged: it has no header of Draco");
  if (header.version_major != 2 || header.version_minor > 2)
    extension.fail("is of Draco's version " + std::to_string(header.version_major) + "." +
                   std::to_string(header.version_minor) + "; 2.0 to 2.2 are read");
  if (header.encoder_type != draco::TRIANGULAR_MESH) extension.fail("is no mesh");
  return header;
}

// The number of triangles, which stands before anything of their size.
std::uint64_t peek_triangles(draco::DecoderBuffer& buffer, const draco::DracoHeader& header,
                             const JsonCursor& extension) {
  bool is_read = true;
  std::uint32_t n_triangles = 0, n_vertices = 0;
  const auto read = [&](auto& value) { is_read = is_read && draco::DecodeVarint(&value, &buffer); };
  if (header.flags & METADATA_FLAG_MASK) {
    draco::GeometryMetadata metadata;
    is_read = draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata);
  }
  const bool is_old = header.version_minor < 2;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    std::uint8_t traversal = 0;
    is_read = is_read && buffer.Decode(&traversal);
    if (is_old) read(n_vertices);  // new ones
    read(n_vertices);
    read(n_triangles);
  } else if (is_old) {
    is_read = is_read && buffer.Decode(&n_triangles);
  } else {
    read(n_triangles);
  }
  if (!is_read) extension.fail("is damaged: it ends in its header");
  return n_triangles;
}

template <typename Decoder>
std::unique_ptr<draco::Mesh> decode(std::string_view packed, const DracoShape& shape) {
  std::size_t most = kOtherBytesPerVertex;
  for (const auto& [name, attribute] : shape.attributes) most += 8 * attribute.n_components;
  BoundedDecoder<Decoder> decoder(shape.n_vertices, most);
  auto mesh = std::make_unique<draco::Mesh>();
  draco::DecoderBuffer buffer = buffer_of(packed);
  const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, mesh.get());
  if (decoder.is_stopped())
    throw std::runtime_error("holds " + std::to_string(mesh->num_points()) + " vertices of " +
                             std::to_string(mesh->num_attributes()) + " attributes, not the " +
                             std::to_string(shape.n_vertices) + " that its accessors say");
  if (!status.ok()) throw std::runtime_error("is damaged: Draco cannot decode it");
  return mesh;
}

void copy_attribute(draco::Mesh& mesh, const std::string& name, const DracoShape::Attribute& wish,
                    std::span<float> out) {
  const int id = mesh.GetAttributeIdByUniqueId(static_cast<std::uint32_t>(wish.id));
  if (id < 0) throw std::runtime_error("has no attribute " + std::to_string(wish.id));
  draco::PointAttribute& attribute = *mesh.attribute(id);
  if (attribute.num_components() != wish.n_components)
    throw std::runtime_error("has " + std::to_string(attribute.num_components()) +
                             " components of " + name + ", its accessor " +
                             std::to_string(wish.n_components));
  attribute.set_normalized(false);
  for (std::uint32_t v = 0; v < mesh.num_points(); ++v)
    if (!attribute.ConvertValue<float>(attribute.mapped_index(draco::PointIndex(v)),
                                       static_cast<std::int8_t>(wish.n_components),
                                       out.data() + v * wish.n_components))
      throw std::runtime_error("is damaged: " + name + " is too short");
}

void copy_triangles(const draco::Mesh& mesh, std::span<Triangle> out) {
  if (mesh.num_faces() != out.size()) throw std::runtime_error("is damaged: faces are missing");
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      out[f][k] = mesh.face(draco::FaceIndex(f))[k].value();
      if (out[f][k] >= mesh.num_points())
        throw std::runtime_error("is damaged: a vertex does not exist");
    }
}

void decode_into(std::string_view packed, std::uint8_t method, const DracoShape& shape,
                 std::span<Triangle> triangles, std::span<float> values) {
  const auto mesh = method == draco::MESH_EDGEBREAKER_ENCODING
                        ? decode<draco::MeshEdgebreakerDecoder>(packed, shape)
                        : decode<draco::MeshSequentialDecoder>(packed, shape);
  copy_triangles(*mesh, triangles);
  for (const auto& [name, wish] : shape.attributes) {
    const std::size_t n = shape.n_vertices * wish.n_components;
    copy_attribute(*mesh, name, wish, values.first(n));
    values = values.subspan(n);
  }
}

template <typename T>
std::span<T> as_span_of(std::span<std::byte> bytes) {
  return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
}

}  // namespace

// In a process of its own: Draco 1.5.5 takes seconds and 256 MB for a number that is damaged (of
// orientations of texture coordinates), and was not made for bytes that mean harm.
DracoMesh decode_draco(std::string_view packed, const DracoShape& shape,
                       const JsonCursor& extension) {
  draco::DecoderBuffer buffer = buffer_of(packed);
  const draco::DracoHeader header = read_header(buffer, extension);
  if (const auto n = peek_triangles(buffer, header, extension); n != shape.n_triangles)
    extension.fail("holds " + std::to_string(n) + " triangles, not the " +
                   std::to_string(shape.n_triangles) + " that its accessors say");
  std::size_t n_values = 0;
  for (const auto& [name, wish] : shape.attributes)
    n_values += shape.n_vertices * wish.n_components;
  const SharedBytes triangles(shape.n_triangles * sizeof(Triangle)),
      values(n_values * sizeof(float));
  const ChildLimits limits{
      .memory_bytes = kMemoryBytes + kMemoryBytesPerElement * (shape.n_triangles + n_values),
      .cpu_s = kCpuSeconds + static_cast<int>(shape.n_triangles / kTrianglesPerCpuSecond)};
  const std::string wrong = run_in_child(limits, [&] {
    decode_into(packed, header.encoder_method, shape, as_span_of<Triangle>(triangles.bytes()),
                as_span_of<float>(values.bytes()));
  });
  if (!wrong.empty())
    extension.fail(wrong.starts_with("it ") ? "is damaged: decoding " + wrong.substr(3) : wrong);
  const auto all = as_span_of<Triangle>(triangles.bytes());
  DracoMesh out{{all.begin(), all.end()}, {}};
  auto rest = as_span_of<float>(values.bytes());
  for (const auto& [name, wish] : shape.attributes) {
    const auto own = rest.first(shape.n_vertices * wish.n_components);
    out.attributes[name].assign(own.begin(), own.end());
    rest = rest.subspan(own.size());
  }
  return out;
}

}  // namespace viewcell
