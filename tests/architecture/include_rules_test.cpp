#include "tests/architecture/include_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// What is said of one include line in one file, without the place.
std::vector<std::string> said_of(const std::string& path, const std::string& include) {
    std::vector<std::string> sentences;
    for (const auto& finding : check_includes({{path, "#include " + include + "\n"}})) {
        sentences.push_back(finding.sentence);
    }
    return sentences;
}

TEST(Includes, TellThePlaceOfTheLine) {
    const std::vector<TextFile> files = {
        {"core/grid/a.cpp", "// head\n\n  #  include \"ui/panels/panel.h\"\n"}};
    EXPECT_THAT(check_includes(files),
                ElementsAre(Finding{"core/grid/a.cpp", 3, "core knows nothing of ui: ui/panels/panel.h"}));
}

TEST(Includes, GoDownInTheOrderOfTheCore) {
    EXPECT_THAT(said_of("core/grid/a.cpp", "\"core/base/error.h\""), IsEmpty());
    EXPECT_THAT(said_of("core/jobs/a.h", "\"core/drivers/driver.h\""), IsEmpty());
    EXPECT_THAT(said_of("core/grid/a.cpp", "\"core/grid/grid.h\""), IsEmpty());
    EXPECT_THAT(said_of("core/grid/a.cpp", "\"core/toolpath/toolpath.h\""),
                ElementsAre("core/grid includes upward: core/toolpath/toolpath.h"));
    EXPECT_THAT(said_of("core/base/a.h", "\"core/geometry/vectors.h\""),
                ElementsAre("core/base includes upward: core/geometry/vectors.h"));
}

TEST(Includes, KeepGeometryAndCordicApart) {
    EXPECT_THAT(said_of("core/cordic/a.cpp", "\"core/geometry/vectors.h\""),
                ElementsAre("core/cordic includes upward: core/geometry/vectors.h"));
}

TEST(Includes, OfAnUnknownFolderInTheCoreAreFound) {
    EXPECT_THAT(
        said_of("core/extras/a.cpp", "\"core/base/error.h\""),
        ElementsAre("core/extras has no place in the order of the folders of core: core/base/error.h"));
    EXPECT_THAT(said_of("core/grid/a.cpp", "\"core/extras/a.h\""),
                ElementsAre("core/extras has no place in the order of the folders of core: core/extras/a.h"));
}

TEST(Includes, GoDownInTheOrderOfTheWindow) {
    EXPECT_THAT(said_of("ui/window/a.cpp", "\"ui/arm_panels/b.h\""), IsEmpty());
    EXPECT_THAT(said_of("ui/arm_panels/a.cpp", "\"ui/machine_panels/b.h\""), IsEmpty());
    EXPECT_THAT(said_of("ui/plot_panels/a.cpp", "\"ui/simulation_panels/b.h\""), IsEmpty());
    EXPECT_THAT(said_of("ui/workspaces/a.cpp", "\"ui/actions/action.h\""),
                ElementsAre("ui/workspaces includes upward: ui/actions/action.h"));
    EXPECT_THAT(said_of("ui/panels/a.cpp", "\"ui/plot_panels/b.h\""),
                ElementsAre("ui/panels includes upward: ui/plot_panels/b.h"));
    EXPECT_THAT(said_of("ui/machine_panels/a.cpp", "\"ui/plot_panels/b.h\""),
                ElementsAre("ui/machine_panels includes upward: ui/plot_panels/b.h"));
    EXPECT_THAT(said_of("ui/extras/a.cpp", "\"ui/render/view.h\""),
                ElementsAre("ui/extras has no place in the order of the folders of ui: ui/render/view.h"));
}

TEST(Includes, GoDownInTheOrderOfTheProgramsAreas) {
    EXPECT_THAT(said_of("app/plots/a.cpp", "\"app/drivers/run.h\""), IsEmpty());
    EXPECT_THAT(said_of("app/plots/a.cpp", "\"app/plots/b.h\""), IsEmpty());
    EXPECT_THAT(said_of("app/main.cpp", "\"app/workbench.h\""), IsEmpty());
    EXPECT_THAT(said_of("app/main.cpp", "\"app/plots/b.h\""), IsEmpty());
    EXPECT_THAT(said_of("app/drivers/a.cpp", "\"app/plots/b.h\""),
                ElementsAre("app/drivers includes upward: app/plots/b.h"));
    EXPECT_THAT(said_of("app/gcode/a.cpp", "\"app/plan/b.h\""),
                ElementsAre("app/gcode includes upward: app/plan/b.h"));
    EXPECT_THAT(said_of("app/command_line/a.cpp", "\"app/workbench.h\""),
                ElementsAre("app/command_line includes upward: app/workbench.h"));
    EXPECT_THAT(
        said_of("app/extras/a.cpp", "\"app/command_line/command.h\""),
        ElementsAre(
            "app/extras has no place in the order of the folders of app: app/command_line/command.h"));
}

TEST(Includes, NeverCrossFromThePartsBelowToThoseAbove) {
    EXPECT_THAT(said_of("core/project/a.cpp", "\"app/main.h\""),
                ElementsAre("core knows nothing of app: app/main.h"));
    EXPECT_THAT(said_of("ui/panels/a.cpp", "\"app/main.h\""),
                ElementsAre("ui knows nothing of app: app/main.h"));
    EXPECT_THAT(said_of("core/base/a.cpp", "\"tests/support/oracle.h\""),
                ElementsAre("core knows nothing of tests: tests/support/oracle.h"));
    EXPECT_THAT(said_of("tests/core/grid/a_test.cpp", "\"ui/render/camera.h\""),
                ElementsAre("tests/core knows nothing of ui: ui/render/camera.h"));
    EXPECT_THAT(said_of("app/main.cpp", "\"ui/render/camera.h\""), IsEmpty());
}

TEST(Includes, OfInternalStayInTheFolderAndItsTests) {
    EXPECT_THAT(said_of("core/grid/a.cpp", "\"core/grid/internal/stencil.h\""), IsEmpty());
    EXPECT_THAT(said_of("tests/core/grid/a_test.cpp", "\"core/grid/internal/stencil.h\""), IsEmpty());
    EXPECT_THAT(said_of("core/toolpath/a.cpp", "\"core/grid/internal/stencil.h\""),
                ElementsAre("internal/ belongs to core/grid: core/grid/internal/stencil.h"));
    EXPECT_THAT(said_of("core/gridlock/a.cpp", "\"core/grid/internal/stencil.h\""),
                ::testing::Not(IsEmpty()));
}

TEST(Includes, OfTheScreenStayInTheUi) {
    for (const std::string header : {"<imgui.h>", "<GLFW/glfw3.h>"}) {
        EXPECT_THAT(said_of("ui/panels/a.cpp", header), IsEmpty());
        EXPECT_THAT(
            said_of("core/project/a.cpp", header),
            ElementsAre("Dear ImGui or GLFW is not used here: " + header.substr(1, header.size() - 2)));
    }
    for (const std::string header : {"<epoxy/gl.h>", "<GL/gl.h>", "<EGL/egl.h>"}) {
        EXPECT_THAT(said_of("ui/render/a.cpp", header), IsEmpty());
        EXPECT_THAT(said_of("core/project/a.cpp", header),
                    ElementsAre("OpenGL is not used here: " + header.substr(1, header.size() - 2)));
    }
}

TEST(Includes, OfALibraryStayInItsHome) {
    EXPECT_THAT(said_of("core/base/parallel_tbb.cpp", "<tbb/parallel_for.h>"), IsEmpty());
    EXPECT_THAT(said_of("core/grid/a.cpp", "<tbb/parallel_for.h>"),
                ElementsAre("TBB is not used here: tbb/parallel_for.h"));
    EXPECT_THAT(said_of("core/grid/a.cpp", "<oneapi/tbb.h>"),
                ElementsAre("TBB is not used here: oneapi/tbb.h"));
    EXPECT_THAT(said_of("ui/render/a.h", "<glm/mat4x4.hpp>"), IsEmpty());
    EXPECT_THAT(said_of("core/geometry/a.h", "<glm/mat4x4.hpp>"),
                ElementsAre("GLM is not used here: glm/mat4x4.hpp"));
    EXPECT_THAT(said_of("core/project/a.cpp", "<nlohmann/json.hpp>"), IsEmpty());
    EXPECT_THAT(said_of("ui/panels/a.cpp", "<nlohmann/json.hpp>"),
                ElementsAre("nlohmann-json is not used here: nlohmann/json.hpp"));
}

TEST(Includes, OfJsonDoNotStandInAHeaderForOthers) {
    EXPECT_THAT(said_of("core/project/internal/reading.h", "<nlohmann/json.hpp>"), IsEmpty());
    EXPECT_THAT(said_of("core/project/project.h", "<nlohmann/json.hpp>"),
                ElementsAre("nlohmann-json stays in a .cpp or in internal/: nlohmann/json.hpp"));
}

TEST(Includes, StartAtTheRepositorysRoot) {
    EXPECT_THAT(said_of("core/grid/a.cpp", "<vector>"), IsEmpty());
    EXPECT_THAT(said_of("core/grid/a.cpp", "\"grid.h\""), ::testing::SizeIs(1));
    EXPECT_THAT(said_of("core/grid/a.cpp", "\"../base/error.h\""), ::testing::SizeIs(1));
    EXPECT_THAT(said_of("core/grid/a.cpp", "<core/base/error.h>"), ::testing::SizeIs(1));
}

TEST(Includes, OfThisRepositoryKeepEveryRule) {
    EXPECT_THAT(check_includes(read_repository(".")), IsEmpty());
}

} // namespace
} // namespace millwright::architecture
