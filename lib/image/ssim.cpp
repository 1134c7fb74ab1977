#include "image/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/error.h"

// Follows: [Wang04 III.B], Wang, Bovik, Sheikh, Simoncelli, "Image quality assessment: from error
// visibility to structural similarity", 2004. The window is separable, so each row is filtered
// once and the last 11 filtered rows are summed.

namespace viewcell {
namespace {

constexpr int kWindow_px = 11;
constexpr double kSigma_px = 1.5;
constexpr std::size_t kMoments = 5;  // a, b, a a, b b, a b

using Row = std::vector<double>;
using MomentRows = std::array<Row, kMoments>;

// Sums to 1; shorter where the picture is.
std::vector<double> make_window(int side_px) {
  const int n = std::min(kWindow_px, side_px);
  std::vector<double> window(static_cast<std::size_t>(n));
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double x = (i - 0.5 * (n - 1)) / kSigma_px;
    sum += window[static_cast<std::size_t>(i)] = std::exp(-0.5 * x * x);
  }
  for (double& w : window) w /= sum;
  return window;
}

// The moments of one row, each filtered along it.
void filter_row(const double* a, const double* b, const std::vector<double>& window,
                MomentRows& products, MomentRows& out) {
  const std::size_t width = products[0].size(), n_out = out[0].size();
  for (std::size_t x = 0; x < width; ++x) {
    products[0][x] = a[x];
    products[1][x] = b[x];
    products[2][x] = a[x] * a[x];
    products[3][x] = b[x] * b[x];
    products[4][x] = a[x] * b[x];
  }
  for (std::size_t m = 0; m < kMoments; ++m) {
    std::fill(out[m].begin(), out[m].end(), 0.0);
    for (std::size_t k = 0; k < window.size(); ++k) {
      const double weight = window[k];
      const double* from = products[m].data() + k;
      double* to = out[m].data();
      for (std::size_t x = 0; x < n_out; ++x) to[x] += weight * from[x];
    }
  }
}

double ssim_at(const MomentRows& moments, std::size_t x, double peak) {
  const double c1 = (0.01 * peak) * (0.01 * peak), c2 = (0.03 * peak) * (0.03 * peak);
  const double mean_a = moments[0][x], mean_b = moments[1][x];
  const double var_a = moments[2][x] - mean_a * mean_a, var_b = moments[3][x] - mean_b * mean_b;
  const double covariance = moments[4][x] - mean_a * mean_b;
  return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

}  // namespace

Image<double> luminance(const ImageRgba8& image) {
  Image<double> out(image.width_px, image.height_px);
  for (std::size_t p = 0; p < out.pixels.size(); ++p) {
    const Rgba8& c = image.pixels[p];
    out.pixels[p] = (299 * c[0] + 587 * c[1] + 114 * c[2]) / 1000.0;
  }
  return out;
}

double mean_ssim(const Image<double>& a, const Image<double>& b, double peak) {
  VIEWCELL_CHECK(a.width_px == b.width_px && a.height_px == b.height_px && !a.empty());
  const std::vector<double> across = make_window(a.width_px), down = make_window(a.height_px);
  const auto width = static_cast<std::size_t>(a.width_px);
  const auto height = static_cast<std::size_t>(a.height_px);
  const std::size_t n_out = width - across.size() + 1;
  MomentRows products, column_sums;
  std::vector<MomentRows> last_rows(down.size());  // row y lies at y modulo their number
  for (std::size_t m = 0; m < kMoments; ++m) {
    products[m].resize(width);
    column_sums[m].resize(n_out);
    for (MomentRows& rows : last_rows) rows[m].resize(n_out);
  }
  double sum = 0;
  for (std::size_t y = 0; y < height; ++y) {
    filter_row(&a.pixels[y * width], &b.pixels[y * width], across, products,
               last_rows[y % down.size()]);
    if (y + 1 < down.size()) continue;
    for (std::size_t m = 0; m < kMoments; ++m) {
      std::fill(column_sums[m].begin(), column_sums[m].end(), 0.0);
      for (std::size_t k = 0; k < down.size(); ++k) {
        const double* from = last_rows[(y + 1 + k) % down.size()][m].data();
        for (std::size_t x = 0; x < n_out; ++x) column_sums[m][x] += down[k] * from[x];
      }
    }
    for (std::size_t x = 0; x < n_out; ++x) sum += ssim_at(column_sums, x, peak);
  }
  return sum / static_cast<double>(n_out * (height - down.size() + 1));
}

}  // namespace viewcell
