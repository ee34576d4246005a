#include "core/base/file_format.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace millwright {
namespace {

std::string refusal(const char* text) {
    try {
        expect_format(JsonValue::parse(text, "a.json"), "millwright-project", "a project file");
        return {};
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
}

TEST(FileFormat, SaysWhatAFileIsThatWasGivenInPlaceOfAnother) {
    EXPECT_EQ(refusal(R"({"format": "millwright-project"})"), "");
    EXPECT_EQ(refusal(R"({"format": "millwright-machine", "source": "mine"})"),
              "a.json:1:12: format: not a project file (it is a machine file: name it as the machine of a "
              "project, or use it as --machine where a command has this option)");
    EXPECT_EQ(refusal(R"({"format": "something"})"),
              "a.json:1:12: format: not a project file (expected \"millwright-project\")");
    EXPECT_NE(refusal("{}"), "");
}

} // namespace
} // namespace millwright
