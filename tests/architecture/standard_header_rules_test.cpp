#include "tests/architecture/standard_header_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(StandardHeaders, AreIncludedForWhatAHeaderUses) {
    EXPECT_THAT(
        check_standard_headers({{"core/grid/a.h", "#include <vector>\nstd::vector<std::string> a();\n"}}),
        ElementsAre(Finding{"core/grid/a.h", 2, "std::string needs <string>"}));
    EXPECT_THAT(
        check_standard_headers({{"core/grid/a.h", "#include <string>\nstd::string a(); // std::vector\n"}}),
        IsEmpty());
}

TEST(StandardHeaders, ThoseOfFmtAndEigenAreIncludedToo) {
    EXPECT_THAT(check_standard_headers({{"core/grid/a.h", "Eigen::Vector3d a(); // fmt::format\n"}}),
                ElementsAre(Finding{"core/grid/a.h", 1, "needs a header of <Eigen/...>"}));
    EXPECT_THAT(
        check_standard_headers({{"core/grid/a.h", "#include <fmt/format.h>\nfmt::memory_buffer a();\n"}}),
        IsEmpty());
}

TEST(StandardHeaders, MayComeThroughOurOwnHeaders) {
    const TextFile below{"core/base/b.h", "#include <string>\n"};
    EXPECT_THAT(
        check_standard_headers({{"core/grid/a.h", "#include \"core/base/b.h\"\nstd::string a();\n"}, below}),
        IsEmpty());
    EXPECT_THAT(
        check_standard_headers({{"core/grid/a.h", "#include \"core/base/c.h\"\nstd::string a();\n"}, below}),
        ElementsAre(Finding{"core/grid/a.h", 2, "std::string needs <string>"}));
}

TEST(StandardHeaders, OfThisRepositoryAreAllIncluded) {
    EXPECT_THAT(check_standard_headers(read_repository(".")), IsEmpty());
}

} // namespace
} // namespace millwright::architecture
