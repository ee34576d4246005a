// Plans of several exact faces as one surface. A patch that is divided into faces is the same surface: its
// plan, made without any border, is the judge.
#include "core/base/error.h"
#include "core/geometry/closest_point.h"
#include "core/kinematics/forward.h"
#include "core/plan/cut_study.h"
#include "core/plan/internal/derivation.h"
#include "core/plan/part_bodies.h"
#include "core/plan/part_surface.h"
#include "core/plan/plan.h"
#include "core/plan/set_up_study.h"
#include "core/project/setting_tables.h"
#include "core/project/surface.h"
#include "tests/core/plan/sample_projects.h"
#include "tests/support/faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>
#include <string>
#include <vector>

namespace millwright::plan {
namespace {

using project::GridMethod;
using project::StrategyInput;
using test::sample_folders;
using test::small_sample;

/// Its patch in four faces.
project::Project in_four(project::Project project) {
    const geometry::BezierPatch whole(project.surface.patches.at(0));
    const bool flipped = project.surface.flipped;
    project.surface = {};
    project.surface.flipped = flipped;
    project.surface.joined.emplace();
    for (const geometry::BezierPatch& patch : test::quarters(whole, 0.5, 0.5)) {
        const int number = static_cast<int>(project.surface.joined->faces.size()) + 1;
        project.surface.joined->faces.push_back({number, {test::net_of(patch), {}}});
    }
    return project;
}

struct Both {
    project::Project project, of_faces;
    Plan by_patch, by_faces;

    [[nodiscard]] const Evaluation& patch() const { return *by_patch.program_path(project); }
    [[nodiscard]] const Evaluation& faces() const { return *by_faces.program_path(of_faces); }
};

Both both(const project::Project& project) {
    const project::Project faces = in_four(project);
    const Scope scope{.cut = true};
    return {project,
            faces,
            make_plan(project, sample_folders, Progress(), scope),
            make_plan(faces, sample_folders, Progress(), scope)};
}

void expect_alike(const Both& made, double closeness) {
    const Evaluation &a = made.patch(), &b = made.faces();
    EXPECT_NEAR(b.closest.max, a.closest.max, closeness * a.closest.max);
    EXPECT_NEAR(b.closest.mean, a.closest.mean, closeness * a.closest.mean);
    EXPECT_NEAR(b.path_length, a.path_length, closeness * a.path_length);
    EXPECT_FALSE(made.by_faces.listing->text.empty());
    EXPECT_NE(made.by_faces.trajectory, nullptr);
    EXPECT_EQ(made.by_faces.surface->faces().size(), 4U);
}

class JoinedFacesByGrid : public testing::TestWithParam<GridMethod> {};

TEST_P(JoinedFacesByGrid, ArePlannedAsThePatchThatTheyAre) {
    project::Project project = small_sample("dome", 8);
    project.grid.method = GetParam();
    project.grid.chain.first_iterations = 60;
    project.grid.chain.later_iterations = 20;
    expect_alike(both(project), 0.02);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod,
                         JoinedFacesByGrid,
                         testing::ValuesIn(project::every_grid_method),
                         [](const auto& method) {
                             std::string name(project::row_of(project::grid_methods(), method.param).id);
                             std::erase(name, '-');
                             return name;
                         });

class JoinedFacesByStrategy : public testing::TestWithParam<StrategyInput> {};

// Over the dome the rounds of a spiral pass so near a singular normal that rounding decides on which side.
TEST_P(JoinedFacesByStrategy, AreCutAsThePatchThatTheyAre) {
    project::Project project = small_sample(GetParam() == StrategyInput::spiral ? "sine" : "dome", 8);
    project.grid.method = GridMethod::uniform;
    project.toolpath.strategy = GetParam();
    project.toolpath.tolerance_mm = 0.5;
    project.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 10.0};
    project.tool.scallop_mm = 0.5;
    const Both made = both(project);
    expect_alike(made, 0.02);
    ASSERT_TRUE(made.by_patch.cut && made.by_faces.cut);
    EXPECT_NEAR(made.by_faces.cut->scallops.max,
                made.by_patch.cut->scallops.max,
                0.02 * made.by_patch.cut->scallops.max);
    EXPECT_NEAR(made.by_faces.cut->scallops.mean,
                made.by_patch.cut->scallops.mean,
                0.02 * made.by_patch.cut->scallops.mean);
}

INSTANTIATE_TEST_SUITE_P(EveryStrategy,
                         JoinedFacesByStrategy,
                         testing::Values(StrategyInput::zigzag,
                                         StrategyInput::iso_parametric,
                                         StrategyInput::spiral,
                                         StrategyInput::constant_scallop,
                                         StrategyInput::fewest_points),
                         [](const auto& strategy) {
                             std::string name(project::row_of(project::strategies(), strategy.param).id);
                             std::erase(name, '-');
                             return name;
                         });

TEST(JoinedFaces, LeaveNoHigherScallopsAcrossTheirBorders) {
    project::Project project = project::project_from_preset("dome");
    for (Vec3& point : project.surface.patches.at(0).points) {
        point.z() *= 0.15; // flat enough for a machine without rotary axes
    }
    project.surface.preset.clear();
    project.machine.file = "router-xyz";
    project.grid.nu = project.grid.nv = 61;
    project.toolpath.strategy = StrategyInput::constant_scallop;
    project.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 10.0};
    project.tool.scallop_mm = 0.2;
    const project::Project faces = in_four(project);
    const Plan plan = make_plan(faces, sample_folders, Progress(), Scope{.cut = true});
    EXPECT_LE(plan.cut->scallops.max, 1.03 * project.tool.scallop_mm);
    EXPECT_GT(plan.cut->scallops.max, 0.9 * project.tool.scallop_mm);
    EXPECT_LT(plan.cut->scallops.not_cut, 1e-9);
    EXPECT_LT(plan.cut->deepest, 0.005);
}

// The blocks of the program through the forward kinematics, and from there to the patch that has no border.
TEST(JoinedFaces, ErrorsAreThoseThatAnIndependentOracleFinds) {
    project::Project project = small_sample("two-bell", 8);
    project.grid.method = GridMethod::uniform;
    const geometry::BezierPatch whole(project.surface.patches.at(0));
    const geometry::ClosestPointSearch search(whole);
    const project::Project faces = in_four(project);
    const Plan plan = make_plan(faces, sample_folders, Progress(), Scope::program);
    const Evaluation& path = *plan.program_path(faces);
    constexpr int looks = 400;
    double most = 0.0;
    kinematics::AxisPositions at = plan.program->start;
    for (const program::Block& block : plan.program->blocks) {
        for (int n = 0; n <= looks && block.role == program::MoveRole::cut; ++n) {
            const double t = static_cast<double>(n) / looks;
            const geometry::ToolPose pose =
                kinematics::forward(plan.cutting_setup->machine, at + t * (block.target - at));
            most = std::max(most, search.closest(pose.tip).distance);
        }
        at = block.moves() ? block.target : at;
    }
    EXPECT_GT(most, 0.1);
    EXPECT_NEAR(path.closest.max, most, 1e-3 * most);
}

TEST(JoinedFaces, AreJoinedAgainOnlyForOtherFaces) {
    Derivation derivation;
    project::Project project = in_four(small_sample("dome", 6));
    project.grid.method = GridMethod::uniform;
    const auto joined = [&] {
        Plan last;
        derivation.derive(
            project, sample_folders, Scope{}, [&](const Publication& now) { last = now.plan; }, {});
        return last;
    };
    const Plan first = joined();
    ASSERT_NE(first.joined, nullptr);
    project.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 8.0};
    project.surface.flipped = true;
    const Plan second = joined();
    EXPECT_EQ(second.joined, first.joined);
    EXPECT_NE(second.cutting_setup, first.cutting_setup);
    project.surface.joined->faces[0].number = 9;
    EXPECT_NE(joined().joined, first.joined);
    project.surface = project::project_from_preset("dome").surface;
    EXPECT_EQ(joined().joined, nullptr);
}

TEST(JoinedFaces, AreCancelledWhileTheyAreJoined) {
    std::stop_source stop;
    int reports = 0;
    const Progress progress(
        [&](const Progress::Report&) {
            if (++reports == 3) {
                stop.request_stop();
            }
        },
        stop.get_token());
    EXPECT_THROW((void)project::joined_region(*in_four(small_sample("dome", 6)).surface.joined, progress),
                 Cancelled);
}

TEST(JoinedFaces, WhyTheyCannotBeJoinedIsWhyThereIsNoPlan) {
    project::Project project = in_four(small_sample("dome", 6));
    for (Vec3& point : project.surface.joined->faces[3].face.net.points) {
        point.z() += 0.2;
    }
    try {
        (void)make_plan(project, sample_folders, Progress());
        FAIL() << "planned";
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message, testing::HasSubstr("faces 2 and 4"));
        EXPECT_THAT(error.diagnostic().message, testing::HasSubstr("apart"));
    }
}

TEST(JoinedFaces, AreAllLookedAtByTheChecks) {
    project::Project project = small_sample("dome", 6);
    project.grid.method = GridMethod::uniform;
    const Both made = both(project);
    const PartSurface by_patch = part_surface(*made.by_patch.cutting_setup);
    const PartSurface by_faces = part_surface(*made.by_faces.cutting_setup);
    const auto area = [](const PartSurface& part) {
        double sum = 0.0;
        for (const simulation::PartPoint& point : part.points) {
            sum += point.area;
        }
        return sum;
    };
    EXPECT_NEAR(area(by_faces), area(by_patch), 1e-3 * area(by_patch));
    const auto bodies =
        face_bodies(made.by_faces.cutting_setup->machine, made.of_faces.surface, *made.by_faces.surface);
    EXPECT_EQ(bodies.size(), 4U) << "each is a part that is cut, none another face";
    for (const simulation::CollisionBody& body : bodies) {
        EXPECT_EQ(body.role, simulation::BodyRole::cut_faces);
    }
}

TEST(JoinedFaces, AreTurnedAndPlacedTogether) {
    project::Project project = in_four(small_sample("dome", 6));
    const toolpath::SetUpPlace place(10.0, -5.0, 3.0, 0.5);
    const project::Project placed = with_set_up(project, place);
    const Vec3 before = project::machined_region(project.surface).position(0.3, 0.7);
    const Vec3 after = project::machined_region(placed.surface).position(0.3, 0.7);
    EXPECT_LT((after - Eigen::AngleAxisd(0.5, Vec3::UnitZ()) * before).norm(), 1e-6);
}

} // namespace
} // namespace millwright::plan
