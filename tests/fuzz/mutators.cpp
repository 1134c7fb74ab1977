#include "mutators.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "base/json.h"
#include "fuzz.h"

namespace viewcell {
namespace {

// Copies it back, if there is room; 0: there is none.
std::size_t put(const std::string& bytes, std::uint8_t* data, std::size_t most) {
  if (bytes.size() > most) return 0;
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}

template <typename T>
T number_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

template <typename T>
void set_number(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// ---- numbers ----

template <typename T>
T special_number(FuzzRandom& random) {
  using Limits = std::numeric_limits<T>;
  const std::array<T, 8> all{T(0),
                             T(1),
                             Limits::max(),
                             Limits::lowest(),
                             Limits::min(),
                             T(pick(random, 64)),
                             Limits::infinity(),
                             Limits::quiet_NaN()};
  return all[pick(random, all.size())];
}

template <typename T>
void mutate_one(std::string& bytes, FuzzRandom& random) {
  const std::size_t n = bytes.size() / sizeof(T);
  if (n == 0) return;
  const std::size_t at = pick(random, n) * sizeof(T);
  switch (pick(random, 4)) {
    case 0:
      return set_number(bytes, at, special_number<T>(random));
    case 1:
      return set_number(bytes, at, number_at<T>(bytes, pick(random, n) * sizeof(T)));
    default:
      const T by = static_cast<T>(1 + pick(random, 3));
      const T old = number_at<T>(bytes, at);
      return set_number(bytes, at, static_cast<T>(random() % 2 != 0 ? old + by : old - by));
  }
}

// ---- sections ----

struct FuzzSection {
  std::string tag, bytes;
};
constexpr std::size_t kHeadBytes = 16, kEntryBytes = 32;

// Of a section file; empty: it is none.
std::vector<FuzzSection> take_sections(const std::string& file) {
  constexpr std::size_t kMost = 64;
  std::vector<FuzzSection> out;
  if (file.size() < kHeadBytes) return out;
  const auto n = std::min<std::size_t>(number_at<std::uint32_t>(file, 12), kMost);
  if (file.size() < kHeadBytes + n * kEntryBytes + 8) return out;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = kHeadBytes + i * kEntryBytes;
    const auto offset = number_at<std::uint64_t>(file, at + 8);
    const auto size = number_at<std::uint64_t>(file, at + 16);
    if (offset > file.size() || size > file.size() - offset) return {};
    out.push_back({file.substr(at, 8), file.substr(offset, size)});
  }
  return out;
}

// As SectionWriter writes them, with hashes of 0.
std::string make_file(const std::string& head, const std::vector<FuzzSection>& sections) {
  const auto aligned = [](std::size_t offset) { return (offset + 15) / 16 * 16; };
  std::string out = head.substr(0, 12);
  append(out, static_cast<std::uint32_t>(sections.size()));
  std::size_t offset = kHeadBytes + sections.size() * kEntryBytes + 8;
  for (const FuzzSection& section : sections) {
    offset = aligned(offset);
    out += section.tag;
    append(out, std::uint64_t{offset}), append(out, std::uint64_t{section.bytes.size()});
    append(out, std::uint64_t{0});
    offset += section.bytes.size();
  }
  append(out, std::uint64_t{0});
  for (const FuzzSection& section : sections) {
    out.resize(aligned(out.size()), '\0');
    out += section.bytes;
  }
  return out;
}

// ---- JSON ----

void list_values(Json& json, std::vector<Json*>& values) {
  values.push_back(&json);
  if (json.is_structured())
    for (auto& item : json) list_values(item, values);
}

void mutate_number(Json& value, FuzzRandom& random) {
  static constexpr double kTelling[] = {0,    1,     -1,    0.5,          2,     1e-9, 1e-320, 1e7,
                                        1e30, 1e300, -1e30, 4294967296.0, 0x1p53};
  switch (pick(random, 3)) {
    case 0:
      value = kTelling[pick(random, std::size(kTelling))];
      break;
    case 1:
      value = static_cast<std::int64_t>(pick(random, 300)) - 20;
      break;
    default:
      if (value.is_number_integer())
        value = value.get<std::int64_t>() / 2 + static_cast<std::int64_t>(pick(random, 5)) - 2;
      else
        value = value.get<double>() * (random() % 2 != 0 ? 1.5 : -0.75);
  }
}

void mutate_value(Json& value, const Json& other, FuzzRandom& random) {
  if (value.is_number() && pick(random, 4) != 0) return mutate_number(value, random);
  if (value.is_boolean()) {
    value = !value.get<bool>();
  } else if (value.is_string()) {
    std::string text = value.get<std::string>();
    if (random() % 2 != 0) mutate_bytes(text, 8);
    value = random() % 4 == 0 && other.is_string() ? other.get<std::string>() : text;
  } else if (value.is_array() && !value.empty() && pick(random, 3) != 0) {
    const std::size_t at = pick(random, value.size());
    if (random() % 2 != 0)
      value.erase(at);
    else
      value.push_back(Json(value[at]));
  } else if (value.is_object() && !value.empty() && pick(random, 3) != 0) {
    auto item = value.begin();
    std::advance(item, static_cast<std::ptrdiff_t>(pick(random, value.size())));
    value.erase(item);
  } else {
    value = Json(other);
  }
}

// Empty: it is no JSON.
std::string with_another_value(const std::string& text, FuzzRandom& random) {
  try {
    Json json = parse_json(text, "in");
    for (std::size_t n = 1 + pick(random, 3); n > 0; --n) {
      std::vector<Json*> values;
      list_values(json, values);
      const Json other = *values[pick(random, values.size())];
      mutate_value(*values[pick(random, values.size())], other, random);
    }
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace

void mutate_bytes(std::string& bytes, std::size_t room) {
  const std::size_t n = bytes.size();
  bytes.resize(n + room);
  if (bytes.empty()) return;
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), n, bytes.size()));
}

void mutate_numbers(std::string& bytes, FuzzRandom& random) {
  for (std::size_t n = 1 + pick(random, 2); n > 0; --n) switch (pick(random, 6)) {
      case 0:
        mutate_one<std::uint8_t>(bytes, random);
        break;
      case 1:
        mutate_one<std::uint16_t>(bytes, random);
        break;
      case 2:
        mutate_one<float>(bytes, random);
        break;
      case 3:
        mutate_one<double>(bytes, random);
        break;
      default:
        mutate_one<std::uint32_t>(bytes, random);
    }
}

std::size_t mutate_sections(std::uint8_t* data, std::size_t n_bytes, std::size_t most,
                            FuzzRandom& random) {
  const std::string file(view_of(data, n_bytes));
  std::vector<FuzzSection> sections = take_sections(file);
  if (sections.empty()) return 0;
  for (std::size_t n = 1 + pick(random, 2); n > 0; --n) {
    std::string& bytes = sections[pick(random, sections.size())].bytes;
    const bool is_json = bytes.starts_with("{");
    const std::string changed = is_json ? with_another_value(bytes, random) : "";
    if (!changed.empty())
      bytes = changed;
    else if (pick(random, 5) == 0)
      mutate_bytes(bytes, 32);
    else
      mutate_numbers(bytes, random);
  }
  return put(make_file(file, sections), data, most);
}

std::size_t mutate_json(std::uint8_t* data, std::size_t n_bytes, std::size_t most,
                        FuzzRandom& random) {
  return put(with_another_value(std::string(view_of(data, n_bytes)), random), data, most);
}

std::size_t mutate_glb(std::uint8_t* data, std::size_t n_bytes, std::size_t most,
                       FuzzRandom& random) {
  constexpr std::size_t kJsonAt = 20, kLengthAt = 12;
  const std::string file(view_of(data, n_bytes));
  if (!file.starts_with("glTF")) return mutate_json(data, n_bytes, most, random);
  if (file.size() < kJsonAt) return 0;
  const std::size_t n_json = number_at<std::uint32_t>(file, kLengthAt);
  if (n_json > file.size() - kJsonAt) return 0;
  std::string json = file.substr(kJsonAt, n_json), rest = file.substr(kJsonAt + n_json);
  if (rest.size() > 8 && pick(random, 3) == 0) {
    std::string numbers = rest.substr(8);
    mutate_numbers(numbers, random);
    rest.replace(8, std::string::npos, numbers);
  } else {
    json = with_another_value(json, random);
    if (json.empty()) return 0;
    json.resize((json.size() + 3) / 4 * 4, ' ');
  }
  std::string out = file.substr(0, kJsonAt) + json + rest;
  set_number(out, 8, static_cast<std::uint32_t>(out.size()));
  set_number(out, kLengthAt, static_cast<std::uint32_t>(json.size()));
  return put(out, data, most);
}

}  // namespace viewcell
