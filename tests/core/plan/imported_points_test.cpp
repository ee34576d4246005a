#include "core/base/files.h"
#include "core/geometry/bspline_surface.h"
#include "core/plan/plan.h"
#include "core/project/imported_surface.h"
#include "tests/support/reason.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace millwright::project {
namespace {

using ::testing::HasSubstr;

class ImportedPoints : public ::testing::Test {
protected:
    [[nodiscard]] ImportedSurface imported(const std::string& text, const ImportChoice& choice = {}) const {
        write_file(folder_ / "probe.csv", text);
        return import_surface(folder_ / "probe.csv", choice, {});
    }
    [[nodiscard]] std::string why_not(const std::string& text, const ImportChoice& choice = {}) const {
        return test::reason([&] { (void)imported(text, choice); });
    }

    test::ScratchFolder folder_;
};

/// A saddle over 60 x 60 mm; a line each point, no blank lines.
std::string saddle(int rows, int columns) {
    std::string text = "x,y,z\n";
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const double x = -30.0 + 60.0 * i / (rows - 1), y = -30.0 + 60.0 * j / (columns - 1);
            text += std::to_string(x) + "," + std::to_string(y) + "," +
                    std::to_string(0.01 * x * y + 2.0 * std::cos(0.1 * x)) + "\n";
        }
    }
    return text;
}

TEST_F(ImportedPoints, FewRowsAreOnePatchThroughThem) {
    const ImportedSurface made = imported(saddle(4, 6));
    ASSERT_EQ(made.surface.patches.size(), 1U);
    EXPECT_EQ(made.surface.patches[0].rows, 4);
    EXPECT_EQ(made.surface.patches[0].columns, 6);
    ASSERT_TRUE(made.points);
    EXPECT_EQ(made.points->rows, 4);
    EXPECT_EQ(made.points->columns, 6);
    EXPECT_LT(made.points->deviation.max, 1e-9);
    EXPECT_TRUE(made.notes.empty());
    ImportChoice inches;
    inches.mm_per_unit = 25.4;
    EXPECT_NEAR(imported(saddle(4, 6), inches).surface.patches[0].point(0, 0).x(), -762.0, 1e-6);
    ImportChoice higher;
    higher.degrees = FitDegrees{5, 7};
    const ImportedSurface elevated = imported(saddle(4, 6), higher);
    EXPECT_EQ(elevated.surface.patches[0].rows, 6);
    EXPECT_EQ(elevated.surface.patches[0].columns, 8);
    EXPECT_LT(elevated.points->deviation.max, 1e-9) << "of a higher degree it is the same surface";
}

// Only the first of 6 x 9 patches was machined.
TEST_F(ImportedPoints, ManyRowsAreOneSurfaceThroughThemOrOnePatchNearThem) {
    const ImportedSurface made = imported(saddle(9, 12));
    EXPECT_TRUE(made.surface.patches.empty());
    EXPECT_THAT(made.notes, ::testing::IsEmpty());
    EXPECT_LT(made.points->deviation.max, 1e-9);
    ASSERT_TRUE(made.surface.face);
    EXPECT_TRUE(made.surface.face->trim.everything());
    const geometry::BsplineSurface surface(made.surface.face->net);
    EXPECT_EQ(surface.spans(), std::pair(6, 9));
    const std::vector<Vec3>& points = made.points->points;
    EXPECT_LT((surface.position(0.0, 0.0) - points.front()).norm(), 1e-9);
    EXPECT_LT((surface.position(1.0, 0.0) - points[8 * 12]).norm(), 1e-9);
    EXPECT_LT((surface.position(1.0, 1.0) - points.back()).norm(), 1e-9);
    Project part;
    part.surface = made.surface;
    EXPECT_THAT(faults_of(part), ::testing::IsEmpty());
    ImportChoice one;
    one.degrees = FitDegrees{7, 3};
    const ImportedSurface near = imported(saddle(9, 12), one);
    ASSERT_EQ(near.surface.patches.size(), 1U);
    ASSERT_TRUE(near.fit);
    EXPECT_EQ(near.points->deviation.at_points.size(), 9U * 12U);
    EXPECT_GT(near.points->deviation.max, 1e-9);
    EXPECT_LT(near.points->deviation.max, 0.05);
    EXPECT_GE(near.points->worst_line(), 2);
    EXPECT_LE(near.points->worst_line(), 1 + 9 * 12);
}

TEST_F(ImportedPoints, ACloudIsFittedByOneFairPatch) {
    ImportChoice cloud;
    cloud.cloud = true;
    const ImportedSurface made = imported(saddle(9, 12) + "1,1,99\n1.0,1.00,99\n", cloud);
    ASSERT_EQ(made.surface.patches.size(), 1U);
    EXPECT_EQ(made.points->rows, 0);
    EXPECT_EQ(made.points->points.size(), 9U * 12U + 1U);
    EXPECT_THAT(made.notes,
                ::testing::ElementsAre(HasSubstr("1 duplicate point skipped, the first in line 111")));
    EXPECT_EQ(made.points->worst_line(), 110) << "the point that is nowhere near";
}

/// A hill of 4 x 4 points on 60 x 60 mm, joined by faces of four corners; the first `count` of them.
std::string hill_as_obj(int count = 9) {
    std::string text;
    for (const double x : {-30.0, -10.0, 10.0, 30.0}) {
        for (const double y : {-30.0, -10.0, 10.0, 30.0}) {
            const double z = (std::abs(x) < 20.0 ? 7.0 : 0.0) + (std::abs(y) < 20.0 ? 7.0 : 0.0);
            text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
        }
    }
    for (int n = 0; n < count; ++n) {
        const int first = 4 * (n / 3) + n % 3 + 1;
        text += "f";
        for (const int corner : {first, first + 4, first + 5, first + 1}) {
            text += " " + std::to_string(corner);
        }
        text += "\n";
    }
    return text;
}

// A patch of degree 5 near its facets was up to 0.41 mm away, with control points 24 mm beside the part.
TEST_F(ImportedPoints, OfAMeshThatIsARasterAreOnThePatch) {
    const auto file = folder_ / "hill.obj";
    write_file(file, hill_as_obj());
    const ImportedSurface made = import_surface(file, {}, {});
    ASSERT_TRUE(made.points);
    EXPECT_FALSE(made.fit);
    EXPECT_EQ(made.points->rows, 4);
    EXPECT_EQ(made.points->columns, 4);
    EXPECT_LT(made.points->deviation.max, 1e-9);
    ASSERT_EQ(made.surface.patches.size(), 1U);
    for (const Vec3& point : made.surface.patches[0].points) {
        EXPECT_LE(std::max(std::abs(point.x()), std::abs(point.y())), 30.0 + 1e-9) << point.transpose();
    }
    EXPECT_THAT(made.notes, ::testing::ElementsAre(HasSubstr("the mesh joins 4 rows of 4 points")));
    ImportChoice fitted;
    fitted.degrees = FitDegrees{3, 3};
    EXPECT_TRUE(import_surface(file, fitted, {}).fit) << "to the facets, if a degree is given";
    write_file(file, hill_as_obj(8));
    EXPECT_TRUE(import_surface(file, {}, {}).fit) << "a cell is missing: no raster";
}

TEST_F(ImportedPoints, SayWhatIsWrongWithFileAndLine) {
    EXPECT_THAT(
        why_not("0 0 0\n0 1 0\n\n1 0 0\n"),
        AllOf(HasSubstr("probe.csv:4: row 2 has 1 point, but the first row has 2"), HasSubstr("as a cloud")));
    EXPECT_THAT(why_not("0 0 0\n1 1 1\n2 2 2\n3 3 3\n"), HasSubstr("probe.csv: the points lie on a line"));
    EXPECT_THAT(why_not("0 0 0\n1 1 1\n"), HasSubstr("probe.csv: 2 distinct points are too few"));
    EXPECT_THAT(why_not("0 0 0\n0 1e9 0\n\n1 0 0\n1 1 0\n"), HasSubstr("farther than 100000 mm"));
    EXPECT_THAT(why_not("0 0 0\n0 1e-9 0\n\n1e-9 0 0\n1e-9 1e-9 0\n"), HasSubstr("check the unit"));
}

TEST(PointNames, OpenAsSurfacesOnlyWhereNothingElseHasThem) {
    for (const char* name : {"a.csv", "a.pts", "a.TXT"}) {
        EXPECT_TRUE(is_importable(name));
        EXPECT_FALSE(opens_as_surface(name));
    }
    for (const char* name : {"a.xyz", "a.ASC", "a.step", "a.stl"}) {
        EXPECT_TRUE(is_importable(name));
        EXPECT_TRUE(opens_as_surface(name));
    }
    EXPECT_FALSE(is_importable("a.ngc"));
}

} // namespace
} // namespace millwright::project
