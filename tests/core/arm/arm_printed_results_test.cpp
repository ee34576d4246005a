// The sample results of Saengsasri, Nittayachin 1996: its program took one link for the other in the angle of
// joint 2. With that fault all 93 records come out to the last printed digit; without it the arm gets there.
#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "tests/support/arms.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace millwright::arm {
namespace {

struct Record {
    double x, z, printed2, printed3, printed4, right2, right4, real_x, real_z, error;
};

std::vector<Record> records(const std::string& name) {
    std::ifstream file("tests/golden/arm/" + name);
    std::vector<Record> found;
    for (std::string line; std::getline(file, line);) {
        Record r{};
        std::istringstream text(line);
        if (line[0] != '#' && text >> r.x >> r.z >> r.printed2 >> r.printed3 >> r.printed4 >> r.right2 >>
                                  r.right4 >> r.real_x >> r.real_z >> r.error) {
            found.push_back(r);
        }
    }
    return found;
}

/// Angles 2 to 4 in degrees as the printed program finds them; the tool axis stays upright.
Vec3 printed_program(double x, double z) {
    constexpr double l2 = 650.0, l3 = 800.0;
    const double c3 = (x * x + z * z - l2 * l2 - l3 * l3) / (2.0 * l2 * l3);
    const double s3 = std::sqrt(1.0 - c3 * c3);
    const double t2 = -std::atan2(z, x) - std::atan2(l2 * s3, l2 + l3 * c3); // l2 for l3
    const double t3 = std::atan2(s3, c3);
    return Vec3(t2, t3, -t2 - t3) * to_degrees(1.0);
}

/// The positions that the printed program gave itself: along each way in steps of u, in single precision.
std::vector<Vec2> positions(double step) {
    std::vector<Vec2> found;
    Vec2 from(800.0, 650.0);
    for (const Vec2& way : {Vec2(300.0, 0.0), Vec2(0.0, -100.0), Vec2(-300.0, 100.0)}) {
        const Vec2 to = from + way;
        const double du = step / std::ceil(way.norm());
        for (double u = 0.0; u <= 1.0; u += du) {
            found.push_back((from + u * way).cast<float>().cast<double>());
        }
        if (found.back() != to) {
            found.push_back(to);
        }
        from = to;
    }
    return found;
}

class PrintedResultsK3 : public ::testing::TestWithParam<std::tuple<const char*, double, std::size_t>> {};

TEST_P(PrintedResultsK3, ComeOutWithTheFaultOfThePrintedProgram) {
    const auto [name, step, count] = GetParam();
    const std::vector<Record> printed = records(name);
    const std::vector<Vec2> at = positions(step);
    ASSERT_EQ(printed.size(), count);
    ASSERT_EQ(at.size(), count);
    for (std::size_t n = 0; n < count; ++n) {
        const Vec3 angles = printed_program(at[n].x(), at[n].y());
        EXPECT_NEAR(at[n].x(), printed[n].x, 5.01e-6);
        EXPECT_NEAR(at[n].y(), printed[n].z, 5.01e-6);
        EXPECT_NEAR(angles[0], printed[n].printed2, 5.01e-6);
        EXPECT_NEAR(angles[1], printed[n].printed3, 5.01e-6);
        EXPECT_NEAR(angles[2], printed[n].printed4, 5.01e-6);
    }
}

TEST_P(PrintedResultsK3, AreSetRightByTheInverse) {
    const ArmModel arm = test::arm("motoman-l3");
    for (const Record& r : records(std::get<0>(GetParam()))) {
        const kinematics::InverseSolution found =
            arm_inverse(arm, PointedGoal{{r.x, 0.0, r.z}, Vec3::UnitZ()}, JointPositions::Zero(5));
        ASSERT_FALSE(found.branches.empty()) << found.why;
        const JointPositions& q = found.branches.front();
        EXPECT_NEAR(to_degrees(q[1]), r.right2, 1.1e-5);
        EXPECT_NEAR(to_degrees(q[2]), r.printed3, 1.1e-5);
        EXPECT_NEAR(to_degrees(q[3]), r.right4, 1.1e-5);
        EXPECT_LT((base_T_tool(arm, q).translation() - Vec3(r.x, 0.0, r.z)).norm(), 1e-9);
        const Frame printed = base_T_tool(arm, test::degrees({0.0, r.printed2, r.printed3, r.printed4, 0.0}));
        EXPECT_NEAR(printed.translation().x(), r.real_x, 1.1e-3);
        EXPECT_NEAR(printed.translation().z(), r.real_z, 1.1e-3);
        EXPECT_NEAR((printed.translation() - Vec3(r.x, 0.0, r.z)).norm(), r.error, 1.1e-3);
    }
}

INSTANTIATE_TEST_SUITE_P(Paths,
                         PrintedResultsK3,
                         ::testing::Values(std::tuple("path-10.txt", 10.0, std::size_t{75}),
                                           std::tuple("path-50.txt", 50.0, std::size_t{18})));

} // namespace
} // namespace millwright::arm
