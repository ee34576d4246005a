#include "core/geometry/glb.h"

#include "core/base/error.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace millwright::geometry {
namespace {

using ::testing::HasSubstr;

std::vector<PlacedBody> two_bodies() {
    PlacedBody first{{"foot", {}}, Frame::Identity()};
    first.body.meshes.push_back(
        hull_of(std::vector<Circle>{{{10.0, 0.0}, 20.0}}, {0.0, 30.0, 1.0}, Vec3(0.2, 0.5, 0.9)));
    PlacedBody second = first;
    second.body.name = "head";
    second.body.meshes.push_back(
        hull_of(std::vector<Circle>{{{0.0, 0.0}, 5.0}}, {0.0, 5.0, 1.0}, Vec3(1.0, 0.0, 0.3)));
    second.at_rest.translation() = Vec3(0.0, 0.0, 400.0);
    return {first, second};
}

std::string reason(const std::string& bytes) {
    try {
        (void)parse_glb(bytes, "arm.glb");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "none";
}

/// A glb of this JSON and no binary part.
std::string glb_with(std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::uint32_t value) {
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &value, 4);
        return bytes;
    };
    const auto size = static_cast<std::uint32_t>(json.size());
    return "glTF" + word(2) + word(20 + size) + word(size) + "JSON" + json;
}

std::string replaced(std::string bytes, const std::string& what, const std::string& by) {
    const auto at = bytes.rfind(what); // the node's, not the mesh's of the same name
    EXPECT_NE(at, std::string::npos) << what;
    EXPECT_EQ(what.size(), by.size());
    return bytes.replace(at, what.size(), by);
}

// Viewers compare the bounds with what is in the file: 0.18 is not the float that is next to it.
TEST(Glb, BoundsAreThoseOfTheFloatsInTheFile) {
    const std::string bytes = glb_of(two_bodies(), "arm");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof(length));
    const nlohmann::json header = nlohmann::json::parse(bytes.substr(20, length));
    int bounds = 0;
    for (const nlohmann::json& accessor : header.at("accessors")) {
        for (const char* side : {"min", "max"}) {
            for (const double value : accessor.value(side, std::vector<double>())) {
                EXPECT_EQ(value, static_cast<double>(static_cast<float>(value))) << side;
                ++bounds;
            }
        }
    }
    EXPECT_GE(bounds, 12);
}

TEST(Glb, BringsBackWhatWasWritten) {
    const std::vector<PlacedBody> written = two_bodies();
    const std::vector<SolidBody> read = parse_glb(glb_of(written, "arm"), "arm.glb");
    ASSERT_EQ(read.size(), 2U);
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_EQ(read[n].name, written[n].body.name);
        ASSERT_EQ(read[n].meshes.size(), written[n].body.meshes.size());
        for (std::size_t m = 0; m < read[n].meshes.size(); ++m) {
            const SolidMesh &a = read[n].meshes[m], &b = written[n].body.meshes[m];
            ASSERT_EQ(a.positions.size(), b.positions.size());
            EXPECT_EQ(a.triangles, b.triangles);
            EXPECT_LT((a.color - b.color).norm(), 1e-3);
            for (std::size_t k = 0; k < a.positions.size(); ++k) {
                EXPECT_LT((a.positions[k] - b.positions[k]).norm(), 1e-5); // floats of metres
                EXPECT_LT((a.normals[k] - b.normals[k]).norm(), 1e-6);
            }
        }
    }
}

TEST(Glb, GivesTheSameBytesTwice) {
    EXPECT_EQ(glb_of(two_bodies(), "arm"), glb_of(two_bodies(), "arm"));
}

TEST(Glb, RefusesWhatIsNone) {
    EXPECT_THAT(reason("solid stl"), HasSubstr("arm.glb: this is not a binary glTF file"));
    EXPECT_THAT(reason(glb_with("{")), HasSubstr("damaged"));
    const std::string whole = glb_of(two_bodies(), "arm");
    EXPECT_THAT(reason(whole.substr(0, whole.size() / 2)), HasSubstr("damaged"));
}

TEST(Glb, OpensNoOtherFile) {
    const test::ScratchFolder folder;
    const std::filesystem::path other = folder.path() / "other.bin";
    std::ofstream(other) << "8 bytes.";
    const std::string elsewhere =
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":8,"uri":")" + other.string() + R"("}]})";
    EXPECT_THAT(reason(glb_with(elsewhere)), HasSubstr("damaged"));
}

TEST(Glb, RefusesTrianglesThatCannotBe) {
    const std::string good = glb_of(two_bodies(), "arm");
    EXPECT_THAT(reason(replaced(good, "\"name\":\"head\"", "\"name\":\"foot\"")),
                HasSubstr("another one has the same name"));
    const auto mesh =
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"name":"x"}],"meshes":[{"primitives":[)";
    EXPECT_THAT(reason(glb_with(std::string(mesh) + R"({"attributes":{"NORMAL":0}}]}]})")),
                HasSubstr("node 'x': its triangles have no positions"));
    EXPECT_THAT(reason(glb_with(std::string(mesh) + R"({"attributes":{"POSITION":7}}]}]})")),
                HasSubstr("node 'x': accessor 7 does not exist"));
    EXPECT_THAT(reason(glb_with(std::string(mesh) + R"({"mode":1,"attributes":{"POSITION":7}}]}]})")),
                HasSubstr("node 'x': only triangles"));
}

TEST(Glb, RefusesNumbersOutsideOfTheFile) {
    std::string bytes = glb_of(two_bodies(), "arm");
    const auto at = bytes.find("\"count\":");
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at + 8, 1, "9"); // as many digits as before, but too many points
    EXPECT_THAT(reason(bytes),
                ::testing::AnyOf(HasSubstr("outside the file"),
                                 HasSubstr("numbers of normals and positions differ"),
                                 HasSubstr("corner that does not exist")));
}

} // namespace
} // namespace millwright::geometry
