// JSON files read with bounds, and fields read with errors that name file and place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "base/remarks.h"

namespace viewcell {

/// Keys keep the order in which they were set, so that files repeat byte for byte.
using Json = nlohmann::ordered_json;

/// Parses text that came from `file`. Nesting deeper than 64 is refused before parsing. Throws
/// InputError with the line and the column (in bytes, from 1) at fault.
Json parse_json(const std::string& text, const std::filesystem::path& file);

/// Versions of a format that are read: one, or first to last.
struct JsonVersions {
  constexpr JsonVersions(int only) : first(only), last(only) {}
  constexpr JsonVersions(int first_in, int last_in) : first(first_in), last(last_in) {}
  int first, last;
};

/// Reads and parses a file of ours: "format" and "version" must be the ones given. remedy: what to
/// do about a file of another version. hash: hash_hex of the bytes that were parsed, if wanted.
Json read_json(const std::filesystem::path& file, const std::string& format, JsonVersions versions,
               const std::string& remedy = "", std::string* hash = nullptr);

/// Two-space indentation, arrays of numbers on one line, a newline at the end.
std::string format_json(const Json& json);

/// A value inside a JSON file, which knows its file and, for errors, its place there
/// ("objects[3].mesh"). Every getter throws InputError when the value is missing or of another type
/// or range.
class JsonCursor {
 public:
  JsonCursor(const Json& value, const std::filesystem::path& file, std::string place = "")
      : value_(&value), file_(&file), place_(std::move(place)) {}

  bool has(const std::string& key) const;
  JsonCursor at(const std::string& key) const;
  JsonCursor at(std::size_t i) const;
  /// The number of elements; the value must be an array of at most `most`.
  std::size_t size(std::size_t most = 1u << 24) const;

  /// A finite number within [lo, hi].
  double number(double lo = -1e30, double hi = 1e30) const;
  /// A whole number within [lo, hi].
  std::int64_t integer(std::int64_t lo, std::int64_t hi) const;
  bool boolean() const;
  std::string string() const;
  /// An array of exactly n finite numbers.
  std::vector<double> numbers(std::size_t n, double lo = -1e30, double hi = 1e30) const;

  const std::filesystem::path& file() const { return *file_; }
  const std::string& place() const { return place_; }
  const Json& value() const { return *value_; }
  /// Throws InputError at this place.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  const Json* value_;
  const std::filesystem::path* file_;
  std::string place_;
};

/// Remarks on the keys of an object that are none of the known ones, with the known one that may
/// have been meant. what: the object, with its article ("a mesh"). Not an object: nothing.
void remark_unknown_keys(const JsonCursor& object, const std::string& what,
                         std::span<const char* const> known, Remarks* remarks);

}  // namespace viewcell
