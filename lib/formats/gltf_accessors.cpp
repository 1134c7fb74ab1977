#include "formats/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace viewcell {
namespace {

constexpr std::int64_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                       kUnsignedInt = 5125, kFloat = 5126;

// An accessor of zeros takes no bytes; what is honest has some for its vertices elsewhere.
constexpr std::uint64_t kMostZerosPerByte = 4;

// Elements in a row inside a buffer view; first null: zeros.
struct Elements {
  const char* first = nullptr;
  std::size_t count = 0, stride = 0;
};

std::size_t component_bytes(std::int64_t type, const JsonCursor& object) {
  switch (type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      object.at("componentType").fail("is no component type of glTF");
  }
}

JsonCursor accessor_at(const GltfFile& gltf, std::int64_t id) {
  return gltf.root().at("accessors").at(static_cast<std::size_t>(id));
}

std::size_t count_components(const JsonCursor& accessor) {
  const std::string name = accessor.at("type").string();
  if (name == "SCALAR") return 1;
  if (name == "MAT4") return 16;
  for (std::size_t n = 2; n <= 4; ++n)
    if (name == "VEC" + std::to_string(n)) return n;
  accessor.at("type").fail("expected SCALAR, VEC2, VEC3, VEC4 or MAT4");
}

// place: an accessor, or the indices or values of a sparse one; has_stride: the view's is followed.
Elements locate(const GltfFile& gltf, const JsonCursor& place, std::size_t count,
                std::size_t element_bytes, bool has_stride) {
  const std::int64_t view_id = gltf_index(place.at("bufferView"));
  const GltfView view = read_view(gltf, view_id);
  Elements e{nullptr, count, element_bytes};
  if (has_stride && view.stride != 0) e.stride = view.stride;
  if (e.stride < element_bytes) {
    const JsonCursor at = gltf.root().at("bufferViews").at(static_cast<std::size_t>(view_id));
    at.fail("its byteStride is out of range: an element has " + std::to_string(element_bytes) +
            " bytes");
  }
  const std::int64_t start =
      place.has("byteOffset") ? place.at("byteOffset").integer(0, 1LL << 40) : 0;
  if (static_cast<std::size_t>(start) + (count - 1) * e.stride + element_bytes > view.bytes.size())
    place.fail("is past its buffer view's end");
  e.first = view.bytes.data() + start;
  return e;
}

Elements locate_dense(const GltfFile& gltf, const JsonCursor& accessor, const GltfNumbers& shape) {
  const std::size_t n_bytes = shape.n_components * component_bytes(shape.component_type, accessor);
  if (accessor.has("bufferView")) return locate(gltf, accessor, shape.count, n_bytes, true);
  if (shape.count / kMostZerosPerByte > gltf.n_bytes)
    accessor.at("count").fail(std::to_string(shape.count) +
                              " zeros stand for more than the file can hold");
  return {nullptr, shape.count, 0};
}

// Of component k of each element, as `Out` after `convert`.
template <typename T, typename Out, typename Convert>
void copy_components(const Elements& e, std::size_t n_components, const Convert& convert,
                     Out* out) {
  for (std::size_t i = 0; i < e.count; ++i)
    for (std::size_t k = 0; k < n_components; ++k) {
      T value;
      std::memcpy(&value, e.first + i * e.stride + k * sizeof(T), sizeof(T));
      *out++ = convert(value);
    }
}

template <typename T>
void copy_floats(const Elements& e, const GltfNumbers& shape, float* out) {
  const float scale = shape.scale();
  const float least = shape.normalized ? -1.0f : -std::numeric_limits<float>::infinity();
  copy_components<T>(
      e, shape.n_components,
      [&](T value) { return std::max(static_cast<float>(value) * scale, least); }, out);
}

void read_components(const Elements& e, const GltfNumbers& shape, const JsonCursor&, float* out) {
  switch (shape.component_type) {
    case kByte:
      return copy_floats<std::int8_t>(e, shape, out);
    case kUnsignedByte:
      return copy_floats<std::uint8_t>(e, shape, out);
    case kShort:
      return copy_floats<std::int16_t>(e, shape, out);
    case kUnsignedShort:
      return copy_floats<std::uint16_t>(e, shape, out);
    case kUnsignedInt:
      return copy_floats<std::uint32_t>(e, shape, out);
    default:
      return copy_components<float>(
          e, shape.n_components, [](float value) { return value; }, out);
  }
}

void read_components(const Elements& e, const GltfNumbers& shape, const JsonCursor& accessor,
                     std::uint32_t* out) {
  const auto same = [](auto value) { return static_cast<std::uint32_t>(value); };
  switch (shape.component_type) {
    case kUnsignedByte:
      return copy_components<std::uint8_t>(e, shape.n_components, same, out);
    case kUnsignedShort:
      return copy_components<std::uint16_t>(e, shape.n_components, same, out);
    case kUnsignedInt:
      return copy_components<std::uint32_t>(e, shape.n_components, same, out);
    default:
      accessor.fail("expected unsigned whole numbers");
  }
}

std::vector<std::uint32_t> read_sparse_indices(const GltfFile& gltf, const JsonCursor& sparse,
                                               std::size_t count) {
  const JsonCursor place = sparse.at("indices");
  GltfNumbers shape;
  shape.count =
      static_cast<std::size_t>(sparse.at("count").integer(1, static_cast<std::int64_t>(count)));
  shape.n_components = 1;
  shape.component_type = place.at("componentType").integer(0, 1 << 20);
  const std::size_t n_bytes = component_bytes(shape.component_type, place);
  const Elements e = locate(gltf, place, shape.count, n_bytes, false);
  std::vector<std::uint32_t> out(shape.count);
  read_components(e, shape, place, out.data());
  for (std::size_t i = 0; i < out.size(); ++i)
    if (out[i] >= count || (i > 0 && out[i] <= out[i - 1]))
      place.fail("entry " + std::to_string(i) + ": element " + std::to_string(out[i]) +
                 (out[i] >= count ? " does not exist; there are " + std::to_string(count)
                                  : " does not ascend"));
  return out;
}

// Puts the sparse values over what is there.
template <typename Number>
void fill_sparse(const GltfFile& gltf, const JsonCursor& accessor, const GltfNumbers& shape,
                 std::vector<Number>& out) {
  const JsonCursor sparse = accessor.at("sparse");
  const std::vector<std::uint32_t> indices = read_sparse_indices(gltf, sparse, shape.count);
  GltfNumbers few = shape;
  few.count = indices.size();
  const std::size_t n_bytes = shape.n_components * component_bytes(shape.component_type, accessor);
  const Elements e = locate(gltf, sparse.at("values"), few.count, n_bytes, false);
  std::vector<Number> values(few.count * few.n_components);
  read_components(e, few, accessor, values.data());
  for (std::size_t i = 0; i < indices.size(); ++i)
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * few.n_components),
                few.n_components,
                out.begin() + static_cast<std::ptrdiff_t>(indices[i] * few.n_components));
}

template <typename Number>
std::vector<Number> read_numbers(const GltfFile& gltf, std::int64_t id, const GltfNumbers& shape,
                                 std::size_t n_components) {
  const JsonCursor accessor = accessor_at(gltf, id);
  if (shape.n_components != n_components)
    accessor.fail("expected " + std::to_string(n_components) + " components");
  const Elements e = locate_dense(gltf, accessor, shape);
  std::vector<Number> out(shape.count * n_components);
  if (e.first != nullptr) read_components(e, shape, accessor, out.data());
  if (accessor.has("sparse")) fill_sparse(gltf, accessor, shape, out);
  return out;
}

}  // namespace

float GltfNumbers::scale() const {
  if (!normalized) return 1;
  switch (component_type) {
    case kByte:
      return 1.0f / 127;
    case kUnsignedByte:
      return 1.0f / 255;
    case kShort:
      return 1.0f / 32767;
    case kUnsignedShort:
      return 1.0f / 65535;
    case kUnsignedInt:
      return 1.0f / 4294967295.0f;
    default:
      return 1;
  }
}

GltfNumbers read_accessor_shape(const GltfFile& gltf, std::int64_t id) {
  const JsonCursor accessor = accessor_at(gltf, id);
  GltfNumbers shape;
  shape.count = static_cast<std::size_t>(accessor.at("count").integer(1, 0xffffffff));
  shape.n_components = count_components(accessor);
  shape.component_type = accessor.at("componentType").integer(0, 1 << 20);
  component_bytes(shape.component_type, accessor);  // that there is such a type
  shape.normalized = shape.component_type != kFloat && accessor.has("normalized") &&
                     accessor.at("normalized").boolean();
  return shape;
}

std::vector<float> read_float_accessor(const GltfFile& gltf, std::int64_t id,
                                       std::size_t n_components, GltfIntegers integers) {
  GltfNumbers shape = read_accessor_shape(gltf, id);
  shape.normalized |= integers == GltfIntegers::shares && shape.component_type != kFloat;
  return read_numbers<float>(gltf, id, shape, n_components);
}

std::vector<std::uint32_t> read_integer_accessor(const GltfFile& gltf, std::int64_t id,
                                                 std::size_t n_components) {
  return read_numbers<std::uint32_t>(gltf, id, read_accessor_shape(gltf, id), n_components);
}

}  // namespace viewcell
