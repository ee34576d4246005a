#include "core/base/error.h"

#include <gtest/gtest.h>

namespace millwright {
namespace {

TEST(Diagnostic, NamesFileLineColumnMessageAndHint) {
    const Diagnostic found{{"part.json", 3, 14, -1}, "'nu' is a string", "give a whole number"};
    EXPECT_EQ(to_text(found), "part.json:3:14: 'nu' is a string (give a whole number)");
}

TEST(Diagnostic, LeavesOutWhatIsNotKnown) {
    EXPECT_EQ(to_text({{}, "no display", {}}), "no display");
    EXPECT_EQ(to_text({{"a.plt", 0, 0, 17}, "unknown command", {}}), "a.plt byte 17: unknown command");
}

TEST(Error, CarriesItsDiagnosticAndReadsLikeIt) {
    const Error error("cannot read", "missing.json");
    EXPECT_EQ(error.diagnostic().place.file, "missing.json");
    EXPECT_STREQ(error.what(), "missing.json: cannot read");
}

TEST(Expects, ThrowsADefectThatNamesTheCaller) {
    EXPECT_NO_THROW(expects(true, "fine"));
    try {
        expects(false, "a grid is never empty");
        FAIL() << "no Defect";
    } catch (const Defect& defect) {
        const std::string text = defect.what();
        EXPECT_NE(text.find("error_test.cpp"), std::string::npos);
        EXPECT_NE(text.find("a grid is never empty"), std::string::npos);
    }
}

} // namespace
} // namespace millwright
