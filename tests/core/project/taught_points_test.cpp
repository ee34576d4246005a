#include "core/project/taught_points.h"

#include "core/base/error.h"
#include "core/project/project.h"
#include "core/project/project_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace millwright::project {
namespace {

using testing::HasSubstr;

std::vector<TaughtPoint> three() {
    return {{"Home", {0.0, -90.0, 90.0, 0.0, 0.0}, false, 100.0},
            {"Above", {10.25, -80.0, 70.0, 5.0, 0.0}, true, 12.5},
            {"At \"it\"", {10.25, -75.0, 70.0, 5.0, -360.0}, true, 0.1}};
}

std::string taught_points_refusal(const std::string& text) {
    try {
        (void)taught_points_from_text(text, "points.json");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "";
}

TEST(TaughtPointsC6, AFileGivesBackWhatWasSaved) {
    EXPECT_EQ(taught_points_from_text(taught_points_text(three()), "points.json"), three());
    EXPECT_EQ(taught_points_from_text(taught_points_text({}), "points.json"), std::vector<TaughtPoint>{});
}

TEST(TaughtPointsC6, AProjectKeepsPointsProgramAndPlace) {
    Project project = project_from_preset("dome");
    project.arm.points = three();
    project.arm.program = "LINEAR\n\tX10 ; \"there\"\n";
    project.arm.motion_file = "G1 X300 ;\nG1 Z-100 ;\n";
    project.arm.path = {{1.5, -2.0, 3.0}, {0.0, 90.0, -45.0}};
    EXPECT_EQ(project_from_text(project_text(project), "p.json"), project);
    Project without = project_from_preset("dome");
    EXPECT_THAT(project_text(without), testing::Not(HasSubstr("\"arm\"")));
}

TEST(ProcessorInput, AProjectKeepsAssemblerTextAndMicroprogram) {
    Project project = project_from_preset("dome");
    EXPECT_THAT(project_text(project), testing::Not(HasSubstr("\"processor\"")));
    project.processor = {".format q12.20\n\tHLT ; \"there\"\n", "FETCH: CONT | read_program\n"};
    EXPECT_EQ(project_from_text(project_text(project), "p.json"), project);
}

TEST(TaughtPointsC6, WhatIsWrongIsToldWithItsPlace) {
    const std::string head = "{\"format\": \"millwright-arm-points\", \"version\": 1,\n\"points\": [";
    const auto point = [](const std::string& name, const std::string& rest) {
        return "\n{\"name\": \"" + name + "\", " + rest + "}";
    };
    const std::string sound = "\"joints_deg\": [1, 2], \"straight\": false, \"speed_percent\": 50";
    EXPECT_EQ(taught_points_refusal(head + point("A", sound) + "]}"), "");
    EXPECT_THAT(taught_points_refusal(head + point("A", sound) + "," + point("A", sound) + "]}"),
                HasSubstr("points.json:4:"));
    EXPECT_THAT(taught_points_refusal(head + point("", sound) + "]}"), HasSubstr("has no name"));
    EXPECT_THAT(
        taught_points_refusal(
            head + point("A", "\"joints_deg\": [], \"straight\": false, \"speed_percent\": 50") + "]}"),
        HasSubstr("invalid joint values"));
    EXPECT_THAT(
        taught_points_refusal(
            head + point("A", "\"joints_deg\": [1], \"straight\": false, \"speed_percent\": 500") + "]}"),
        HasSubstr("points.json:3:"));
    EXPECT_THAT(taught_points_refusal("{\"format\": \"millwright\", \"version\": 1, \"points\": []}"),
                HasSubstr("not a file of taught points"));
}

TEST(TaughtPointsC6, WhatIsNoNumberReachesNoFile) {
    std::vector<TaughtPoint> points = three();
    points[1].joints_deg[2] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)taught_points_text(points), Error);
    EXPECT_EQ(faults_of(points).size(), 1U);
}

TEST(TaughtPointsC6, ANewPointHasANameOfItsOwn) {
    EXPECT_EQ(free_point_name(three()), "Point 1");
    EXPECT_EQ(free_point_name({{"Point 1", {1.0}, false, 1.0}, {"Point 3", {1.0}, false, 1.0}}), "Point 2");
}

TEST(PathPlaceOfAnArm, IsTurnedAboutTheFixedAxesInTheirOrderAndThenMoved) {
    const Frame frame = base_T_path({{100.0, 20.0, 3.0}, {90.0, 0.0, 90.0}});
    // X up: z of the part is first turned to -y, then that to x
    EXPECT_LT((frame * Vec3(0.0, 0.0, 1.0) - Vec3(101.0, 20.0, 3.0)).norm(), 1e-12);
    EXPECT_LT((frame * Vec3(1.0, 0.0, 0.0) - Vec3(100.0, 21.0, 3.0)).norm(), 1e-12);
}

} // namespace
} // namespace millwright::project
