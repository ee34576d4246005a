#include "core/project/project.h"

#include "core/base/error.h"
#include "core/geometry/presets.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace millwright::project {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Project, EveryPresetGivesAFaultlessProject) {
    for (const auto& preset : geometry::surface_presets()) {
        const Project project = project_from_preset(preset.id);
        EXPECT_TRUE(faults_of(project).empty()) << preset.id;
        EXPECT_EQ(project.name, preset.title);
    }
    EXPECT_THROW((void)project_from_preset("doom"), Error);
}

TEST(Project, CopiesAreEqualUntilOneChanges) {
    const Project project = project_from_preset("sine");
    Project copy = project;
    EXPECT_EQ(copy, project);
    copy.surface.patches[0].point(1, 1).z() += 1e-9;
    EXPECT_NE(copy, project);
}

TEST(Project, FaultsNameTheFieldAndItsRange) {
    Project project = project_from_preset("dome");
    project.grid.nu = 1;
    EXPECT_THAT(faults_of(project), ElementsAre("grid/nu: 1 is not between 2 and 1000"));
}

TEST(Project, ANumberThatIsNoneIsAFault) {
    const test::WithoutTraps numbers_that_are_none;
    Project project = project_from_preset("dome");
    project.program.feed_mm_per_min = nan;
    project.grid.elliptic.adaptation = std::numeric_limits<double>::infinity();
    project.surface.patches[0].point(1, 2).x() = nan;
    project.machine.workpiece_offset = Vec3(0.0, nan, 0.0);
    EXPECT_THAT(faults_of(project), Contains(HasSubstr("program/feed_mm_per_min: nan")));
    EXPECT_THAT(faults_of(project), Contains(HasSubstr("grid/elliptic/adaptation: inf")));
    EXPECT_THAT(faults_of(project),
                Contains(HasSubstr("surface/patches[0]: control point (1,2) is not finite")));
    EXPECT_THAT(faults_of(project), Contains(HasSubstr("machine/workpiece_offset")));
}

TEST(Project, FaultyAnglesAreForAPointAndLeaveNoChoice) {
    Project project = project_from_preset("dome");
    project.machine.angle_mode = kinematics::AngleMode::faulty_text;
    EXPECT_THAT(faults_of(project), ElementsAre());
    project.tool.cutter = toolpath::CutterKind::ball;
    project.sequencing.goal = toolpath::SequencingGoal::travel;
    EXPECT_THAT(faults_of(project), ElementsAre(HasSubstr("tool/cutter"), HasSubstr("sequencing")));
    project.machine.angle_mode = kinematics::AngleMode::consistent;
    EXPECT_THAT(faults_of(project), ElementsAre());
    project.sequencing.largest_step_deg = 0.001;
    EXPECT_THAT(faults_of(project), ElementsAre(HasSubstr("must be 0 or at least 0.01")));
}

TEST(Project, ASurfaceNeedsItsPatches) {
    Project project = project_from_preset("dome");
    project.surface.machined_patch = 1;
    EXPECT_THAT(faults_of(project), ElementsAre(HasSubstr("no patch 1; the surface has 1")));
    project.surface.patches.clear();
    project.surface.machined_patch = 0;
    EXPECT_THAT(faults_of(project), ElementsAre(HasSubstr("at least one patch")));
}

/// The dome, smaller.
Project shrunk(double factor) {
    Project project = project_from_preset("dome");
    project.surface.preset.clear();
    for (Vec3& point : project.surface.patches.front().points) {
        point *= factor;
    }
    return project;
}

// It was planned without a word.
TEST(Project, APartBelowAMicrometreIsAFaultWithItsSize) {
    EXPECT_THAT(faults_of(shrunk(1e-4)), ElementsAre());
    EXPECT_THAT(
        faults_of(shrunk(1e-5)),
        ElementsAre(AllOf(
            HasSubstr("surface/patches[0]: the part is 0.00089 mm in size, below the minimum of 0.001 mm"),
            HasSubstr("in inches the size would be 0.0226 mm, in metres 0.89 mm"))));
}

TEST(Project, ARegionWithoutAreaIsAFault) {
    Project project = project_from_preset("dome");
    using Outline = std::vector<Vec2>;
    for (const Outline& none : {Outline{{0.1, 0.1}, {0.5, 0.5}, {0.9, 0.9}},
                                Outline{{0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}},
                                Outline{{0.1, 0.1}, {0.5, 0.5}, {0.9, 0.1}, {0.5, 0.5}}}) {
        project.grid.elliptic.region.outline = none;
        EXPECT_THAT(faults_of(project), ElementsAre("grid/elliptic/region: the outline encloses no area"));
    }
    for (const Outline& some : {Outline{{0.1, 0.1}, {0.5, 0.5}, {0.9, 0.8}},
                                Outline{{0.1, 0.1}, {0.9, 0.9}, {0.9, 0.1}, {0.1, 0.9}}, // crosses itself
                                Outline{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}) {
        project.grid.elliptic.region.outline = some;
        EXPECT_THAT(faults_of(project), ElementsAre());
    }
}

TEST(Project, AnUnknownPresetOrNoMachineIsAFault) {
    Project project = project_from_preset("dome");
    project.surface.preset = "doom";
    project.machine.file.clear();
    EXPECT_THAT(
        faults_of(project),
        ElementsAre(HasSubstr("unknown surface preset 'doom'"), HasSubstr("no machine is specified")));
}

} // namespace
} // namespace millwright::project
