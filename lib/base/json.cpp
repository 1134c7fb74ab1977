#include "base/json.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/file.h"

namespace viewcell {
namespace {

constexpr int kMaxDepth = 64;

// The byte at which nesting passes kMaxDepth, or npos. nlohmann's values are destroyed one level a
// stack frame, so a deep file would crash after it was parsed: look before parsing.
std::size_t too_deep_at(const std::string& text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth) return i;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return std::string::npos;
}

// Follows the parser, and refuses a key that stands twice in an object: of such the last would
// count without a word.
struct KeysOnce {
  const std::filesystem::path& file;
  std::vector<std::set<std::string>> open = {};  // keys so far, of the objects that it is in

  bool operator()(int, Json::parse_event_t event, const Json& key) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(key.get<std::string>()).second)
      throw InputError(file.string(), "",
                       "key '" + key.get<std::string>() + "' stands twice in an object");
    return true;
  }
};

bool is_flat_array(const Json& json) {
  return json.is_array() &&
         std::none_of(json.begin(), json.end(), [](const Json& v) { return v.is_structured(); });
}

void append_json(const Json& json, int indent, std::string& out) {
  if (!json.is_structured() || json.empty() || is_flat_array(json)) {
    out += json.dump();
    return;
  }
  const bool object = json.is_object();
  const std::string margin(static_cast<std::size_t>(indent + 2), ' ');
  out += object ? "{" : "[";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    out += first ? "\n" : ",\n";
    first = false;
    out += margin;
    if (object) out += Json(key).dump() + ": ";
    append_json(value, indent + 2, out);
  }
  out += "\n" + std::string(static_cast<std::size_t>(indent), ' ') + (object ? "}" : "]");
}

std::string format_number(double x) {
  return Json(x).dump();
}

// "line 3, column 7" of the byte at that place; past the end, of the end.
std::string place_of(const std::string& text, std::size_t at) {
  const std::string_view before = std::string_view(text).substr(0, at);
  const std::size_t line_start = before.rfind('\n') + 1;  // 0 where there is none
  return "line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
         ", column " + std::to_string(before.size() - line_start + 1);
}

// Letters to insert, leave out, change or swap with their neighbour (Damerau and Levenshtein).
std::size_t count_typos(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t k = 0; k <= b.size(); ++k) {
      if (i == 0 || k == 0) {
        d[i][k] = i + k;
        continue;
      }
      const bool differ = std::tolower(static_cast<unsigned char>(a[i - 1])) !=
                          std::tolower(static_cast<unsigned char>(b[k - 1]));
      d[i][k] = std::min({d[i - 1][k] + 1, d[i][k - 1] + 1, d[i - 1][k - 1] + differ});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
        d[i][k] = std::min(d[i][k], d[i - 2][k - 2] + 1);
    }
  return d[a.size()][b.size()];
}

bool begins_as(const std::string& one, const std::string& other) {
  constexpr std::size_t kLeast = 2;
  return std::min(one.size(), other.size()) >= kLeast &&
         (one.starts_with(other) || other.starts_with(one));
}

// The known key that is nearest, by its letters or its beginning, or "" when none is near.
std::string guess_key(const std::string& key, std::span<const char* const> known) {
  constexpr std::size_t kLongestKey = 64;  // longer ones are no typing errors
  if (key.size() > kLongestKey) return "";
  std::string guess;
  std::size_t fewest = 1 + std::max<std::size_t>(1, key.size() / 3);
  for (const char* one : known)
    if (const std::size_t n = count_typos(key, one); n < fewest) fewest = n, guess = one;
  for (const char* one : known)
    if (guess.empty() && begins_as(key, one)) guess = one;
  return guess;
}

}  // namespace

Json parse_json(const std::string& text, const std::filesystem::path& file) {
  if (const std::size_t at = too_deep_at(text); at != std::string::npos)
    throw InputError(file.string(), place_of(text, at),
                     "JSON nested deeper than " + std::to_string(kMaxDepth));
  try {
    return Json::parse(text, KeysOnce{file});
  } catch (const Json::parse_error& error) {
    throw InputError(file.string(), place_of(text, std::max<std::size_t>(error.byte, 1) - 1),
                     "not valid JSON");
  } catch (const Json::exception&) {
    throw InputError(file.string(), "", "not valid JSON (a number out of range?)");
  }
}

Json read_json(const std::filesystem::path& file, const std::string& format, JsonVersions versions,
               const std::string& remedy, std::string* hash) {
  const std::string text = read_file(file, 1u << 30);
  if (hash != nullptr) *hash = hash_hex(text);
  Json json = parse_json(text, file);
  const JsonCursor root(json, file);
  if (!json.is_object()) root.fail("is not a JSON object");
  if (!root.has("format") || root.at("format").value() != format)
    root.fail("\"format\" is not \"" + format + "\"");
  const auto found = root.at("version").integer(0, 1 << 30);
  if (found < versions.first || found > versions.last)
    root.at("version").fail(
        "version " + std::to_string(found) + ", this tool reads version " +
        std::to_string(versions.first) +
        (versions.last > versions.first ? " to " + std::to_string(versions.last) : "") +
        (remedy.empty() ? "" : ": " + remedy));
  return json;
}

std::string format_json(const Json& json) {
  std::string out;
  append_json(json, 0, out);
  out += "\n";
  return out;
}

bool JsonCursor::has(const std::string& key) const {
  return value_->is_object() && value_->contains(key);
}

JsonCursor JsonCursor::at(const std::string& key) const {
  if (!value_->is_object()) fail("is not an object");
  const auto found = value_->find(key);
  if (found == value_->end()) {
    std::vector<const char*> keys;
    for (const auto& item : value_->items()) keys.push_back(item.key().c_str());
    const std::string guess = guess_key(key, keys);
    fail("has no \"" + key + "\"" + (guess.empty() ? "" : "; is '" + guess + "' it?"));
  }
  return {*found, *file_, place_.empty() ? key : place_ + "." + key};
}

JsonCursor JsonCursor::at(std::size_t i) const {
  if (!value_->is_array()) fail("is not an array");
  if (i >= value_->size()) fail("has no element " + std::to_string(i));
  return {(*value_)[i], *file_, place_ + "[" + std::to_string(i) + "]"};
}

std::size_t JsonCursor::size(std::size_t most) const {
  if (!value_->is_array()) fail("is not an array");
  if (value_->size() > most) fail("has more than " + std::to_string(most) + " elements");
  return value_->size();
}

double JsonCursor::number(double lo, double hi) const {
  if (!value_->is_number()) fail("is not a number");
  const double x = value_->get<double>();
  if (!std::isfinite(x) || x < lo || x > hi)
    fail(value_->dump() + " is not within " + format_number(lo) + " to " + format_number(hi));
  return x;
}

std::int64_t JsonCursor::integer(std::int64_t lo, std::int64_t hi) const {
  if (!value_->is_number()) fail("is not a number");
  const auto refuse = [&] {
    fail(value_->dump() + " is not within " + std::to_string(lo) + " to " + std::to_string(hi));
  };
  if (!value_->is_number_integer()) {  // 3.0 is a whole number too
    const double x = value_->get<double>();
    if (x != std::floor(x)) fail(value_->dump() + " is not a whole number");
    constexpr double kExact = 0x1p53;  // beyond, a double may stand for several integers
    if (!(std::abs(x) <= kExact) || x < static_cast<double>(lo) || x > static_cast<double>(hi))
      refuse();
    return static_cast<std::int64_t>(x);
  }
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (value_->is_number_unsigned() && value_->get<std::uint64_t>() > kMost) refuse();
  const auto i = value_->get<std::int64_t>();
  if (i < lo || i > hi) refuse();
  return i;
}

bool JsonCursor::boolean() const {
  if (!value_->is_boolean()) fail("is not true or false");
  return value_->get<bool>();
}

std::string JsonCursor::string() const {
  if (!value_->is_string()) fail("is not a string");
  return value_->get<std::string>();
}

std::vector<double> JsonCursor::numbers(std::size_t n, double lo, double hi) const {
  if (size() != n) fail("has " + std::to_string(size()) + " numbers, not " + std::to_string(n));
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = at(i).number(lo, hi);
  return out;
}

void remark_unknown_keys(const JsonCursor& object, const std::string& what,
                         std::span<const char* const> known, Remarks* remarks) {
  if (remarks == nullptr || !object.value().is_object()) return;
  for (const auto& [key, value] : object.value().items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string guess = guess_key(key, known);
    add_remark(remarks, "key '" + key + "' of " + what + " is unknown and passed over" +
                            (guess.empty() ? "" : "; is '" + guess + "' meant?"));
  }
}

void JsonCursor::fail(const std::string& what) const {
  throw InputError(file_->string(), place_, what);
}

}  // namespace viewcell
