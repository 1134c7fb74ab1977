// Source: Wavefront's Object Files (OBJ) and MTL material formats.
#include "formats/mtl.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "formats/text_cursor.h"

namespace viewcell {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trim(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  return text.substr(0, text.find_last_not_of(kBlank) + 1);
}

// Takes the first word off a trimmed text.
std::string_view take_word(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find_first_of(kBlank));
  text = trim(text.substr(word.size()));
  return word;
}

// Calls use(keyword, rest of the line, number of the line) on each line of a text.
template <typename Use>
void for_each_line(std::string_view text, const Use& use) {
  const char line_break = line_break_of(text);
  for (std::size_t at = 0, number = 1; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find(line_break, at), text.size());
    std::string_view line = trim(text.substr(at, end - at));
    at = end + 1;
    const std::string_view keyword = take_word(line);
    use(keyword, line, number);
  }
}

bool is_number(std::string_view word) {
  float ignored;
  return parse_finite(word, ignored);
}

// "-mm 0 1", "-s 2 2", "-clamp on": how many words an option has at least, and at most.
struct OptionWords {
  int least, most;
  bool moves;
};
const OptionWords* find_option(std::string_view word) {
  static const std::map<std::string_view, OptionWords> kOptions{
      {"-blendu", {1, 1, false}}, {"-blendv", {1, 1, false}},  {"-cc", {1, 1, false}},
      {"-clamp", {1, 1, false}},  {"-mm", {2, 2, false}},      {"-texres", {1, 1, false}},
      {"-boost", {1, 1, false}},  {"-imfchan", {1, 1, false}}, {"-bm", {1, 1, false}},
      {"-type", {1, 1, false}},   {"-o", {1, 3, true}},        {"-s", {1, 3, true}},
      {"-t", {1, 3, true}}};
  const auto found = kOptions.find(word);
  return found == kOptions.end() ? nullptr : &found->second;
}

// "-o 0 0 0" and "-s 1 1 1" move nothing.
bool is_neutral(std::string_view option, std::string_view word) {
  float x = 0;
  return parse_finite(word, x) && x == (option == "-s" ? 1 : 0);
}

MtlMap parse_map(std::string_view keyword, std::string_view rest, std::size_t line) {
  MtlMap out{std::string(keyword), "", "", line};
  for (std::string_view behind = rest; !rest.empty(); rest = behind) {
    const std::string_view option = take_word(behind);
    const OptionWords* words = find_option(option);
    if (words == nullptr) break;
    for (int i = 0; i < words->most && !behind.empty(); ++i) {
      std::string_view after = behind;
      const std::string_view word = take_word(after);
      if (i >= words->least && !is_number(word)) break;
      if (words->moves && !is_neutral(option, word)) out.moved_by = option;
      behind = after;
    }
  }
  out.file = rest;
  std::replace(out.file.begin(), out.file.end(), '\\', '/');
  return out;
}

bool is_map(std::string_view keyword) {
  return keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" ||
         keyword == "disp" || keyword == "decal" || keyword == "refl";
}

void parse_line(std::string_view keyword, std::string_view rest, std::size_t line,
                MtlMaterial& material) {
  if (keyword == "Kd") {
    glm::vec3 color(0);
    for (int k = 0; k < 3; ++k)
      if (!parse_finite(take_word(rest), color[k])) return;
    material.color = color;
  } else if (double x = 0; keyword == "d" || keyword == "Tr") {
    if (parse_finite(take_word(rest), x))
      material.opacity = std::clamp(keyword == "d" ? x : 1 - x, 0.0, 1.0);
  } else if (is_map(keyword) && !rest.empty()) {
    material.maps.push_back(parse_map(keyword, rest, line));
  }
}

}  // namespace

std::vector<std::string> split_words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string join_words(std::string_view text) {
  std::string out;
  for (const std::string& word : split_words(text)) out += (out.empty() ? "" : " ") + word;
  return out;
}

std::vector<MtlMaterial> parse_mtl(std::string_view text) {
  std::vector<MtlMaterial> out;
  for_each_line(text, [&](std::string_view keyword, std::string_view rest, std::size_t line) {
    if (keyword == "newmtl")
      out.emplace_back().name = join_words(rest);
    else if (!out.empty())
      parse_line(keyword, rest, line, out.back());
  });
  return out;
}

MtlNames find_mtl_names(std::string_view obj) {
  MtlNames out;
  const auto add = [](std::vector<std::string>& names, std::string name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for_each_line(obj, [&](std::string_view keyword, std::string_view rest, std::size_t) {
    if (keyword == "mtllib") add(out.libraries, std::string(rest));
    if (keyword == "usemtl") add(out.used, join_words(rest));
  });
  return out;
}

}  // namespace viewcell
