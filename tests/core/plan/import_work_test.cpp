#include "core/plan/import_work.h"

#include "core/base/files.h"
#include "core/exchange/surface_file.h"
#include "core/project/surface.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace millwright::plan {
namespace {

class Importing : public ::testing::Test {
protected:
    [[nodiscard]] std::filesystem::path dome_mesh() const {
        exchange::write_surface(project::surface_of(project::project_from_preset("dome").surface),
                                folder_ / "dome.stl",
                                0.05,
                                {});
        return folder_ / "dome.stl";
    }

    test::ScratchFolder folder_;
    std::atomic<int> woken_ = 0;
    ImportWorker worker_{[this] { ++woken_; }};
};

TEST_F(Importing, ReadsOnceAndMakesWhatIsChosen) {
    worker_.open(dome_mesh(), {});
    worker_.wait_idle();
    const auto first = worker_.latest();
    ASSERT_TRUE(first && first->surface && first->reference);
    EXPECT_GT(woken_, 0);
    EXPECT_EQ(first->reference->deviation.size(), first->reference->fitted.points.size());
    EXPECT_EQ(first->reference->largest, first->surface->fit->deviation.max);
    project::ImportChoice inches;
    inches.mm_per_unit = 25.4;
    inches.degrees = project::FitDegrees{2, 4};
    worker_.make(inches);
    worker_.wait_idle();
    const auto second = worker_.latest();
    ASSERT_TRUE(second && second->surface);
    EXPECT_EQ(second->source, first->source) << "the file was not read again";
    EXPECT_EQ(second->surface->fit->patch.degree_v(), 4);
    EXPECT_GT(second->revision, first->revision);
    Box3 in_mm;
    Box3 in_inches;
    for (std::size_t n = 0; n < first->reference->fitted.points.size(); ++n) {
        in_mm.extend(first->reference->fitted.points[n]);
        in_inches.extend(second->reference->fitted.points[n]);
    }
    EXPECT_NEAR(in_inches.sizes().x(), 25.4 * in_mm.sizes().x(), 1e-9);
}

TEST_F(Importing, AFaultIsToldAndTheFileCanStillBeLookedAt) {
    write_file(folder_ / "plate.obj", "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n");
    project::ImportChoice from_below;
    from_below.along = Vec3(0.0, 0.0, -1.0);
    worker_.open(folder_ / "plate.obj", from_below);
    worker_.wait_idle();
    const auto found = worker_.latest();
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->failure);
    EXPECT_EQ(found->surface, nullptr);
    ASSERT_TRUE(found->reference);
    EXPECT_EQ(found->reference->rest.triangles.size(), 2U);
    write_file(folder_ / "none.obj", "# nothing\n");
    worker_.open(folder_ / "none.obj", {});
    worker_.wait_idle();
    EXPECT_EQ(worker_.latest()->source, nullptr);
    EXPECT_TRUE(worker_.latest()->failure);
}

TEST_F(Importing, ClosedNothingIsPublishedAnyMore) {
    worker_.open(dome_mesh(), {});
    worker_.close();
    worker_.wait_idle();
    EXPECT_EQ(worker_.latest(), nullptr);
}

TEST(ImportedFace, ItsOutlineIsWhatIsCutOfIt) {
    exchange::CadFace face;
    face.rows = 2;
    const geometry::Surface dome = project::surface_of(project::project_from_preset("dome").surface);
    face.patches = {dome.patches().front(), dome.patches().front()};
    face.outline = {{0.0, 0.0}, {0.75, 0.0}, {0.75, 1.0}, {0.0, 1.0}};
    face.holes = {{{0.2, 0.2}, {0.4, 0.2}, {0.4, 0.4}}};
    const project::ImportedSurface imported = project::import_face(face, {}, {});
    ASSERT_EQ(imported.surface.patches.size(), 1U) << "the second one is outside";
    const geometry::Trim trim = imported.surface.trim(0);
    EXPECT_TRUE(trim.contains({0.6, 0.5}));
    EXPECT_FALSE(trim.contains({0.9, 0.5}));
    EXPECT_FALSE(trim.contains({0.35, 0.25}));
}

// The preview showed all of it, and its outline only after it was taken.
TEST_F(Importing, AnExactFaceIsShownWithItsOutline) {
    const std::filesystem::path cover = "assets/samples/cover.step";
    project::ImportSource source;
    try {
        source = project::read_source(cover, {});
    } catch (const Error& error) {
        GTEST_SKIP() << error.what(); // built without Open CASCADE
    }
    int trimmed = 0;
    for (const exchange::CadFace& face : source.model->faces) {
        project::ImportChoice choice;
        choice.face = face.number;
        choice.exact = true;
        worker_.open(cover, choice);
        worker_.wait_idle();
        const auto found = worker_.latest();
        ASSERT_TRUE(found);
        if (!found->surface || !found->surface->surface.face) {
            continue; // one patch, or no exact surface
        }
        ASSERT_TRUE(found->trims);
        const geometry::Trim& trim = found->surface->surface.face->trim;
        EXPECT_EQ(*found->trims, std::vector{trim}) << face.number;
        trimmed += trim.everything() ? 0 : 1;
    }
    EXPECT_GT(trimmed, 0);
}

/// Its edges were stairs.
TEST(ReferenceMesh, OfATrimmedFaceEndsAtItsOutline) {
    exchange::CadFace face;
    face.rows = 2; // two squares of 10 mm side by side
    for (const double x : {0.0, 10.0}) {
        geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) {
                net.point(i, j) = {x + 10.0 * i, 10.0 * j, 0.0};
            }
        }
        face.patches.emplace_back(net);
    }
    face.outline = {{0.13, 0.0}, {1.71, 0.21}, {1.37, 0.93}, {0.29, 0.77}};
    face.holes = {{{0.8, 0.4}, {1.23, 0.41}, {1.04, 0.59}}};
    project::ImportSource source;
    source.model = exchange::CadModel{.faces = {face}, .left_out = {}, .notes = {}, .unit = "mm"};
    const exchange::TriangleMesh mesh = reference_mesh(source, {}, nullptr, Progress()).rest;
    double area = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        area += 0.5 * mesh.doubled_area(n).z();
    }
    const double outer =
        0.5 * (0.13 * 0.21 + (1.71 * 0.93 - 1.37 * 0.21) + (1.37 * 0.77 - 0.29 * 0.93) - 0.13 * 0.77);
    const double hole = 0.5 * (0.43 * 0.19 - 0.24 * 0.01);
    EXPECT_NEAR(area, 100.0 * (outer - hole), 1e-9);
}

exchange::CadFace plate(const std::vector<Vec2>& holes, int corners) {
    exchange::CadFace face;
    geometry::ControlNet net = geometry::ControlNet::sized(2, 2);
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            net.point(i, j) = {10.0 * i, 10.0 * j, 0.0};
        }
    }
    face.patches.emplace_back(net);
    face.outline = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    for (const Vec2& middle : holes) {
        auto& hole = face.holes.emplace_back();
        for (int k = 0; k < corners; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / corners;
            hole.emplace_back(middle + 0.02 * Vec2(std::cos(angle), std::sin(angle)));
        }
    }
    return face;
}

TEST(ImportOf, OneOfSeveralFacesSaysThatNothingKeepsTheToolOffTheOthers) {
    exchange::CadFace second = plate({}, 4);
    second.number = 2;
    project::ImportSource source;
    source.model =
        exchange::CadModel{.faces = {plate({}, 4), second}, .left_out = {}, .notes = {}, .unit = "mm"};
    project::ImportChoice choice;
    choice.face = 1;
    const project::ImportedSurface one_of_two = project::import_of(source, choice, Progress());
    ASSERT_EQ(one_of_two.notes.size(), 1U);
    EXPECT_EQ(one_of_two.notes[0],
              "only one of 2 faces is imported: the tool is not checked against the others");
    source.model->faces.pop_back();
    EXPECT_TRUE(project::import_of(source, choice, Progress()).notes.empty());
}

exchange::TriangleMesh reference_of(std::vector<exchange::CadFace> faces) {
    project::ImportSource source;
    source.model = exchange::CadModel{.faces = std::move(faces), .left_out = {}, .notes = {}, .unit = "mm"};
    return reference_mesh(source, {}, nullptr, Progress()).rest;
}

TEST(ReferenceMesh, KeepsToItsLimitWhateverCornersTheOutlinesHave) {
    const auto numbered = [](exchange::CadFace face, int count) {
        std::vector<exchange::CadFace> faces(static_cast<std::size_t>(count), face);
        for (int k = 0; k < count; ++k) {
            faces[static_cast<std::size_t>(k)].number = k + 1;
        }
        return faces;
    };
    const exchange::CadFace four = plate({{0.2, 0.2}, {0.8, 0.2}, {0.2, 0.8}, {0.8, 0.8}}, 48);
    const exchange::TriangleMesh plates = reference_of(numbered(four, 2'000));
    EXPECT_LE(plates.triangles.size(), 300'000U);
    EXPECT_GE(plates.triangles.size(), 50'000U) << "still outlines";
    EXPECT_LE(plates.points.size(), 300'000U);
    std::vector<Vec2> grid;
    for (int k = 0; k < 100; ++k) {
        grid.emplace_back((k % 10 + 0.5) / 10.0, (k / 10 + 0.5) / 10.0);
    }
    const exchange::TriangleMesh sieves = reference_of(numbered(plate(grid, 6), 1'000));
    EXPECT_LE(sieves.triangles.size(), 300'000U) << "no room for all holes";
    EXPECT_GE(sieves.triangles.size(), 2'000U) << "every face is there";
    EXPECT_GT(reference_of({plate(grid, 48)}).triangles.size(), 100U * 48U) << "room for all corners";
}

TEST(ImportedFace, AFittedPatchGetsTheOutlineToo) {
    exchange::CadFace face;
    const geometry::Surface sine = project::surface_of(project::project_from_preset("sine").surface);
    face.patches = {sine.patches().front()};
    face.outline = {{0.3, 0.3}, {0.7, 0.3}, {0.7, 0.7}, {0.3, 0.7}};
    const geometry::BezierPatch& patch = face.patches.front();
    project::ImportChoice choice;
    choice.degrees = project::FitDegrees{patch.degree_u(), patch.degree_v()};
    const project::ImportedSurface imported = project::import_face(face, choice, {});
    ASSERT_EQ(imported.surface.patches.size(), 1U);
    const geometry::BezierPatch fitted(imported.surface.patches.front());
    const geometry::Trim trim = imported.surface.trim(0);
    ASSERT_EQ(trim.loops.size(), 1U);
    for (const Vec2& corner : trim.loops.front()) {
        const Vec3 at = fitted.position(corner.x(), corner.y());
        double nearest = 1e9; // to the outline of the face itself
        for (int side = 0; side < 4; ++side) {
            for (int k = 0; k <= 400; ++k) {
                const Vec2& a = face.outline[static_cast<std::size_t>(side)];
                const Vec2& b = face.outline[static_cast<std::size_t>((side + 1) % 4)];
                const Vec2 uv = a + k / 400.0 * (b - a);
                nearest = std::min(nearest, (patch.position(uv.x(), uv.y()) - at).norm());
            }
        }
        EXPECT_LT(nearest, 0.3);
    }
}

} // namespace
} // namespace millwright::plan
