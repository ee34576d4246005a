#include "core/kinematics/machine_solids.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/machines.h"

#include <gtest/gtest.h>

#include <set>

namespace millwright::kinematics {
namespace {

/// Six times the volume that the triangles enclose, if they enclose one.
double six_volumes(const geometry::SolidMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](int n) { return mesh.positions[static_cast<std::size_t>(n)]; };
        sum += at(a).dot(at(b).cross(at(c)));
    }
    return sum;
}

double volume_of(const MachineBody& body) {
    const double box = body.size.prod();
    return body.shape == MachineBody::Shape::box ? box : box * 0.25 * 3.14159265358979;
}

class MachineSolids : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(OfEachMachine,
                         MachineSolids,
                         ::testing::Values("ac-table",
                                           "bc-table-head",
                                           "ca-head",
                                           "forming-table",
                                           "rotary-tilt-listing",
                                           "router-xyz",
                                           "tilted-c-table"));

TEST_P(MachineSolids, AreWhatShips) {
    const std::string file = std::string("assets/machines/") + GetParam() + ".glb";
    const MachineModel machine = test::machine(GetParam());
    EXPECT_EQ(read_file(file), geometry::glb_of(machine_solids(machine), machine.name()))
        << "made anew by: build/release/millwright machine bodies " << GetParam() << " --out " << file;
}

TEST_P(MachineSolids, FillTheBodiesOfTheFile) {
    const MachineModel machine = test::machine(GetParam());
    double wanted = 0.0;
    for (const MachineBody& body : machine.description().bodies) {
        wanted += volume_of(body);
    }
    double found = 0.0;
    std::set<std::string> names;
    for (const geometry::PlacedBody& placed : machine_solids(machine)) {
        EXPECT_TRUE(names.insert(placed.body.name).second);
        for (const geometry::SolidMesh& mesh : placed.body.meshes) {
            const double volume = six_volumes(mesh) / 6.0;
            EXPECT_GT(volume, 0.0) << "the outside is outside";
            found += volume;
        }
    }
    EXPECT_LT(found, wanted);
    EXPECT_GT(found, 0.93 * wanted) << "less the broken edges alone";
}

TEST_P(MachineSolids, LieInsideTheBodiesOfTheirCarrier) {
    const MachineModel machine = test::machine(GetParam());
    for (const geometry::PlacedBody& placed : machine_solids(machine)) {
        const char carrier = placed.body.name == "base" ? '\0' : placed.body.name.back();
        std::size_t mesh = 0;
        for (const MachineBody& body : machine.description().bodies) {
            if (body.carried_by != carrier) {
                continue;
            }
            const double reach = 0.5 * body.size.norm();
            for (const Vec3& point : placed.body.meshes.at(mesh).positions) {
                EXPECT_LE((point - body.center).norm(), reach);
            }
            ++mesh;
        }
        EXPECT_EQ(mesh, placed.body.meshes.size());
    }
}

TEST_P(MachineSolids, AreReadForTheViewFromTheFileThatTheMachineNames) {
    const std::filesystem::path file = std::string("assets/machines/") + GetParam() + ".json";
    const MachineModel machine = test::machine(GetParam());
    const auto read = read_machine_solids(file, machine);
    ASSERT_NE(read, nullptr);
    const std::vector<geometry::PlacedBody> made = machine_solids(machine);
    ASSERT_EQ(read->size(), made.size());
    for (std::size_t n = 0; n < made.size(); ++n) {
        EXPECT_EQ((*read)[n].name, made[n].body.name);
        EXPECT_EQ((*read)[n].meshes.size(), made[n].body.meshes.size());
        const char carrier = carrier_of((*read)[n]);
        EXPECT_EQ(made[n].body.name, carrier == '\0' ? "base" : std::string("axis ") + carrier);
    }
}

TEST(MachineSolidsFile, NamesNoneOrWhatIsWrongWithIt) {
    const MachineModel machine = test::machine("ac-table");
    EXPECT_EQ(read_machine_solids("assets/machines/rotary-tilt-gui.json", machine), nullptr);
    try { // C and A in a head are no axes of a router
        (void)read_machine_solids("assets/machines/ca-head.json", test::machine("router-xyz"));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(to_text(error.diagnostic()).find("ca-head.glb"), std::string::npos);
        EXPECT_NE(to_text(error.diagnostic()).find("no axis matches the body 'axis "), std::string::npos);
    }
}

} // namespace
} // namespace millwright::kinematics
