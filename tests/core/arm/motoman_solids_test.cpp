#include "core/arm/arm_bodies.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

namespace millwright::arm {
namespace {

TEST(MotomanSolids, AreWhatShips) {
    const ArmFile file = read_arm("assets/arms/motoman-l3.json");
    const MotomanSolids made = motoman_solids(file.arm, *file.actuators);
    EXPECT_EQ(read_file(file.bodies->file), geometry::glb_of(made.bodies, file.arm.name()))
        << "made anew by: build/release/millwright arm bodies --out assets/arms/motoman-l3.glb";
    ASSERT_EQ(made.parts.size(), file.bodies->parts.size());
    for (std::size_t n = 0; n < made.parts.size(); ++n) {
        EXPECT_EQ(made.parts[n].node, file.bodies->parts[n].node);
        EXPECT_EQ(made.parts[n].carrier, file.bodies->parts[n].carrier);
        EXPECT_EQ(made.parts[n].number, file.bodies->parts[n].number);
    }
}

TEST(MotomanSolids, ReachFromAxisToAxis) {
    const ArmFile file = read_arm("assets/arms/motoman-l3.json");
    for (const geometry::PlacedBody& placed : motoman_solids(file.arm, *file.actuators).bodies) {
        Box3 box;
        for (const auto& mesh : placed.body.meshes) {
            for (const Vec3& point : mesh.positions) {
                ASSERT_TRUE(is_finite(point));
                box.extend(point);
            }
        }
        if (placed.body.name == "upper arm") {
            EXPECT_LT(box.min().x(), 0.0);
            EXPECT_GT(box.max().x(), 650.0);
        } else if (placed.body.name == "forearm") {
            EXPECT_LT(box.min().x(), -250.0); // its lever
            EXPECT_GT(box.max().x(), 800.0);
        }
    }
}

TEST(MotomanSolids, AreForArmsOfThatKind) {
    const ArmFile file = read_arm("assets/arms/motoman-l3.json");
    EXPECT_THROW((void)motoman_solids(test::arm("scara"), *file.actuators), Error);
}

} // namespace
} // namespace millwright::arm
