#include "image/checker.h"

#include "base/error.h"

namespace viewcell {
namespace {

constexpr Rgba8 kDark = {60, 60, 64, 255}, kLight = {225, 225, 220, 255};
constexpr Rgba8 kRight = {205, 60, 45, 255}, kUp = {50, 150, 70, 255};

// column from the left, row from below.
Rgba8 color_of(int column, int row, int n_squares) {
  if ((column + row) % 2 == 0) return kDark;
  const int middle = n_squares / 2;
  if (column >= middle && (row == middle || row == middle - 1)) return kRight;
  if (row > middle && (column == middle || column == middle - 1)) return kUp;
  return kLight;
}

}  // namespace

ImageRgba8 make_checker(int size_px, int n_squares) {
  VIEWCELL_CHECK(n_squares >= 2 && n_squares <= size_px, n_squares, size_px);
  ImageRgba8 image(size_px, size_px);
  const auto square = [&](int pixel) {
    return static_cast<int>(static_cast<long long>(pixel) * n_squares / size_px);
  };
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x)
      image.at(x, y) = color_of(square(x), square(size_px - 1 - y), n_squares);
  return image;
}

}  // namespace viewcell
