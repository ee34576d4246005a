#include "core/base/json.h"

#include "core/base/error.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <functional>

namespace millwright {
namespace {

constexpr std::string_view part = R"({
    "name": "dome, \"big\"",
    "grid": {
        "nu": 20, "ratio": -1.5e-1,
        "sizes": [1, [2, 3], {"deep": true}]
    },
    "nothing": null
})";

JsonValue parsed(std::string_view text) {
    return JsonValue::parse(text, "part.json");
}

/// What an Error says, or "" if nothing is thrown.
std::string fault(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(JsonFile, AByteOrderMarkIsSkipped) {
    EXPECT_EQ(JsonValue::parse("\xEF\xBB\xBF{\"a\": \"b\"}", "a.json").at("a").text(), "b");
}

TEST(JsonValue, ReadsNestedFieldsOfEveryType) {
    const JsonValue value = parsed(part);
    EXPECT_EQ(value.at("name").text(), "dome, \"big\"");
    EXPECT_EQ(value.at("grid").at("nu").integer(2, 1000), 20);
    EXPECT_DOUBLE_EQ(value.at("grid").at("ratio").number(), -0.15);
    EXPECT_EQ(value.at("grid").at("sizes").items(3)[1].items(2)[1].integer(), 3);
    EXPECT_TRUE(value.at("grid").at("sizes").items()[2].at("deep").flag());
    EXPECT_TRUE(value.at("nothing").is_null());
    EXPECT_FALSE(value.find("missing").has_value());
}

TEST(JsonValue, AWrongTypeIsReportedWithLineColumnAndPath) {
    const JsonValue value = parsed(part);
    EXPECT_EQ(fault([&] { (void)value.at("name").number(); }),
              "part.json:2:13: name: expected a number, found a text");
    EXPECT_EQ(fault([&] { (void)value.at("grid").at("ratio").integer(); }),
              "part.json:4:28: grid/ratio: expected a whole number, found -0.15");
    EXPECT_EQ(fault([&] { (void)value.at("grid").at("sizes").items()[1].items(3); }),
              "part.json:5:22: grid/sizes[1]: expected a list of 3, found 2");
    EXPECT_EQ(fault([&] { (void)value.at("grid").at("nu").integer(2, 10); }),
              "part.json:4:15: grid/nu: 20 is not between 2 and 10");
}

TEST(JsonValue, MissingAndUnknownFieldsAreNamed) {
    const JsonValue value = parsed(part);
    EXPECT_EQ(fault([&] { (void)value.at("grid").at("nv"); }),
              "part.json:3:13: grid: the field \"nv\" is missing");
    const std::string unknown = fault([&] { value.expect_only({"name", "grid"}); });
    EXPECT_NE(unknown.find("part.json:7:16"), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("known: name, grid"), std::string::npos) << unknown;
}

TEST(JsonValue, BrokenTextIsReportedWithItsPlace) {
    const test::WithoutTraps numbers_that_are_none;
    EXPECT_NE(fault([] { (void)parsed("{\n  \"a\": 1,\n  oops\n}"); }).find("part.json:3:"),
              std::string::npos);
    EXPECT_NE(fault([] { (void)parsed("{\"a\": 1"); }).find("ends in the middle"), std::string::npos);
    EXPECT_NE(fault([] { (void)parsed(""); }).find("ends in the middle"), std::string::npos);
    EXPECT_NE(fault([] { (void)parsed("[1e999]"); }).find("too large"), std::string::npos);
    EXPECT_NE(fault([] { (void)parsed("[NaN]"); }).find("not valid JSON"), std::string::npos);
    EXPECT_NE(fault([] { (void)parsed("\xff\xff"); }).find("not valid JSON"), std::string::npos);
    EXPECT_NE(fault([] { (void)parsed("\xff\xfe"); }).find("UTF-16"), std::string::npos);
}

TEST(JsonValue, ARepeatedFieldIsRefused) {
    EXPECT_EQ(fault([] { (void)parsed("{\"a\": 1,\n\"a\": 2}"); }).substr(0, 15), "part.json:2:1 b");
}

TEST(JsonValue, DeepNestingIsRefusedNotFollowed) {
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_NE(fault([&] { (void)parsed(deep); }).find("deeper than 64"), std::string::npos);
}

} // namespace
} // namespace millwright
