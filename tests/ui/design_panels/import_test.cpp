// Surfaces of other programs as a person brings them in and writes them: real mouse and keys, real files.
#include "core/base/files.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/surface_file.h"
#include "core/geometry/patch_refinement.h"
#include "core/project/project_file.h"
#include "core/project/surface.h"
#include "tests/ui/person/person.h"
#include "ui/window/desktop.h"
#include "ui/workspaces/pending_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using test::dome_project;

namespace fs = std::filesystem;

using test::Person;
using ::testing::HasSubstr;

geometry::Surface surface_in(const char* project) {
    return project::surface_of(project::read_project(project).surface);
}

class Import : public ::testing::Test {
protected:
    Import() { person_.open(dome_project); }

    [[nodiscard]] fs::path written(const std::string& name, const geometry::Surface& surface) {
        const fs::path file = person_.folder() / name;
        exchange::write_surface(surface, file, 0.02, {});
        return file;
    }
    [[nodiscard]] fs::path written(const std::string& name, const std::string& content) {
        const fs::path file = person_.folder() / name;
        write_file(file, content);
        return file;
    }
    /// As the window does what is dropped on it.
    void drop(const fs::path& file) {
        person_.app().receive({file});
        person_.wait_idle();
    }
    [[nodiscard]] const actions::PendingImport& bench() { return person_.app().import(); }
    [[nodiscard]] bool was_told(const std::string& words) {
        return std::ranges::any_of(person_.app().view_state().log,
                                   [&](const std::string& line) { return line.find(words) != line.npos; });
    }

    Person person_{{1280, 800}};
};

TEST_F(Import, MeasuredPointsAreASurfaceThroughThemOrNearThem) {
    std::string text;
    for (int n = 0; n < 64; ++n) {
        const int x = n / 8, y = n % 8;
        text += std::to_string(10 * x) + "," + std::to_string(10 * y) + "," + std::to_string(x * y) + "\n";
    }
    const fs::path file = written("probe.csv", text);
    person_.app().open_surface(file);
    person_.wait_idle();
    ASSERT_TRUE(bench().is_ready());
    EXPECT_TRUE(bench().latest()->surface->surface.face) << "one surface, all of which is machined";
    EXPECT_TRUE(person_.sees("inspector/import/result/max"));
    person_.keep("import-rows");
    person_.click("inspector/import/patch/fit");
    person_.wait_idle();
    EXPECT_EQ(bench().latest()->surface->surface.patches.size(), 1U);
    EXPECT_TRUE(person_.sees("view/deviation_legend"));
    EXPECT_EQ(bench().latest()->reference->fitted.points.size(), 64U); // drawn beside the surface
    person_.keep("import-points");
    person_.click("inspector/import/patch/cloud");
    person_.wait_idle();
    EXPECT_EQ(bench().latest()->surface->points->rows, 0);
    EXPECT_EQ(bench().latest()->reference->fitted.points.size(), 64U);
    person_.keep("import-cloud");
    person_.click("inspector/import/import_take");
    person_.wait_idle();
    EXPECT_EQ(person_.project().surface.patches.size(), 1U);
}

TEST_F(Import, AMeshIsFittedLookedAtTakenAndUndone) {
    const project::SurfaceInput before = person_.project().surface;
    drop(written("sine.stl", surface_in("assets/projects/sine.json")));
    ASSERT_TRUE(bench().is_ready());
    EXPECT_EQ(person_.project().surface, before) << "nothing is changed before it is taken";
    ASSERT_TRUE(bench().latest()->surface->fit);
    EXPECT_TRUE(person_.sees("view/deviation_legend"));
    person_.keep("import-mesh");
    const double fine = bench().latest()->surface->fit->deviation.max;
    person_.fill_in("inspector/import/patch/degree_u", "1");
    person_.wait_idle();
    EXPECT_EQ(bench().latest()->surface->fit->patch.degree_u(), 1);
    EXPECT_GT(bench().latest()->surface->fit->deviation.max, 10.0 * fine);
    person_.keep("import-mesh-degree-1");
    person_.fill_in("inspector/import/patch/degree_u", "3");
    person_.fill_in("inspector/import/patch/degree_v", "3");
    person_.wait_idle();
    const auto patch = bench().latest()->surface->fit->patch;
    person_.click("inspector/import/import_take");
    person_.wait_idle();
    EXPECT_FALSE(bench().is_open());
    EXPECT_EQ(person_.project().surface.patches, std::vector{patch.net()});
    EXPECT_TRUE(person_.sees("inspector/surface/preset")) << "the Design inspector again";
    EXPECT_TRUE(person_.sees("view/deviation_legend")) << "the reference stays";
    person_.keep("import-mesh-taken");
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_EQ(person_.project().surface, before);
    EXPECT_FALSE(person_.sees("view/deviation_legend"));
}

TEST_F(Import, OfTheProjectsPathNothingIsPlottedBesideWhatIsLookedAt) {
    EXPECT_TRUE(person_.sees("lower/error"));
    drop(written("sine.stl", surface_in("assets/projects/sine.json")));
    EXPECT_FALSE(person_.sees("lower/error"));
    EXPECT_EQ(person_.refusal("timeline/timeline/play"), "The imported surface has no program yet.");
    person_.keep("import-no-path");
    person_.press_key(render::Key::f4); // where the project is on screen
    EXPECT_TRUE(person_.sees("lower/error"));
    person_.press_key(render::Key::f2);
    person_.click("inspector/import/import_give_up");
    EXPECT_TRUE(person_.sees("lower/error"));
}

TEST_F(Import, TheDialogListsTheFilesThatCanBeRead) {
    (void)written("dome.ply", surface_in(dome_project));
    (void)written("notes.md", std::string("nothing"));
    const fs::path project = person_.folder() / "mine.json";
    fs::copy_file(dome_project, project);
    person_.open(project);
    person_.press_key(render::Key::i, true);
    EXPECT_TRUE(person_.sees("dialogs/files/entries/dome.ply"));
    EXPECT_FALSE(person_.sees("dialogs/files/entries/notes.md"));
    EXPECT_FALSE(person_.sees("dialogs/files/entries/mine.json"));
    person_.click("dialogs/files/entries/dome.ply");
    person_.keep("import-dialog");
    person_.click("dialogs/files/open");
    person_.wait_idle();
    EXPECT_EQ(bench().file().filename(), "dome.ply");
    person_.click("inspector/import/import_give_up");
    EXPECT_FALSE(bench().is_open());
    EXPECT_EQ(person_.project().surface, project::read_project(dome_project).surface);
}

TEST_F(Import, OneOfSeveralFacesIsChosen) {
    if (!exchange::reads_cad_files()) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    drop("assets/samples/cover.step");
    EXPECT_FALSE(bench().is_ready());
    EXPECT_NE(person_.refusal("inspector/import/import_take"), "");
    person_.keep("import-faces");
    const auto& faces = bench().latest()->source->model->faces;
    ASSERT_GT(faces.size(), 1U);
    const auto trimmed =
        std::ranges::find_if(faces, [](const exchange::CadFace& face) { return !face.holes.empty(); });
    ASSERT_NE(trimmed, faces.end());
    person_.click("inspector/import/faces/list/" + std::to_string(trimmed->number));
    person_.wait_idle();
    ASSERT_TRUE(bench().is_ready());
    person_.keep("import-face-chosen");
    person_.click("inspector/import/import_take");
    person_.wait_idle();
    EXPECT_FALSE(person_.project().surface.trim(0).everything());
    person_.keep("import-face-taken");
}

/// `import --face` wants them.
TEST_F(Import, TheNumbersOfManyFacesAreWhole) {
    if (!exchange::reads_cad_files()) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    constexpr int strips = 12;
    std::vector<geometry::BezierPatch> patches;
    geometry::BezierPatch rest = surface_in(dome_project).patches().front();
    for (int left = strips; left > 1; --left) {
        auto [strip, other] = geometry::split(rest, geometry::Parameter::u, 1.0 / left);
        patches.push_back(std::move(strip));
        rest = std::move(other);
    }
    patches.push_back(rest);
    drop(written("strips.step", geometry::Surface(std::move(patches))));
    person_.frames();
    person_.click("inspector/import/faces/list/12");
    person_.wait_idle();
    person_.keep("import-many-faces");
    for (const std::string& text : person_.desktop().ui().cut_texts()) {
        EXPECT_NE(text.find_first_not_of("0123456789"), std::string::npos) << text << " is cut";
    }
    EXPECT_EQ(bench().choice().face, strips);
}

TEST_F(Import, AFaceIsChosenByAClickInTheView) {
    if (!exchange::reads_cad_files()) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    drop("assets/samples/cover.step");
    person_.frames();
    constexpr widgets::Point middle{500.0F, 270.0F}; // of the face on top
    person_.click_at(middle);
    person_.wait_idle();
    const int first = bench().choice().face;
    EXPECT_GT(first, 0);
    EXPECT_TRUE(bench().is_ready());
    person_.keep("import-face-clicked");
    person_.click_at(middle);
    person_.wait_idle();
    EXPECT_EQ(bench().choice().face, first) << "it lies before all others";
    person_.click("inspector/import/import_take");
    person_.wait_idle();
    EXPECT_TRUE(person_.project().surface.patches.size() > 0);
}

TEST_F(Import, WhatIsWrongIsToldAndChangesNothing) {
    const project::Project before = person_.project();
    const auto refused = [&](const fs::path& file, const std::string& words) {
        drop(file);
        EXPECT_TRUE(was_told(words)) << file << "\n" << person_.app().view_state().log.back();
        EXPECT_FALSE(bench().is_open());
        EXPECT_EQ(person_.project(), before);
    };
    refused(written("empty.stl", std::string()), "empty.stl");
    refused(written("broken.ply", std::string("ply\nformat ascii 1.0\nelement vertex 3\n")), "broken.ply");
    refused(written("flat.obj", std::string("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), "flat.obj");
    if (exchange::reads_cad_files()) {
        refused(written("empty.step", std::string()), "the file is empty");
        refused(written("broken.step", std::string("ISO-10303-21;\nHEADER;\n")), "broken.step");
    }
    refused(person_.folder() / "nowhere.stl", "there is no such file");
    person_.keep("import-refused");
    EXPECT_EQ(person_.app().look().undo_title, "") << "there is nothing to undo";
}

TEST_F(Import, ASideThatTheMeshDoesNotHaveStaysOnTheBench) {
    drop(written("plate.obj", std::string("v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1 2 3 4\n")));
    ASSERT_TRUE(bench().is_ready());
    person_.click("inspector/import/patch/along");
    person_.click("inspector/import/patch/along/down");
    person_.wait_idle();
    EXPECT_FALSE(bench().is_ready());
    EXPECT_TRUE(person_.sees("inspector/import/result/failure"));
    EXPECT_NE(person_.refusal("inspector/import/import_take"), "");
    person_.keep("import-side");
}

TEST_F(Import, UndoShowsTheSurfaceThatComesBack) {
    const auto corner = [&] { return person_.place("view/control_point(0,0)").centre(); };
    const auto before = corner();
    drop(written("away.obj",
                 std::string("v 900 900 0\nv 1300 900 0\nv 1300 1300 0\nv 900 1300 0\nf 1 2 3 4\n")));
    person_.click("inspector/import/import_take");
    person_.wait_idle();
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    person_.keep("import-undone");
    constexpr float near = 3.0F; // pixels
    EXPECT_NEAR(corner().x, before.x, near);
    EXPECT_NEAR(corner().y, before.y, near);
    const auto taken_back = corner();
    person_.app().edit(
        "Move a point", [](project::Project& p) { p.surface.patches.front().point(0, 0).z() += 5.0; }, {});
    person_.wait_idle();
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_FLOAT_EQ(corner().y, taken_back.y) << "a point that goes back leaves the view alone";
}

TEST_F(Import, TheUnitOfAMeshIsChosen) {
    drop(written("plate.obj", std::string("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n")));
    person_.click("inspector/import/patch/unit/inch");
    person_.wait_idle();
    EXPECT_NEAR(bench().latest()->patches->control_box().sizes().x(), 2.0 * 25.4, 1e-9);
}

TEST_F(Import, CancelEndsTheReadingAndLeavesTheProject) {
    const project::Project before = person_.project();
    std::string mesh = "";
    constexpr int side = 700; // nearly a million triangles
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            mesh += "v " + std::to_string(i) + " " + std::to_string(j) + " 0\n";
        }
    }
    for (int i = 0; i + 1 < side; ++i) {
        for (int j = 1; j < side; ++j) {
            const int a = i * side + j;
            mesh += "f " + std::to_string(a) + " " + std::to_string(a + side) + " " +
                    std::to_string(a + side + 1) + " " + std::to_string(a + 1) + "\n";
        }
    }
    person_.app().receive({written("large.obj", mesh)});
    ASSERT_TRUE(person_.live_until([&] { return person_.sees("inspector/import/work"); }));
    person_.keep("import-reading");
    person_.click("inspector/import/work/cancel");
    ASSERT_TRUE(person_.live_until([&] { return !bench().is_open() && !bench().activity().busy; }));
    EXPECT_EQ(person_.project(), before);
    EXPECT_TRUE(person_.sees("inspector/surface/preset"));
}

TEST_F(Import, TheSurfaceIsExported) {
    person_.click("menu/file");
    person_.click("menu/file/file_export");
    person_.frames();
    person_.fill_in("dialogs/files/name", (person_.folder() / "out.ply").string());
    person_.wait_idle();
    EXPECT_TRUE(was_told("Surface written."));
    EXPECT_THAT(read_file(person_.folder() / "out.ply"), ::testing::StartsWith("ply"));
    person_.app().run("file.export");
    person_.frames();
    person_.fill_in("dialogs/files/name", (person_.folder() / "out.dwg").string());
    EXPECT_TRUE(was_told("name ending in .step"));
    EXPECT_FALSE(fs::exists(person_.folder() / "out.dwg"));
    person_.frames(3);
    person_.keep("export-refused");
    EXPECT_EQ(person_.refusal("dialogs/files/save"), "") << "the name stands there still";
    person_.type((person_.folder() / "out.obj").string()); // in its place, without a click
    person_.press_key(render::Key::enter);
    person_.wait_idle();
    EXPECT_TRUE(fs::exists(person_.folder() / "out.obj"));
}

TEST_F(Import, AnExportTellsThatOutlinesStayBehind) {
    person_.app().edit("Trim",
                       [](project::Project& draft) {
                           draft.surface.trims = {{{{{0.2, 0.2}, {0.8, 0.2}, {0.5, 0.8}}}}};
                       },
                       {});
    person_.wait_idle();
    person_.app().export_surface(person_.folder() / "out.ply");
    person_.wait_idle();
    EXPECT_TRUE(was_told("Surface written. One patch is trimmed: the file contains the whole patch"));
    person_.keep("export-trimmed");
}

TEST_F(Import, AnExportCanBeCancelledAndLeavesTheFile) {
    project::Project many = person_.project();
    const geometry::ControlNet first = many.surface.patches.front();
    for (int n = 1; n < 200; ++n) {
        geometry::ControlNet net = first;
        for (Vec3& point : net.points) {
            point.x() += 200.0 * n;
        }
        many.surface.patches.push_back(net);
    }
    project::write_project(many, person_.folder() / "many.json");
    person_.app().open(person_.folder() / "many.json");
    person_.wait_idle();
    const fs::path file = written("out.stl", std::string("as it was"));
    person_.app().export_surface(file);
    ASSERT_TRUE(person_.live_until([&] {
        const plan::Activity now = person_.app().look().activity;
        return now.busy && now.text.starts_with("Writing the surface: ") && now.fraction > 0.0;
    }));
    person_.keep("export-running");
    person_.app().run("work.cancel");
    person_.wait_idle();
    EXPECT_TRUE(was_told("Cancelled: Writing the surface"));
    EXPECT_FALSE(was_told("Surface written."));
    EXPECT_EQ(read_file(file), "as it was");
    person_.keep("export-cancelled");
}

} // namespace
} // namespace millwright::panels
