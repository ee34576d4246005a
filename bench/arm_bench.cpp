// The arm's kinematics beside Orocos KDL's, in one run.
#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "tests/support/arms.h"
#include "tests/support/kdl_arm.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace millwright {
namespace {

using arm::JointPositions;

struct Poses {
    arm::ArmModel arm = test::arm("motoman-l3");
    std::vector<JointPositions> joints;
    std::vector<Frame> goals;

    Poses() {
        std::mt19937 random(1);
        for (int n = 0; n < 1024; ++n) {
            joints.push_back(test::random_joints(random, arm, 0.6));
            goals.push_back(arm::base_T_tool(arm, joints.back()));
        }
    }
    [[nodiscard]] std::size_t next() { return at_++ % joints.size(); }

private:
    std::size_t at_ = 0;
};

void forward(benchmark::State& state) {
    Poses poses;
    for (auto _ : state) {
        benchmark::DoNotOptimize(arm::base_T_tool(poses.arm, poses.joints[poses.next()]));
    }
}
void forward_kdl(benchmark::State& state) {
    Poses poses;
    test::KdlArm kdl(poses.arm);
    for (auto _ : state) {
        benchmark::DoNotOptimize(kdl.forward(poses.joints[poses.next()]));
    }
}
void jacobian(benchmark::State& state) {
    Poses poses;
    for (auto _ : state) {
        benchmark::DoNotOptimize(arm::arm_jacobian(poses.arm, poses.joints[poses.next()]));
    }
}
void jacobian_kdl(benchmark::State& state) {
    Poses poses;
    test::KdlArm kdl(poses.arm);
    for (auto _ : state) {
        benchmark::DoNotOptimize(kdl.jacobian(poses.joints[poses.next()]));
    }
}
void inverse_all_branches(benchmark::State& state) {
    Poses poses;
    for (auto _ : state) {
        const std::size_t n = poses.next();
        benchmark::DoNotOptimize(arm::arm_inverse(poses.arm, poses.goals[n], poses.joints[n]));
    }
}
/// One solution, from 0.1 rad beside it.
void inverse_kdl(benchmark::State& state) {
    Poses poses;
    test::KdlArm kdl(poses.arm);
    for (auto _ : state) {
        const std::size_t n = poses.next();
        const JointPositions start = poses.joints[n].array() + 0.1;
        benchmark::DoNotOptimize(kdl.inverse(poses.goals[n], start));
    }
}

BENCHMARK(forward);
BENCHMARK(forward_kdl);
BENCHMARK(jacobian);
BENCHMARK(jacobian_kdl);
BENCHMARK(inverse_all_branches);
BENCHMARK(inverse_kdl);

} // namespace
} // namespace millwright
