// Several exact faces as the surface of a project: in the file, checked, turned with the part.
#include "core/base/error.h"
#include "core/project/project_file.h"
#include "core/project/reshaped_surface.h"
#include "core/project/surface.h"
#include "tests/support/faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace millwright::project {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The dome in four faces, numbered as in a file that has others before them.
Project with_joined() {
    Project project = project_from_preset("dome");
    project.surface = {};
    project.surface.joined.emplace();
    for (const geometry::BezierPatch& patch : test::quarters(test::patch_of("dome"), 0.5, 0.5)) {
        const int number = 7 + static_cast<int>(project.surface.joined->faces.size());
        project.surface.joined->faces.push_back({number, {test::net_of(patch), {}}});
    }
    return project;
}

std::string fault_reading(const std::string& text) {
    try {
        (void)project_from_text(text, "part.json");
    } catch (const Error& error) {
        return error.diagnostic().message;
    }
    return "taken";
}

std::string with_text(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(JoinedInput, ComesBackToTheLastBit) {
    Project project = with_joined();
    EXPECT_EQ(faults_of(project), std::vector<std::string>());
    EXPECT_EQ(project_from_text(project_text(project), "part.json"), project);
    project.surface.joined->corners = {
        Vec3(1.0 / 3.0, 0, 0), Vec3(100, 0, 0), Vec3(100, 100, 0), Vec3(0, 100, 0)};
    project.surface.flipped = true;
    EXPECT_EQ(project_from_text(project_text(project), "part.json"), project);
}

TEST(JoinedInput, FacesWithoutNumbersAreNumberedByTheirPlaces) {
    std::string text = project_text(with_joined());
    for (int number = 7; number <= 10; ++number) {
        text = with_text(text, "\"number\": " + std::to_string(number) + ",", "");
    }
    const Project read = project_from_text(text, "part.json");
    for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_EQ(read.surface.joined->faces[n].number, static_cast<int>(n) + 1);
    }
}

TEST(JoinedInput, IsRefusedAtItsPlace) {
    const std::string text = project_text(with_joined());
    EXPECT_THAT(fault_reading(with_text(text, "\"flipped\"", "\"machined_patch\": 0, \"flipped\"")),
                HasSubstr("machined_patch"));
    EXPECT_THAT(fault_reading(with_text(text, "\"number\": 8", "\"number\": 0")),
                HasSubstr("surface/joined/faces[1]/number"));
    EXPECT_THAT(fault_reading(with_text(text, "\"number\": 9", "\"size\": 9")), HasSubstr("faces[2]"));
    EXPECT_THAT(fault_reading(with_text(text,
                                        "\"number\": 10,",
                                        "\"number\": 10, \"trim\": [[[0.1, 0.1], [0.9, 0.1], [0.9, 0.9]]],")),
                HasSubstr("surface/joined/faces[3]/trim: a face that is trimmed cannot be joined"));
    Project one = with_joined();
    one.surface.joined->faces.resize(1);
    EXPECT_THAT(faults_of(one), ElementsAre(HasSubstr("surface/joined/faces: 2 to 200 faces")));
    nlohmann::json json = nlohmann::json::parse(text);
    json["surface"]["joined"]["faces"].erase(1);
    json["surface"]["joined"]["faces"].erase(1);
    json["surface"]["joined"]["faces"].erase(1);
    EXPECT_THAT(fault_reading(json.dump()), HasSubstr("2 to 200 faces can be joined, not 1"));
}

TEST(JoinedInput, ItsFaultsNameTheFace) {
    Project far = with_joined();
    far.surface.joined->faces[2].face.net.points[0].x() = 2e5;
    EXPECT_THAT(faults_of(far),
                ElementsAre(HasSubstr("surface/joined/faces[2]: a control point is farther")));
    Project trimmed = with_joined();
    trimmed.surface.joined->faces[1].face.trim.loops = {{{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}}};
    EXPECT_THAT(faults_of(trimmed), ElementsAre(HasSubstr("surface/joined/faces[1]/trim")));
    Project both = with_joined();
    both.surface.face = both.surface.joined->faces[0].face;
    EXPECT_THAT(faults_of(both), ElementsAre(HasSubstr("take the place of preset, patches and face")));
    Project corner = with_joined();
    corner.surface.joined->corners = {Vec3(2e5, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    EXPECT_THAT(faults_of(corner), ElementsAre(HasSubstr("surface/joined/corners")));
}

TEST(JoinedInput, TurnsWithThePart) {
    Project project = with_joined();
    project.surface.joined->corners = {Vec3(1, 2, 3), Vec3(100, 0, 0), Vec3(100, 100, 0), Vec3(0, 100, 0)};
    const SurfaceInput turned = with_turn(project.surface, {0, 0, 90});
    const Vec3 before = project.surface.joined->faces[3].face.net.points[2];
    EXPECT_EQ(turned.joined->faces[3].face.net.points[2], Vec3(-before.y(), before.x(), before.z()));
    EXPECT_EQ((*turned.joined->corners)[0], Vec3(-2, 1, 3));
    EXPECT_THROW((void)with_degrees(project.surface, 0, 4, 4), Error);
}

TEST(JoinedInput, IsAllOfItsFacesAsASurfaceAndOneRegion) {
    const Project project = with_joined();
    EXPECT_EQ(surface_of(project.surface).parts().size(), 4U);
    const region::Region region = machined_region(project.surface);
    EXPECT_EQ(region.face_count(), 4);
    const geometry::BezierPatch dome = test::patch_of("dome");
    EXPECT_LT((region.position(0.3, 0.7) - dome.position(0.3, 0.7)).norm(), 1e-3);
}

TEST(JoinedInput, FacesThatDoNotTouchAreNamedByTheirNumbers) {
    Project project = with_joined();
    project.surface.joined->faces.erase(project.surface.joined->faces.begin() + 1,
                                        project.surface.joined->faces.begin() + 3);
    for (Vec3& point : project.surface.joined->faces[1].face.net.points) {
        point.x() += 40.0;
    }
    try {
        (void)machined_region(project.surface);
        FAIL() << "joined";
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message, HasSubstr("faces 7 and 10"));
    }
}

} // namespace
} // namespace millwright::project
