#include "core/plot/material_table.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace millwright::plot {
namespace {

using testing::HasSubstr;

std::vector<Material> shipped() {
    const char* file = "assets/materials/materials.json";
    return read_materials(read_file(file), file);
}

const Material& material(const std::vector<Material>& all, const std::string& name) {
    return *std::ranges::find(all, name, &Material::name);
}

// 0.003 in x 2 edges x 10,000 per minute = 60 in/min = 25.4 mm/s.
TEST(MaterialTable, FeedsAreChipLoadsTimesEdgesTimesTurns) {
    const auto all = shipped();
    const CuttingValues values = material(all, "Hardwood").values(3.175);
    EXPECT_NEAR(values.feed.value, 25.4, 1e-9);
    EXPECT_NEAR(values.plunge.value, 25.4 / 3.0, 1e-9);
    EXPECT_NEAR(values.depth_per_pass.value, 1.5875, 1e-9);
    EXPECT_DOUBLE_EQ(values.spindle_rpm.value, 10'000.0);
    // Half way between the chart's 1/8 and 1/4 inch; a thinner tool in proportion; a thicker one as 1/2 inch.
    EXPECT_NEAR(material(all, "Hardwood").values(4.7625).feed.value, 50.8, 1e-9);
    EXPECT_NEAR(material(all, "Hardwood").values(1.5875).feed.value, 12.7, 1e-9);
    EXPECT_NEAR(material(all, "Hardwood").values(20.0).feed.value, 25.4 * 19.0 / 3.0, 1e-9);
}

TEST(MaterialTable, NamesTheSourceOfEachValue) {
    std::set<std::string> kinds;
    for (const Material& each : shipped()) {
        const CuttingValues values = each.values(3.0);
        for (const Sourced& value : {values.feed, values.plunge, values.depth_per_pass, values.spindle_rpm}) {
            EXPECT_GT(value.value, 0.0) << each.name();
            EXPECT_GT(value.source.size(), 8U) << each.name();
        }
        kinds.insert(each.kind());
    }
    EXPECT_THAT(kinds, testing::ElementsAre("metal", "plastic", "rubber", "wood"));
}

// 0.005 in x 2 edges x 10,000 per minute = 100 in/min.
TEST(MaterialTable, AluminiumIsCutInThinnerPasses) {
    const CuttingValues values = material(shipped(), "Aluminium").values(6.35);
    EXPECT_NEAR(values.feed.value, 100.0 * 25.4 / 60.0, 1e-9);
    EXPECT_NEAR(values.depth_per_pass.value, 0.635, 1e-9);
    EXPECT_THAT(values.depth_per_pass.source, HasSubstr("a tenth"));
}

TEST(MaterialTable, HasTheFeedThatExplainsTheTimesOfTheThesis) {
    const CuttingValues values = material(shipped(), "Clear plastic, thesis of 2006").values(3.0);
    EXPECT_NEAR(values.feed.value, 2.0, 1e-12);
    EXPECT_NEAR(values.plunge.value, 0.5, 1e-12);
}

TEST(MaterialTable, SaysWhereATableIsWrong) {
    for (const char* text : {"", "{}", R"({"format": "something"})", "[1, 2"}) {
        try {
            (void)read_materials(text, "mine.json");
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_THAT(to_text(error.diagnostic()), HasSubstr("mine.json"));
        }
    }
    EXPECT_THROW((void)shipped().front().values(0.0), Error);
}

} // namespace
} // namespace millwright::plot
