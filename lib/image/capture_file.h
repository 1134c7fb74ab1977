// Capture files: what one centre sees, one part an object (docs/formats.md, captures).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace viewcell {

/// A part without its pixels.
struct CapturePartHeader {
  std::string name;  ///< one of its own in the file, not empty and not "empty"
  /// The display window: the whole source image, from (0, 0), the same for all parts of a file.
  int source_width_px = 0, source_height_px = 0;
  /// The data window: the crop, in pixels of the source image; may overflow it on any side.
  int x = 0, y = 0, width_px = 0, height_px = 0;
  /// Column vectors, as everywhere here: camera = world_to_camera * world. In the file, EXR's
  /// worldToCamera and worldToNDC, rounded to float: row i of the attribute is column i of the
  /// matrix (EXR multiplies row vectors from the left), so the 16 numbers keep their order.
  glm::dmat4 world_to_camera{1}, world_to_ndc{1};
  /// The caller's own text, e.g. numbers that float is too coarse for (attribute viewcellPart).
  std::string note;
};

struct CapturePart {
  CapturePartHeader header;
  /// Four halves a pixel, row by row: linear R, G, B, and A = the mask, 0 or 1 (image/half.h).
  std::vector<std::uint16_t> rgba_half;
  /// One float a pixel: distance along the view axis; filled in outside the mask too.
  std::vector<float> z;
};

/// Of the whole file: name to text. Names are letters and digits, beginning with a small letter.
using CaptureAttributes = std::map<std::string, std::string>;

/// Writes the parts, whole or not at all. No parts is a file too: one pixel, named "empty". The
/// same input gives the same bytes: no date. Every number must be finite. Throws MachineError.
/// One core takes about 0.16 s a megapixel. Safe from many threads at once.
void write_capture_file(const std::filesystem::path& file, const std::vector<CapturePart>& parts,
                        const CaptureAttributes& attributes);

/// A capture file, open. Opening reads headers and checks that the file is whole; pixels are read
/// part by part. Not to be used from two threads at once.
class CaptureFile {
 public:
  /// Throws InputError (file, part) when it is missing, cut, or not a capture file.
  explicit CaptureFile(const std::filesystem::path& file);
  ~CaptureFile();
  CaptureFile(CaptureFile&&) noexcept;
  CaptureFile& operator=(CaptureFile&&) noexcept;

  const std::vector<CapturePartHeader>& parts() const { return parts_; }
  const CaptureAttributes& attributes() const { return attributes_; }
  /// The pixels of parts()[i]. Throws InputError when they cannot be decoded or are not finite.
  CapturePart read_part(std::size_t i);

 private:
  struct Input;
  std::string name_;
  std::unique_ptr<Input> input_;
  std::vector<CapturePartHeader> parts_;
  CaptureAttributes attributes_;
};

}  // namespace viewcell
