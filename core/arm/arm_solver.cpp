#include "core/arm/arm_solver.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::arm {

namespace {

using Error6 = Eigen::Matrix<double, 6, 1>;

/// What is left to do: rows 0-2 mm, rows 3-5 a rotation vector in the base's frame, rad.
Error6 error_of(const Frame& now, const Frame& goal, ArmDemand demand) {
    Error6 error = Error6::Zero();
    error.head<3>() = goal.translation() - now.translation();
    if (demand == ArmDemand::frame) {
        const Eigen::AngleAxisd turn(Mat3(goal.linear() * now.linear().transpose()));
        error.tail<3>() = turn.angle() * turn.axis();
    } else if (demand == ArmDemand::tip_and_axis) {
        const Vec3 from = now.linear().col(2), to = goal.linear().col(2);
        const Vec3 across = from.cross(to);
        const double sine = across.norm();
        const double angle = std::atan2(sine, from.dot(to));
        error.tail<3>() = sine > 0.0 ? Vec3(angle / sine * across) : Vec3(angle * from.unitOrthogonal());
    }
    return error;
}

/// The rows of the Jacobian that move what is demanded.
ArmJacobian demanded(ArmJacobian jacobian, const Frame& now, ArmDemand demand) {
    if (demand == ArmDemand::tip) {
        jacobian.bottomRows<3>().setZero();
    } else if (demand == ArmDemand::tip_and_axis) { // a turn about the tool axis does not count
        const Vec3 axis = now.linear().col(2);
        const Mat3 across = Mat3::Identity() - axis * axis.transpose();
        jacobian.bottomRows<3>() = (across * jacobian.bottomRows<3>()).eval();
    }
    return jacobian;
}

JointPositions held_inside(const ArmModel& arm, JointPositions positions) {
    for (int n = 0; n < arm.joint_count(); ++n) {
        positions[n] = std::clamp(positions[n], arm.joint(n).min, arm.joint(n).max);
    }
    return positions;
}

class Solver {
public:
    Solver(const ArmModel& arm, const Frame& goal, ArmDemand demand, const ArmSolverSettings& settings)
        : arm_(arm), goal_(goal), demand_(demand), settings_(settings),
          length_(std::max(stretched_length(arm), 1.0)) {}

    [[nodiscard]] ArmSolverResult from(const JointPositions& start) {
        move_to(held_inside(arm_, start));
        double damping = 1e-3;
        int iteration = 0;
        for (; iteration < settings_.most_iterations && !met(); ++iteration) {
            const JointPositions tried = step(damping);
            const double before = cost_;
            const JointPositions back = positions_;
            move_to(tried);
            if (cost_ < before) {
                damping = std::max(0.2 * damping, 1e-15);
            } else {
                move_to(back);
                damping *= 8.0;
                if (damping > 1e6) {
                    break; // no direction makes it better
                }
            }
        }
        return {positions_, met(), error_.head<3>().norm(), error_.tail<3>().norm(), iteration};
    }

private:
    void move_to(const JointPositions& positions) {
        positions_ = positions;
        now_ = base_T_tool(arm_, positions_);
        error_ = error_of(now_, goal_, demand_);
        cost_ = scaled(error_).squaredNorm();
    }
    [[nodiscard]] bool met() const {
        return error_.head<3>().norm() <= settings_.tip_tolerance &&
               error_.tail<3>().norm() <= settings_.angle_tolerance;
    }
    /// Lengths in units of the arm's own.
    [[nodiscard]] Error6 scaled(Error6 error) const {
        error.head<3>() /= length_;
        error.tail<3>() *= settings_.angle_weight;
        return error;
    }
    /// A joint at a limit that it should go beyond is taken out of the step.
    [[nodiscard]] JointPositions step(double damping) const {
        ArmJacobian jacobian = demanded(arm_jacobian(arm_, positions_), now_, demand_);
        jacobian.topRows<3>() /= length_;
        jacobian.bottomRows<3>() *= settings_.angle_weight;
        for (int n = 0; n < arm_.joint_count(); ++n) {
            if (arm_.joint(n).kind == JointKind::prismatic) {
                jacobian.col(n) *= length_; // so that a unit of each joint counts as much
            }
        }
        const Error6 wanted = scaled(error_);
        for (int n = 0; n < arm_.joint_count(); ++n) {
            const double along = jacobian.col(n).dot(wanted);
            const bool stuck = (along > 0.0 && positions_[n] >= arm_.joint(n).max) ||
                               (along < 0.0 && positions_[n] <= arm_.joint(n).min);
            if (stuck) {
                jacobian.col(n).setZero();
            }
        }
        using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 9, 9>;
        Square normal = jacobian.transpose() * jacobian;
        normal.diagonal().array() += damping * (cost_ + std::numeric_limits<double>::min()) + 1e-18;
        JointPositions delta = Eigen::LDLT<Square>(normal).solve(jacobian.transpose() * wanted);
        for (int n = 0; n < arm_.joint_count(); ++n) {
            delta[n] *= arm_.joint(n).kind == JointKind::prismatic ? length_ : 1.0;
        }
        return held_inside(arm_, positions_ + delta);
    }

    const ArmModel& arm_;
    const Frame& goal_;
    ArmDemand demand_;
    const ArmSolverSettings& settings_;
    double length_; ///< mm
    JointPositions positions_;
    Frame now_;
    Error6 error_;
    double cost_ = 0.0;
};

/// The n-th of evenly spread numbers in [0, 1) for each joint (Roberts 2018, generalised golden ratio).
double spread(int n, int joint, double golden) {
    const double step = std::pow(golden, -(joint + 1));
    const double value = 0.5 + step * n;
    return value - std::floor(value);
}

/// The root of x^(d+1) = x + 1.
double golden_ratio(int dimensions) {
    double x = 1.5;
    for (int n = 0; n < 60; ++n) {
        x = std::pow(1.0 + x, 1.0 / (dimensions + 1.0));
    }
    return x;
}

/// Turns of a joint count as the same.
double joint_distance(const ArmModel& arm, const JointPositions& a, const JointPositions& b, double length) {
    double largest = 0.0;
    for (int n = 0; n < arm.joint_count(); ++n) {
        const bool slides = arm.joint(n).kind == JointKind::prismatic;
        const double apart = slides ? (a[n] - b[n]) / length : std::remainder(a[n] - b[n], 2.0 * pi);
        largest = std::max(largest, std::abs(apart));
    }
    return largest;
}

/// From `q` to `previous`, each joint that turns by the shorter way that its limits allow.
JointPositions way_back(const ArmModel& arm, const JointPositions& q, const JointPositions& previous) {
    JointPositions way = previous - q;
    for (int n = 0; n < arm.joint_count(); ++n) {
        const double shorter = std::remainder(way[n], 2.0 * pi);
        const bool allowed = q[n] + shorter >= arm.joint(n).min && q[n] + shorter <= arm.joint(n).max;
        if (arm.joint(n).kind == JointKind::revolute && allowed) {
            way[n] = shorter;
        }
    }
    return way;
}

/// `angle` in the turn inside the limits of `joint`; at the nearer limit where no turn is inside.
double turn_inside(const ArmJoint& joint, double angle) {
    constexpr double turn = 2.0 * pi;
    const double middle = std::clamp(0.0, joint.min, joint.max);
    return std::clamp(middle + std::remainder(angle - middle, turn), joint.min, joint.max);
}

/// Guesses at other branches: three turning joints in a row, the one between bent the other way, as a wrist
/// that is turned over.
std::vector<JointPositions> flipped(const ArmModel& arm, const JointPositions& q) {
    std::vector<JointPositions> guesses;
    for (int n = 0; n + 2 < arm.joint_count(); ++n) {
        const bool turn = arm.joint(n).kind == JointKind::revolute &&
                          arm.joint(n + 1).kind == JointKind::revolute &&
                          arm.joint(n + 2).kind == JointKind::revolute;
        if (turn) {
            JointPositions guess = q;
            guess[n] = turn_inside(arm.joint(n), q[n] + pi);
            guess[n + 1] = turn_inside(arm.joint(n + 1), -q[n + 1] - 2.0 * arm.joint(n + 1).theta);
            guess[n + 2] = turn_inside(arm.joint(n + 2), q[n + 2] + pi);
            guesses.push_back(std::move(guess));
        }
    }
    return guesses;
}

/// Of all positions that meet the same demand without a jump, as rolls about the tool axis do, the one that
/// is nearest to `previous`: gradient projection on the null space of the Jacobian (Liegeois 1977).
JointPositions pulled(const ArmModel& arm,
                      const Frame& goal,
                      ArmDemand demand,
                      JointPositions found,
                      const JointPositions& previous) {
    constexpr int most_pulls = 30;
    constexpr double still = 1e-9, singular = 1e-9; // of the arm's length or a radian
    const double length = std::max(stretched_length(arm), 1.0);
    JointPositions unit = JointPositions::Ones(arm.joint_count());
    for (int n = 0; n < arm.joint_count(); ++n) {
        unit[n] = arm.joint(n).kind == JointKind::prismatic ? length : 1.0;
    }
    for (int pull = 0; pull < most_pulls; ++pull) {
        ArmJacobian jacobian = demanded(arm_jacobian(arm, found), base_T_tool(arm, found), demand);
        jacobian.topRows<3>() /= length;
        const Eigen::MatrixXd scaled = jacobian * unit.asDiagonal();
        Eigen::FullPivLU<Eigen::MatrixXd> decomposed(scaled);
        decomposed.setThreshold(singular);
        if (decomposed.dimensionOfKernel() == 0) {
            break;
        }
        const Eigen::MatrixXd free = decomposed.kernel().householderQr().householderQ() *
                                     Eigen::MatrixXd::Identity(found.size(), decomposed.dimensionOfKernel());
        const Eigen::VectorXd wanted = way_back(arm, found, previous).cwiseQuotient(unit);
        const Eigen::VectorXd step = free * (free.transpose() * wanted);
        if (step.norm() < still) {
            break;
        }
        const JointPositions start = held_inside(arm, found + JointPositions(step.cwiseProduct(unit)));
        const ArmSolverResult there = solve_arm(arm, goal, demand, start);
        if (!there.converged || (there.positions - found).cwiseQuotient(unit).norm() < still) {
            break;
        }
        found = there.positions;
    }
    return found;
}

} // namespace

ArmSolverResult solve_arm(const ArmModel& arm,
                          const Frame& goal,
                          ArmDemand demand,
                          const JointPositions& start,
                          const ArmSolverSettings& settings) {
    expects(start.size() == arm.joint_count() && start.allFinite(), "a position for every joint");
    expects(goal.matrix().allFinite() && settings.angle_weight > 0.0,
            "a goal is finite, its directions count");
    return Solver(arm, goal, demand, settings).from(start);
}

std::vector<JointPositions> solve_arm_from_many_starts(
    const ArmModel& arm, const Frame& goal, ArmDemand demand, const JointPositions& previous, int starts) {
    constexpr double same = 1e-5; // rad
    constexpr int most_rounds = 20;
    const double length = std::max(stretched_length(arm), 1.0);
    const double golden = golden_ratio(arm.joint_count());
    std::vector<JointPositions> found, next{previous}; // starts that a guess speaks for come first
    int spread_out = 0, last_news = 0;
    while (!next.empty() || spread_out < std::min(last_news + starts, most_rounds * starts)) {
        JointPositions start = previous;
        if (!next.empty()) {
            start = next.back();
            next.pop_back();
        } else {
            ++spread_out;
            for (int joint = 0; joint < arm.joint_count(); ++joint) {
                const double reach = arm.joint(joint).kind == JointKind::prismatic ? length : pi;
                const double low = std::max(arm.joint(joint).min, -reach);
                const double high = std::min(arm.joint(joint).max, reach);
                start[joint] = low + (high - low) * spread(spread_out, joint, golden);
            }
        }
        ArmSolverResult result = solve_arm(arm, goal, demand, start);
        if (result.converged && demand != ArmDemand::frame) {
            result.positions = pulled(arm, goal, demand, result.positions, previous);
        }
        const bool known = std::ranges::any_of(found, [&](const JointPositions& other) {
            return joint_distance(arm, other, result.positions, length) < same;
        });
        if (result.converged && !known) {
            found.push_back(result.positions);
            last_news = spread_out;
            for (JointPositions& other : flipped(arm, result.positions)) {
                next.push_back(std::move(other));
            }
        }
    }
    std::ranges::stable_sort(found, [&](const JointPositions& a, const JointPositions& b) {
        return joint_distance(arm, a, previous, length) < joint_distance(arm, b, previous, length);
    });
    return found;
}

} // namespace millwright::arm
