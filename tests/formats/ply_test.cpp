#include "formats/ply.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"

namespace viewcell {
namespace {

const std::string kSquare =  // 0-1-2 and 0-2-3
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar views\nelement face 2\n"
    "property list uchar uint vertex_indices\nproperty int object\nend_header\n"
    "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 0 127\n3 0 1 2 -5\n3 0 2 3 6\n";

PlyDocument parse_document(const std::string& bytes) {
  return parse_ply(bytes, "m.ply");
}

// A list column from lists.
template <typename T>
PlyColumn list_column(const std::string& name, PlyType count_type,
                      const std::vector<std::vector<T>>& lists) {
  PlyColumn column;
  column.name = name;
  column.is_list = true;
  column.count_type = count_type;
  std::vector<T> values;
  column.starts.push_back(0);
  for (const auto& list : lists) {
    values.insert(values.end(), list.begin(), list.end());
    column.starts.push_back(values.size());
  }
  column.values = values;
  return column;
}

// What format_ply writes, with every value's bytes turned over.
std::string big_endian(const PlyDocument& document) {
  std::string out = format_ply(document);
  out.resize(out.find("end_header\n") + 11);
  out = replaced(out, "little", "big");
  const auto append = [&out](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (std::size_t k = sizeof value; k-- > 0;) out += bytes[k];
  };
  for (const PlyElement& element : document.elements)
    for (std::size_t row = 0; row < element.count; ++row)
      for (const PlyColumn& column : element.columns) {
        const std::size_t first = column.is_list ? column.starts[row] : row;
        const std::size_t last = column.is_list ? column.starts[row + 1] : row + 1;
        if (column.is_list && column.count_type == PlyType::kUint8)
          append(static_cast<std::uint8_t>(last - first));
        else if (column.is_list)
          append(static_cast<std::int32_t>(last - first));
        for (std::size_t i = first; i < last; ++i)
          std::visit([&](const auto& values) { append(values[i]); }, column.values);
      }
  return out;
}

template <typename T>
std::vector<T> random_values(std::size_t n, Random& random) {
  std::vector<T> out(n);
  for (T& value : out) {
    if constexpr (std::is_floating_point_v<T>)
      value = static_cast<T>(random.uniform(-1e6, 1e6));
    else
      value = static_cast<T>(random.next());
  }
  return out;
}

PlyDocument random_document(Random& random) {
  PlyDocument document;
  document.comments = {"seeded"};
  PlyElement all{"all", random.below(20), {}};
  add_column(all, "i8", random_values<std::int8_t>(all.count, random));
  add_column(all, "u8", random_values<std::uint8_t>(all.count, random));
  add_column(all, "i16", random_values<std::int16_t>(all.count, random));
  add_column(all, "u16", random_values<std::uint16_t>(all.count, random));
  add_column(all, "i32", random_values<std::int32_t>(all.count, random));
  add_column(all, "u32", random_values<std::uint32_t>(all.count, random));
  add_column(all, "f", random_values<float>(all.count, random));
  add_column(all, "d", random_values<double>(all.count, random));
  PlyElement lists{"lists", random.below(20), {}};
  std::vector<std::vector<std::int16_t>> shorts(lists.count);
  std::vector<std::vector<double>> doubles(lists.count);
  for (auto& list : shorts) list = random_values<std::int16_t>(random.below(6), random);
  for (auto& list : doubles) list = random_values<double>(random.below(3), random);
  lists.columns.push_back(list_column("s", PlyType::kUint8, shorts));
  add_column(lists, "between", random_values<std::uint16_t>(lists.count, random));
  lists.columns.push_back(list_column("d", PlyType::kInt32, doubles));
  document.elements = {all, lists};
  return document;
}

void expect_equal(const PlyDocument& a, const PlyDocument& b) {
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t e = 0; e < a.elements.size(); ++e) {
    EXPECT_EQ(a.elements[e].count, b.elements[e].count);
    ASSERT_EQ(a.elements[e].columns.size(), b.elements[e].columns.size());
    for (std::size_t c = 0; c < a.elements[e].columns.size(); ++c) {
      const PlyColumn &left = a.elements[e].columns[c], &right = b.elements[e].columns[c];
      EXPECT_EQ(left.name, right.name);
      EXPECT_EQ(left.is_list, right.is_list);
      EXPECT_EQ(left.starts, right.starts);
      EXPECT_EQ(left.values, right.values) << left.name;
    }
  }
}

TEST(Ply, ReadsTextByHand) {
  const PlyDocument ply = parse_document(kSquare);
  EXPECT_EQ(ply.comments, std::vector<std::string>{"made by hand"});
  EXPECT_EQ(ply.vec3s("vertex", "x", "y", "z")[2], glm::vec3(1, 1, 0));
  EXPECT_EQ(ply.uints("vertex", "views", 127), (std::vector<std::uint32_t>{1, 2, 3, 127}));
  EXPECT_EQ(ply.triangles("face", "vertex_indices", 4),
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(ply.floats("face", "object"), (std::vector<float>{-5, 6}));
  EXPECT_EQ(ply.column("vertex", "views").type(), PlyType::kUint8);
  EXPECT_EQ(ply.find("edge"), nullptr);
  EXPECT_TRUE(ply.has("face", "object"));
  EXPECT_FALSE(ply.has("edge", "object"));
}

TEST(Ply, LineBreaksAndOtherTypeNames) {
  std::string text = replaced(kSquare, "property float x", "property float32 x");
  text = replaced(text, "list uchar uint", "list uint8 uint32");
  text = replaced(text, "comment made by hand", "obj_info a b c\ncomment\ncomment  two  blanks");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const PlyDocument ply = parse_document(windows);
  expect_equal(ply, parse_document(kSquare));
  EXPECT_EQ(ply.comments, (std::vector<std::string>{"", " two  blanks"}));
}

TEST(Ply, WritesThenReadsTheSameBits) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const PlyDocument document = random_document(random);
    const std::string bytes = format_ply(document);
    expect_equal(parse_document(bytes), document);
    expect_equal(parse_document(big_endian(document)), document);
    EXPECT_EQ(format_ply(parse_document(bytes)), bytes);
  }
}

TEST(Ply, CommentsStayOnTheirLine) {
  PlyDocument document;
  document.comments = {"one\nend_header\r\n"};
  EXPECT_EQ(parse_document(format_ply(document)).comments,
            std::vector<std::string>{"one end_header"});
}

TEST(Ply, BuildersCheckLengths) {
  PlyElement element{"vertex", 3, {}};
  EXPECT_THROW(add_column(element, "x", std::vector<float>(2)), BugError);
  EXPECT_THROW(add_triangles(element, "t", {{0, 1, 2}}), BugError);
  PlyDocument document;
  element.count = 1;
  element.columns.push_back(
      list_column<std::uint8_t>("long", PlyType::kUint8, {std::vector<std::uint8_t>(256)}));
  document.elements = {element};
  EXPECT_THROW(format_ply(document), BugError);
}

TEST(Ply, GettersNameWhatIsWrong) {
  const PlyDocument ply = parse_document(kSquare);
  EXPECT_INPUT_ERROR(ply.element("edge"), "m.ply: header: has no element 'edge'");
  EXPECT_INPUT_ERROR(ply.column("face", "views"), "element 'face' has no property 'views'");
  EXPECT_INPUT_ERROR(ply.floats("face", "vertex_indices"), "is a list");
  EXPECT_INPUT_ERROR(ply.list_indices("face", "object", 4), "is not a list");
  EXPECT_INPUT_ERROR(ply.uints("vertex", "views", 126), "vertex 3: property 'views': 127");
  EXPECT_INPUT_ERROR(ply.uints("face", "object"), "face 0: property 'object': -5");
  EXPECT_INPUT_ERROR(ply.triangles("face", "vertex_indices", 3), "face 1");
  const PlyDocument quad = parse_document(replaced(kSquare, "3 0 2 3 6", "4 0 1 2 3 6"));
  EXPECT_INPUT_ERROR(quad.triangles("face", "vertex_indices", 4), "face 1: is not a triangle");
}

TEST(Ply, NonFiniteNumbersAreNamed) {
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    PlyDocument document;
    PlyElement element{"vertex", 3, {}};
    add_column(element, "x", std::vector<float>{0, bad, 0});
    add_column(element, "y", std::vector<double>{0, 0, 1e300});
    document.elements = {element};
    const PlyDocument ply = parse_document(format_ply(document));
    EXPECT_INPUT_ERROR(ply.floats("vertex", "x"), "vertex 1: property 'x' is not a finite number");
    EXPECT_INPUT_ERROR(ply.floats("vertex", "y"), "vertex 2");
  }
  EXPECT_INPUT_ERROR(
      parse_document(replaced(kSquare, "\n1 0 0 2", "\n1 nan 0 2")).floats("vertex", "y"),
      "vertex 1: property 'y' is not a finite number");
}

TEST(Ply, MalformedHeadersAreRefused) {
  const auto bad = [](const std::string& from, const std::string& to, const std::string& part) {
    SCOPED_TRACE(to);
    EXPECT_INPUT_ERROR(parse_document(replaced(kSquare, from, to)), part);
  };
  EXPECT_INPUT_ERROR(parse_document(""), "end_header");
  EXPECT_INPUT_ERROR(parse_document("OFF\n"), "is not a PLY file");
  bad("end_header\n", "", "line 12");
  bad("ascii", "binary_middle_endian", "line 2: expected 'format");
  bad("vertex 4", "vertex -4", "line 4: the count of element 'vertex'");
  bad("vertex 4", "vertex 4.5", "not a whole number");
  bad("vertex 4", "vertex 99999999999999999999", "not a whole number");
  bad("vertex 4", "vertex 1000000000000000000", "more than the rest of the file can hold");
  bad("face 2", "face 1000000000000000000", "more than the rest of the file can hold");
  bad("face 2", "vertex 2", "stands twice");
  bad("float y", "float x", "'x' stands twice");
  bad("float y", "real y", "unknown type 'real'");
  bad("list uchar", "list float", "integer type");
  bad("list uchar uint vertex", "matrix uchar uint vertex", "expected 'property list");
  bad("element vertex 4\n", "", "before the first element");
  bad("property uchar views", "what is this", "expected comment");
  bad("element vertex", "element void 1000000000000000000\nelement vertex", "is empty");
  EXPECT_INPUT_ERROR(parse_document("ply\nformat ascii 1.0\n" + std::string(1 << 21, 'x')),
                     "too long");
  std::string many = "ply\nformat ascii 1.0\n";
  for (int i = 0; i < 100000; ++i) many += "comment\n";
  EXPECT_INPUT_ERROR(parse_document(many), "too many lines");
}

TEST(Ply, MalformedRowsAreRefused) {
  const auto bad = [](const std::string& from, const std::string& to, const std::string& part) {
    SCOPED_TRACE(to);
    EXPECT_INPUT_ERROR(parse_document(replaced(kSquare, from, to)), part);
  };
  bad("0 1 0 127", "0 1 0 256", "vertex 3: '256' is not within 0 to 255");
  bad("0 1 0 127", "0 1 0 1.5", "not a whole number");
  bad("0 1 0 127", "0 1 x 127", "vertex 3: 'x' is not a finite number");
  bad("3 0 2 3 6", "-1 0 2 3 6", "face 1");
  bad("3 0 2 3 6", "4 0 2 3 6", "ends too early");
  bad("3 0 2 3 6", "3 0 2 3 6 7", "goes on after its last row");
}

TEST(Ply, BinaryRowsAreBounded) {
  PlyDocument document;
  PlyElement element{"face", 2, {}};
  element.columns.push_back(
      list_column<std::uint32_t>("v", PlyType::kInt32, {{0, 1, 2}, {3, 4, 5}}));
  document.elements = {element};
  const std::string bytes = format_ply(document);
  const std::size_t body = bytes.find("end_header\n") + 11;
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(parse_document(bytes.substr(0, n)), InputError) << n;
  for (const std::int32_t length : {-1, 4, 1 << 30, std::numeric_limits<std::int32_t>::min()}) {
    std::string damaged = bytes;
    std::memcpy(damaged.data() + body + 16, &length, 4);
    EXPECT_INPUT_ERROR(parse_document(damaged), "face 1");
  }
  EXPECT_INPUT_ERROR(parse_document(bytes + "x"), "goes on");
  EXPECT_NO_THROW(parse_document(bytes + "\n"));
}

TEST(Ply, DamagedFilesNeverCrash) {
  constexpr std::uint64_t kSeed = 7;
  Random random(3);
  const PlyDocument document = random_document(random);
  for (const std::string& bytes : {kSquare, format_ply(document), big_endian(document)})
    read_damaged_copies(bytes, 3000, kSeed, [](const std::string& damaged) {
      const PlyDocument ply = parse_document(damaged);
      if (ply.has("face", "vertex_indices")) ply.triangles("face", "vertex_indices", 4);
    });
}

}  // namespace
}  // namespace viewcell
