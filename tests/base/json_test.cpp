#include "base/json.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {

const std::filesystem::path kFile = "file.json";

Json parse(const std::string& text) {
  return parse_json(text, kFile);
}

// At the column that opens the 65th level, however much follows.
TEST(ParseJson, RefusesDeepNestingAtOnce) {
  const std::pair<std::string, std::size_t> cases[] = {
      {"[", 64}, {"{\"a\":", 5 * 64}, {"[[{\"b\":[", 8 * 16}, {"[\"]\",", 5 * 64}};
  for (const auto& [piece, byte] : cases) {
    std::string deep;
    for (int i = 0; i < 200000; ++i) deep += piece;
    EXPECT_INPUT_ERROR(parse(deep), "file.json: line 1, column " + std::to_string(byte + 1) +
                                        ": JSON nested deeper than 64");
  }
}

TEST(ParseJson, DepthLimitIsExact) {
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_NO_THROW(parse(nested(64)));
  EXPECT_INPUT_ERROR(parse(nested(65)), "file.json: line 1, column 65: JSON nested deeper than 64");
}

TEST(ParseJson, BracketsInStringsAreNoDepth) {
  const std::string text = "\"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"";
  EXPECT_EQ(parse(text).get<std::string>().size(), 2001u);
}

TEST(ParseJson, NamesTheLineAndTheColumn) {
  EXPECT_INPUT_ERROR(parse("{\"a\": 1,}"), "file.json: line 1, column 9: not valid JSON");
  EXPECT_INPUT_ERROR(parse(""), "line 1, column 1: not valid JSON");
  EXPECT_INPUT_ERROR(parse("{\n  \"a\": 1,\n  \"b\": ?\n}"), "line 3, column 8: not valid JSON");
  EXPECT_INPUT_ERROR(parse("[1,\r\n\r\n 2"), "line 3, column 3: not valid JSON");
  EXPECT_INPUT_ERROR(parse("\n\n" + std::string(70, '[')), "line 3, column 65: JSON nested");
  EXPECT_INPUT_ERROR(parse("[1, 2"), "not valid JSON");
  EXPECT_INPUT_ERROR(parse("{\"a\": 1} x"), "not valid JSON");
  EXPECT_INPUT_ERROR(parse("[1, \"\xff\"]"), "not valid JSON");
  for (const char* word : {"NaN", "Infinity", "-inf", "nan", "[1e]", "01", "0x10", "'a'"})
    EXPECT_INPUT_ERROR(parse(word), "not valid JSON");
}

TEST(ParseJson, RefusesAKeyThatStandsTwiceInAnObject) {
  EXPECT_INPUT_ERROR(parse_json(R"({"a": 1, "b": {"c": 1, "d": [{"c": 2}], "c": 3}})", "f"),
                     "key 'c' stands twice in an object");
  EXPECT_EQ(parse_json(R"({"a": {"a": [{"a": 1}, {"a": 2}]}, "b": {"a": 3}})", "f")["b"]["a"], 3);
}

TEST(ParseJson, RefusesNumbersThatOverflow) {
  EXPECT_INPUT_ERROR(parse("[1e999]"), "file.json");
  EXPECT_INPUT_ERROR(parse("[-1e309]"), "file.json");
}

TEST(JsonCursor, RefusesNumbersOutOfRange) {
  const Json json = parse("{\"a\": [1, 2.5, -3, 1e30, 18446744073709551615, 1e300]}");
  const JsonCursor a = JsonCursor(json, kFile).at("a");
  EXPECT_EQ(a.at(0).number(1, 1), 1);
  EXPECT_INPUT_ERROR(a.at(0).number(2, 3), "file.json: a[0]: 1 is not within 2.0 to 3.0");
  EXPECT_INPUT_ERROR(a.at(2).number(0), "a[2]: -3 is not within");
  EXPECT_INPUT_ERROR(a.at(5).number(), "a[5]: 1e+300 is not within");
  EXPECT_INPUT_ERROR(a.at(1).integer(0, 9), "a[1]: 2.5 is not a whole number");
  EXPECT_INPUT_ERROR(a.at(4).integer(0, 1 << 30), "a[4]: 18446744073709551615 is not within");
}

// Ids pass through integer(): no value may be rounded, wrapped or be undefined to convert.
TEST(JsonCursor, IntegersAreExactAtTheLimits) {
  constexpr std::int64_t lo = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t hi = std::numeric_limits<std::int64_t>::max();
  const Json json = parse(
      "[9223372036854775807, -9223372036854775808, 9223372036854775808, 9007199254740993, 1e19, "
      "3.0]");
  const JsonCursor at(json, kFile);
  EXPECT_EQ(at.at(0).integer(lo, hi), hi);
  EXPECT_EQ(at.at(1).integer(lo, hi), lo);
  EXPECT_INPUT_ERROR(at.at(2).integer(lo, hi), "[2]: 9223372036854775808 is not within");
  EXPECT_EQ(at.at(3).integer(lo, hi), 9007199254740993);  // 2^53 + 1: no double
  EXPECT_INPUT_ERROR(at.at(3).integer(0, 9007199254740992), "is not within");
  EXPECT_INPUT_ERROR(at.at(4).integer(lo, hi), "[4]");
  EXPECT_EQ(at.at(5).integer(0, 9), 3);
}

TEST(JsonCursor, NamesThePlace) {
  const Json json = parse("{\"objects\": [{\"mesh\": 1, \"p\": [1, 2, \"x\"]}], \"b\": true}");
  const JsonCursor root(json, kFile);
  const JsonCursor object = root.at("objects").at(std::size_t{0});
  EXPECT_EQ(object.at("p").place(), "objects[0].p");
  EXPECT_INPUT_ERROR(object.at("scale"), "file.json: objects[0]: has no \"scale\"");
  EXPECT_INPUT_ERROR(object.at("p").numbers(3), "objects[0].p[2]: is not a number");
  EXPECT_INPUT_ERROR(object.at("p").numbers(2), "objects[0].p: has 3 numbers, not 2");
  EXPECT_INPUT_ERROR(object.at("mesh").string(), "is not a string");
  EXPECT_INPUT_ERROR(object.at("mesh").boolean(), "is not true or false");
  EXPECT_INPUT_ERROR(object.at("mesh").size(), "is not an array");
  EXPECT_INPUT_ERROR(object.at("mesh").at("x"), "is not an object");
  EXPECT_INPUT_ERROR(root.at("objects").at(1), "objects: has no element 1");
  EXPECT_INPUT_ERROR(root.at("objects").size(0), "has more than 0 elements");
  EXPECT_INPUT_ERROR(root.at("b").number(), "b: is not a number");
  EXPECT_TRUE(root.at("b").boolean());
  EXPECT_FALSE(object.has("x"));
  EXPECT_FALSE(root.at("b").has("x"));
}

TEST(JsonCursor, SaysWhichKeyMayBeTheOneThatIsMissing) {
  const Json json = parse(R"({"trianlges": 1, "Scale": 2, "x": 3})");
  const JsonCursor root(json, kFile);
  EXPECT_INPUT_ERROR(root.at("triangles"), "has no \"triangles\"; is 'trianlges' it?");
  EXPECT_INPUT_ERROR(root.at("scale"), "has no \"scale\"; is 'Scale' it?");
  EXPECT_INPUT_ERROR(root.at("up"), "has no \"up\"");
}

TEST(UnknownKeys, AreSaidOnceWithWhatWasMeant) {
  constexpr const char* kKnown[] = {"name", "substitutes", "up", "hash"};
  Remarks remarks;
  for (const char* text :
       {R"({"name": 1, "substitues": 2})", R"({"substitues": 2, "Hash": 3, "author": 4})",
        R"({"name": 1})", "[1]"}) {
    const Json json = parse(text);
    remark_unknown_keys(JsonCursor(json, kFile), "a mesh", kKnown, &remarks);
    remark_unknown_keys(JsonCursor(json, kFile), "a mesh", kKnown, nullptr);
  }
  ASSERT_EQ(remarks.size(), 3u);
  EXPECT_EQ(remarks[0].what,
            "key 'substitues' of a mesh is unknown and passed over; is 'substitutes' meant?");
  EXPECT_EQ(remarks[0].count, 2u);
  EXPECT_EQ(remarks[1].what, "key 'Hash' of a mesh is unknown and passed over; is 'hash' meant?");
  EXPECT_EQ(remarks[2].what, "key 'author' of a mesh is unknown and passed over");
  const Json json = parse(R"({"up_axis": 1})");
  remark_unknown_keys(JsonCursor(json, kFile), "a mesh", kKnown, &remarks);
  EXPECT_EQ(remarks[3].what, "key 'up_axis' of a mesh is unknown and passed over; is 'up' meant?");
}

TEST(ReadJson, HoldsFormatAndVersion) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_json(folder.add("a.json", text), "viewcell-x", 2);
  };
  EXPECT_NO_THROW(read(R"({"format": "viewcell-x", "version": 2})"));
  EXPECT_INPUT_ERROR(read(R"({"format": "viewcell-y", "version": 2})"),
                     "a.json: \"format\" is not \"viewcell-x\"");
  EXPECT_INPUT_ERROR(read(R"({"version": 2})"), "\"format\" is not");
  EXPECT_INPUT_ERROR(read(R"({"format": 7, "version": 2})"), "\"format\" is not");
  EXPECT_INPUT_ERROR(read(R"({"format": "viewcell-x", "version": 3})"),
                     "version: version 3, this tool reads version 2");
  EXPECT_INPUT_ERROR(read_json(folder.path() / "a.json", "viewcell-x", 2, "bake again"),
                     "this tool reads version 2: bake again");
  std::string hash;
  read_json(folder.add("c.json", R"({"format": "viewcell-x", "version": 2})"), "viewcell-x", 2, "",
            &hash);
  EXPECT_EQ(hash, hash_file(folder.path() / "c.json"));
  EXPECT_INPUT_ERROR(read(R"({"format": "viewcell-x", "version": "2"})"), "is not a number");
  EXPECT_INPUT_ERROR(read(R"({"format": "viewcell-x"})"), "has no \"version\"");
  EXPECT_INPUT_ERROR(read("[]"), "is not a JSON object");
  EXPECT_INPUT_ERROR(read_json(folder.path() / "b.json", "viewcell-x", 2), "b.json: cannot open");
}

TEST(FormatJson, ReadsBackAndKeepsTheOrderOfKeys) {
  const Json json = {{"z", 1},          {"a", {1.5, -2.25, 1e-300}}, {"list", {{{"k", "v\n\"]"}}}},
                     {"none", nullptr}, {"empty", Json::array()},    {"o", Json::object()}};
  const std::string text = format_json(json);
  EXPECT_EQ(parse(text), json);
  EXPECT_EQ(text.substr(0, 38), "{\n  \"z\": 1,\n  \"a\": [1.5,-2.25,1e-300],");
  EXPECT_EQ(text.back(), '\n');
}

TEST(FormatJson, DoublesComeBackBitForBit) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-1, 1) * std::pow(10.0, random.uniform(-25, 25));
    EXPECT_EQ(JsonCursor(parse(format_json(Json(x))), kFile).number(), x) << "seed 3, case " << i;
  }
}

TEST(ParseJson, DamagedTextIsRefusedOrReadNeverWorse) {
  const std::string text = R"({"format": "x", "list": [1, 2.5, {"a": "b"}], "t": true})";
  read_damaged_copies(text, 3000, 1, [](const std::string& damaged) { parse(damaged); });
}

}  // namespace
}  // namespace viewcell
