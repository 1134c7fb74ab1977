// contactsheet: pictures side by side on one.
#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "common/picture_input.h"
#include "image/io.h"
#include "report/contact_sheet.h"

namespace viewcell {
namespace {

struct Arguments {
  std::vector<std::string> pictures, notes, keys;
  std::string title;
  std::size_t n_columns = 4;
  bool trim = false;
  int n_bits = 8;
  std::optional<std::size_t> max_pixels;
  SheetOptions sheet;
};

void declare(Tool& tool, Arguments& arguments) {
  tool.add_option("PICTURE", &arguments.pictures,
                  "pictures of one size, row by row; an empty word leaves its place blank")
      .required()
      .reads("picture %, which is read");
  tool.add_option("--note", &arguments.notes,
                  "words under a picture; once for each, in the same order; may be fewer")
      .one_each();
  tool.add_option("--title", &arguments.title, "a line above all");
  tool.add_option("--key", &arguments.keys,
                  "RRGGBB=WORDS: what a colour means, below all; once for each colour")
      .one_each();
  tool.add_option("--columns", &arguments.n_columns, "pictures in a row")
      .show_default()
      .check(in_range(1, 64));
  tool.add_option("--tile", &arguments.sheet.tile_px, "width to shrink larger pictures to, px")
      .show_default()
      .check(in_range(16, 4096));
  tool.add_flag("--trim", &arguments.trim,
                "cut the borders in which no picture shows anything (alpha 0), the same of all");
  tool.add_option("--bits", &arguments.n_bits,
                  "of a colour channel to keep: 5 nearly halves the file")
      .show_default()
      .check(in_range(1, 8));
  declare_max_pixels(tool, &arguments.max_pixels);
  tool.add_output("PNG to write");
}

ImageRgba8 read_picture(const Tool& tool, const std::string& file,
                        const std::optional<std::size_t>& max_pixels) {
  if (file.empty()) return {};
  Remarks remarks;
  ImageRgba8 picture = read_image_rgba8(file, {{max_pixels}, &remarks});
  tool.remark(file, remarks);
  return picture;
}

std::vector<ImageRgba8> read_pictures(const Tool& tool, const Arguments& arguments) {
  const std::vector<std::string>& files = arguments.pictures;
  std::vector<ImageRgba8> pictures;
  const ImageRgba8* first = nullptr;
  pictures.reserve(files.size());
  for (const std::string& file : files) {
    pictures.push_back(read_picture(tool, file, arguments.max_pixels));
    const ImageRgba8& picture = pictures.back();
    if (picture.empty()) continue;
    if (first == nullptr) first = &picture;
    if (picture.width_px != first->width_px || picture.height_px != first->height_px)
      throw InputError(file, "",
                       "is not of the size of the first picture, " +
                           std::to_string(first->width_px) + " x " +
                           std::to_string(first->height_px) + " pixels");
  }
  if (first == nullptr) throw UsageError("every place is blank");
  return pictures;
}

SheetKey parse_key(const std::string& text) {
  unsigned r = 0, g = 0, b = 0;
  int n = 0;
  const bool is_color = text.find_first_not_of("0123456789abcdefABCDEF") == 6 && text[6] == '=' &&
                        std::sscanf(text.c_str(), "%2x%2x%2x%n", &r, &g, &b, &n) == 3 && n == 6;
  if (!is_color || text.size() == 7)
    throw UsageError("--key: '" + text + "' is not RRGGBB=WORDS, with hexadecimal digits");
  const auto byte = [](unsigned x) { return static_cast<std::uint8_t>(x); };
  return {{byte(r), byte(g), byte(b), 255}, text.substr(7)};
}

// What the command line alone shows to be wrong.
void check_arguments(const Tool& tool, Arguments& arguments) {
  for (const std::string& key : arguments.keys) arguments.sheet.key.push_back(parse_key(key));
  if (arguments.notes.size() > arguments.pictures.size())
    throw UsageError("more --note than pictures");
  if (tool.common().output == "-") throw UsageError("-o names a file");
  check_ending({"-o", tool.common().output}, {".png"}, "a PNG");
}

int run(const Tool& tool, Arguments& arguments) {
  std::vector<ImageRgba8> pictures = read_pictures(tool, arguments);
  if (arguments.trim) trim_alike(pictures);
  const std::size_t n_columns = std::min(arguments.n_columns, pictures.size());
  std::vector<std::string> columns(n_columns);
  columns[0] = arguments.title;
  std::vector<SheetRow> rows;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (i % n_columns == 0) rows.emplace_back();
    lay_on_paper(pictures[i]);
    rows.back().pictures.push_back(std::move(pictures[i]));
    rows.back().notes.push_back(i < arguments.notes.size() ? arguments.notes[i] : "");
  }
  Remarks remarks;
  arguments.sheet.remarks = &remarks;
  ImageRgba8 sheet = make_contact_sheet(columns, rows, arguments.sheet);
  tool.remark(tool.common().output, remarks);
  round_channels(sheet, arguments.n_bits);
  write_png(tool.common().output, sheet, PngAlpha::drop);
  tool.report({{"pictures", arguments.pictures.size()},
               {"rows", rows.size()},
               {"width_px", sheet.width_px},
               {"height_px", sheet.height_px}});
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("contactsheet",
                      "Lays pictures of one size side by side, with words under each.",
                      "contactsheet a/view-00.png b/view-00.png --note original "
                      "--note '500 faces' --trim -o sheet.png\n"
                      "  contactsheet far.png --key 00ff00=near --key 0000ff=far -o sheet.png");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::check_arguments(tool, arguments); },
      [&] { return viewcell::run(tool, arguments); });
}
