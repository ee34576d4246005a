// Patches fitted to curved faces, with the distances measured here, by brute force over fine rasters.
#include "core/base/error.h"
#include "core/exchange/patch_fit.h"
#include "core/geometry/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace millwright::exchange {
namespace {

using geometry::BezierPatch;
using geometry::ControlNet;

const Vec3 quarter_x(1.0, 1.0, 0.0);
const Vec3 quarter_y(0.0, 1.0, 1.0);
const Vec3 quarter_weight(1.0, std::numbers::sqrt2 / 2.0, 1.0);

/// A quarter of a turn about z of a quarter of a circle of radius `small` around (large, 0, 0).
CadFace torus_quarter(double large, double small) {
    ControlNet net = ControlNet::sized(3, 3);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double out = large + small * quarter_x[j];
            net.point(i, j) = {quarter_x[i] * out, quarter_y[i] * out, small * quarter_y[j]};
            net.weight(i, j) = quarter_weight[i] * quarter_weight[j];
        }
    }
    CadFace face;
    face.patches = {BezierPatch(net)};
    return face;
}

/// Half a cylinder about x, of two patches.
CadFace half_cylinder(double radius, double length) {
    CadFace face;
    face.rows = 2;
    for (const double turn : {1.0, -1.0}) {
        ControlNet net = ControlNet::sized(3, 2);
        for (int i = 0; i < 3; ++i) {
            const double y = turn > 0.0 ? quarter_x[i] : -quarter_y[i];
            const double z = turn > 0.0 ? quarter_y[i] : quarter_x[i];
            for (int j = 0; j < 2; ++j) {
                net.point(i, j) = {length * j, radius * y, radius * z};
                net.weight(i, j) = quarter_weight[i];
            }
        }
        face.patches.emplace_back(net);
    }
    return face;
}

double distance_from_torus(const Vec3& at, double large, double small) {
    return std::abs(std::hypot(std::hypot(at.x(), at.y()) - large, at.z()) - small);
}

template <typename Distance> double largest_on(const BezierPatch& patch, Distance distance) {
    double largest = 0.0;
    for (int i = 0; i <= 300; ++i) {
        for (int j = 0; j <= 300; ++j) {
            largest = std::max(largest, distance(patch.position(i / 300.0, j / 300.0)));
        }
    }
    return largest;
}

FitSettings of_degree(int u, int v) {
    FitSettings settings;
    settings.degree_u = u;
    settings.degree_v = v;
    return settings;
}

// Fitted to chords of 24 steps the patch was 0.04 mm off, at whatever degree.
TEST(FaceFit, IsOfTheFaceNotOfItsChords) {
    const MeshFit fit = fit_face(half_cylinder(100.0, 30.0), of_degree(9, 1), {});
    const double measured =
        largest_on(fit.patch, [](const Vec3& at) { return std::abs(std::hypot(at.y(), at.z()) - 100.0); });
    EXPECT_LT(measured, 3e-3);
    EXPECT_NEAR(fit.deviation.max, measured, 0.2 * measured);
    EXPECT_TRUE(fit.follows_outline);
}

TEST(FaceFit, TellsTheDistanceFromTheFaceItself) {
    for (const int degree : {3, 4, 6}) {
        const MeshFit fit = fit_face(torus_quarter(100.0, 40.0), of_degree(degree, degree), {});
        const double measured =
            largest_on(fit.patch, [](const Vec3& at) { return distance_from_torus(at, 100.0, 40.0); });
        EXPECT_GT(fit.deviation.max, 0.9 * measured) << degree;
        // Sides that end short of the face's are reported, too.
        EXPECT_LT(fit.deviation.max, 2.0 * measured + 1e-6) << degree;
        // Its sides go a little beyond those of the face, which the whole torus does not tell.
        EXPECT_GT(fit.deviation.patch_max, 0.98 * measured) << degree;
        EXPECT_LT(fit.deviation.patch_max, 3.0 * measured + 1e-6) << degree;
        EXPECT_LE(fit.deviation.mean, fit.deviation.rms) << degree;
        EXPECT_LE(fit.deviation.rms, fit.deviation.max) << degree;
        EXPECT_TRUE(fit.follows_outline) << degree;
    }
}

/// Two rows of a wavy face, the second `length` mm long: little of its area, so that few points hold a patch
/// over half of its parameters.
CadFace wavy_face(double length) {
    CadFace face;
    face.rows = 2;
    constexpr double heights[7][4] = {{0.0, 0.0, 0.0, 0.0},
                                      {9.0, -14.0, 6.0, 11.0},
                                      {-12.0, 4.0, 13.0, -7.0},
                                      {2.0, 1.0, -1.0, 0.5},
                                      {0.3, -0.8, 0.6, 0.1},
                                      {-0.7, 0.2, 0.9, -0.4},
                                      {0.2, 0.5, -0.3, 0.6}};
    for (const int row : {0, 1}) {
        ControlNet net = ControlNet::sized(4, 4);
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                const double x = row == 0 ? 100.0 * i / 3.0 : 100.0 + length * i / 3.0;
                const double scale = row == 0 || i == 0 ? 1.0 : 0.3 * length;
                net.point(i, j) = {x, 20.0 * j, scale * heights[3 * row + i][j]};
            }
        }
        face.patches.emplace_back(net);
    }
    return face;
}

double distance_from(const std::vector<geometry::ClosestPointSearch>& parts, const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const geometry::ClosestPointSearch& part : parts) {
        least = std::min(least, part.closest(point).distance);
    }
    return least;
}

// "At most 1.1 mm" was said of a patch that bulged 100 mm away from its face.
TEST(FaceFit, ReportsHowFarThePatchBulgesOrRefusesIt) {
    for (const double length : {0.01, 1.0, 20.0}) {
        const CadFace face = wavy_face(length);
        std::vector<geometry::ClosestPointSearch> parts;
        for (const BezierPatch& part : face.patches) {
            parts.emplace_back(part);
        }
        for (const int degree : {3, 5, 9, 12}) {
            try {
                const MeshFit fit = fit_face(face, of_degree(degree, degree), {});
                double measured = 0.0;
                for (int i = 0; i <= 150; ++i) {
                    for (int j = 0; j <= 30; ++j) {
                        measured =
                            std::max(measured, distance_from(parts, fit.patch.position(i / 150.0, j / 30.0)));
                    }
                }
                EXPECT_GE(1.05 * fit.deviation.patch_max + 1e-6, measured) << length << ", " << degree;
                EXPECT_LE(fit.deviation.patch_max, 1.05 * measured + 1e-6) << length << ", " << degree;
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find("the fitted patch"), std::string::npos)
                    << error.what();
            }
        }
    }
}

TEST(FaceFit, NormalLooksTheWayTheFaceDoes) {
    const CadFace face = half_cylinder(20.0, 30.0);
    const MeshFit fit = fit_face(face, of_degree(5, 2), {});
    for (const double u : {0.1, 0.5, 0.9}) {
        const auto of_fit = fit.patch.unit_normal(u, 0.5);
        const double row = u < 0.5 ? 0.0 : 1.0;
        const auto of_face = face.patches[static_cast<std::size_t>(row)].unit_normal(2.0 * u - row, 0.5);
        ASSERT_TRUE(of_fit && of_face);
        EXPECT_GT(of_fit->dot(*of_face), 0.99);
    }
}

TEST(FaceFit, FiguresAreOfWhatTheOutlineLeaves) {
    CadFace face = torus_quarter(100.0, 40.0);
    const Deviation whole = fit_face(face, of_degree(3, 3), {}).deviation;
    face.outline = {{0.45, 0.45}, {0.55, 0.45}, {0.55, 0.55}, {0.45, 0.55}};
    const MeshFit fit = fit_face(face, of_degree(3, 3), {});
    double measured = 0.0;
    for (int i = 0; i <= 50; ++i) {
        for (int j = 0; j <= 50; ++j) {
            const Vec3 at = fit.patch.position(0.45 + 0.1 * i / 50.0, 0.45 + 0.1 * j / 50.0);
            measured = std::max(measured, distance_from_torus(at, 100.0, 40.0));
        }
    }
    EXPECT_LT(fit.deviation.max, whole.max);
    EXPECT_NEAR(fit.deviation.max, measured, 0.1 * measured);
    EXPECT_EQ(fit.deviation.at_points.size(), fit.side.points.size());
}

TEST(FaceFit, FromOneSideTakesWhatIsSeenFromThere) {
    FitSettings settings = of_degree(5, 2);
    settings.along = Vec3::UnitY();
    const MeshFit fit = fit_face(half_cylinder(20.0, 30.0), settings, {});
    EXPECT_GT(fit.left_out_area, 0.4 * std::numbers::pi * 20.0 * 30.0);
    for (const Vec3& point : fit.side.points) {
        EXPECT_GT(point.y(), -1e-9);
    }
    settings.along = Vec3::UnitX();
    EXPECT_THROW((void)fit_face(half_cylinder(20.0, 30.0), settings, {}), Error);
}

} // namespace
} // namespace millwright::exchange
