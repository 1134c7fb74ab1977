// Source: EXT_meshopt_compression (Khronos). KHR_meshopt_compression differs in version 1 of
// streams and in one filter, which meshoptimizer of Debian 12 does not know: refused by name.
#include "formats/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace viewcell {
namespace {

// Of the mode that they are named after: what the least bytes can hold. Zeros of 64 vertices take a
// byte for each byte of a vertex, a triangle one, an index one.
std::size_t most_unpacked(const MeshoptView& view, std::size_t n_packed) {
  if (view.mode == "ATTRIBUTES") return 64 * n_packed;
  return (view.mode == "TRIANGLES" ? 3 : 1) * view.stride * n_packed;
}

void check_shape(const MeshoptView& view, const JsonCursor& extension) {
  const bool is_attributes = view.mode == "ATTRIBUTES";
  if (!is_attributes && view.mode != "TRIANGLES" && view.mode != "INDICES")
    extension.at("mode").fail("'" + view.mode + "' is not ATTRIBUTES, TRIANGLES or INDICES");
  if (is_attributes ? view.stride % 4 != 0 : view.stride != 2 && view.stride != 4)
    extension.at("byteStride").fail("does not fit the mode " + view.mode);
  if (view.mode == "TRIANGLES" && view.count % 3 != 0)
    extension.at("count").fail("of triangles' indices is no multiple of 3");
  if (view.filter == "NONE") return;
  const bool fits = view.filter == "OCTAHEDRAL"    ? view.stride == 4 || view.stride == 8
                    : view.filter == "QUATERNION"  ? view.stride == 8
                    : view.filter == "EXPONENTIAL" ? true
                                                   : false;
  if (!fits || !is_attributes)
    extension.at("filter").fail("the filter " + view.filter + " is not read for " + view.mode +
                                " of stride " + std::to_string(view.stride));
}

bool decode_stream(const MeshoptView& view, std::string_view packed, std::string& out) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  if (view.mode == "ATTRIBUTES")
    return meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, bytes, packed.size()) ==
           0;
  if (view.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, bytes, packed.size()) ==
           0;
  return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, bytes, packed.size()) ==
         0;
}

// The first byte of a stream: what it is and its version, in four bits each.
bool is_of_later_version(const MeshoptView& view, std::string_view packed) {
  const int newest = view.mode == "ATTRIBUTES" ? 0 : 1;
  return !packed.empty() && (packed[0] & 0x0f) > newest;
}

void filter_elements(const MeshoptView& view, std::string& out) {
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
}

}  // namespace

MeshoptView read_meshopt_view(const JsonCursor& extension, std::size_t n_packed,
                              std::size_t most_bytes) {
  MeshoptView view;
  view.count = static_cast<std::size_t>(extension.at("count").integer(1, 0xffffffff));
  view.stride = static_cast<std::size_t>(extension.at("byteStride").integer(1, 256));
  view.mode = extension.at("mode").string();
  view.filter = extension.has("filter") ? extension.at("filter").string() : "NONE";
  check_shape(view, extension);
  if (view.count * view.stride > std::min(most_bytes, most_unpacked(view, n_packed)))
    extension.at("count").fail(std::to_string(view.count) + " elements do not fit into " +
                               std::to_string(n_packed) + " bytes");
  return view;
}

std::string decode_meshopt(const MeshoptView& view, std::string_view packed,
                           const JsonCursor& extension) {
  std::string out(view.count * view.stride, '\0');
  if (!decode_stream(view, packed, out))
    extension.fail(is_of_later_version(view, packed)
                       ? "is of a later version than is read (0 of vertices, 1 of indices)"
                       : "is damaged: it does not hold what it says");
  filter_elements(view, out);
  return out;
}

}  // namespace viewcell
