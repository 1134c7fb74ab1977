#include "image/exr_attributes.h"

#include <array>
#include <cstdint>

#include "image/picture_facts.h"

// Follows: "OpenEXR File Layout" (openexr.com), format version 2, and the attributes of
// OpenEXR 3.1.

namespace viewcell {
namespace {

struct FixedType {
  std::string_view name;
  std::size_t n_bytes;
};
constexpr std::array<FixedType, 24> kFixedTypes{
    {{"box2f", 16},      {"box2i", 16},    {"chromaticities", 32},
     {"compression", 1}, {"double", 8},    {"envmap", 1},
     {"float", 4},       {"int", 4},       {"m33d", 72},
     {"m33f", 36},       {"m44d", 128},    {"m44f", 64},
     {"v2d", 16},        {"v2f", 8},       {"v2i", 8},
     {"v3d", 24},        {"v3f", 12},      {"v3i", 12},
     {"keycode", 28},    {"lineOrder", 1}, {"rational", 8},
     {"tiledesc", 9},    {"timecode", 8},  {"deepImageState", 1}}};

bool is_channel_list(std::string_view value) {
  constexpr std::uint32_t kMostKind = 2;  // uint, half, float
  constexpr std::uint32_t kMostStep = 1 << 20;
  constexpr std::size_t kMostName = 254, kBytes = 16;  // behind the name
  const HeaderBytes bytes(value);
  std::size_t i = 0;
  while (i < value.size() && value[i] != '\0') {
    const std::size_t end = value.find('\0', i);
    if (end == std::string_view::npos || end - i > kMostName || value.size() - end <= kBytes)
      return false;
    const std::uint32_t kind = bytes.le32(end + 1);
    const std::uint32_t x_step = bytes.le32(end + 9), y_step = bytes.le32(end + 13);
    if (kind > kMostKind || x_step - 1 >= kMostStep || y_step - 1 >= kMostStep) return false;
    i = end + 1 + kBytes;
  }
  return i + 1 == value.size();
}

bool is_string_list(std::string_view value) {
  const HeaderBytes bytes(value);
  std::size_t i = 0;
  while (i < value.size()) {
    if (value.size() - i < 4 || bytes.le32(i) > value.size() - i - 4) return false;
    i += 4 + bytes.le32(i);
  }
  return true;
}

bool is_preview(std::string_view value) {
  const HeaderBytes bytes(value);
  const std::uint64_t width = bytes.le32(0), height = bytes.le32(4);
  return value.size() >= 8 && (height == 0 || width <= value.size() / height) &&
         value.size() == 8 + 4 * width * height;
}

}  // namespace

bool is_sound_exr_attribute(std::string_view type, std::string_view value) {
  if (type == "chlist") return is_channel_list(value);
  if (type == "stringvector") return is_string_list(value);
  if (type == "preview") return is_preview(value);
  if (type == "floatvector") return value.size() % 4 == 0;
  if (type == "idmanifest") return value.size() >= 4;
  for (const auto& [name, n_bytes] : kFixedTypes)
    if (type == name) return value.size() == n_bytes;
  return true;
}

}  // namespace viewcell
