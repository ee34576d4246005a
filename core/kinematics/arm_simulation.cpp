#include "core/kinematics/arm_simulation.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/arm_inverse.h"
#include "core/kinematics/arm_motion_ways.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <limits>

namespace millwright::kinematics {

namespace {

constexpr std::size_t most_records = 10'000'000;

[[noreturn]] void fail_in_simulation(const std::filesystem::path& file, int line, std::string message) {
    throw Error(Diagnostic{.place = {.file = file, .line = line}, .message = std::move(message), .hint = {}});
}

/// By arithmetic: where it vectorises, g++ 12 leaves out conversions of a double to float and back.
double in_single_precision(double value) {
    constexpr int digits = std::numeric_limits<float>::digits;
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(fraction, digits)), exponent - digits);
}

/// The tool axis nearest to `wanted` in the plane of the arm.
Vec3 axis_at(const Vec3& tip, const Vec3& wanted, const std::filesystem::path& file, int line) {
    const auto projected = projected_axis({tip, wanted});
    if (!projected) {
        fail_in_simulation(file, line, "the tool axis is across the plane of the arm");
    }
    return *projected;
}

class Simulation {
public:
    Simulation(const ArmModel& arm,
               const JointPositions& start,
               double step,
               const std::filesystem::path& file)
        : arm_(arm), file_(file), step_(step), joints_(start) {}

    void run(const ArmWay& way, int number) {
        if (way.length > 0.0) {
            const double du = step_ / std::ceil(way.length);
            for (double u = 0.0; u <= 1.0; u += du) {
                add(way.at(u), way.line, number);
            }
        }
        const Frame target = way.at(1.0);
        if (records_.empty() || records_.back().block != number ||
            single(target.translation()) != records_.back().tip) {
            add(target, way.line, number);
        }
    }
    [[nodiscard]] std::vector<ArmRecord> take() { return std::move(records_); }

private:
    static Vec3 single(const Vec3& point) { return point.unaryExpr(&in_single_precision); }

    void add(const Frame& exact, int line, int number) {
        if (records_.size() >= most_records) {
            fail_in_simulation(
                file_, line, fmt::format("more than {} points; take longer steps", most_records));
        }
        const Vec3 tip = single(exact.translation());
        const Vec3 axis = axis_at(tip, exact.linear().col(2), file_, line);
        const InverseSolution found = arm_inverse(arm_, PointedGoal{tip, axis}, joints_);
        if (found.branches.empty()) {
            fail_in_simulation(
                file_,
                line,
                fmt::format(
                    "the arm does not reach {:.3f} {:.3f} {:.3f}: {}", tip.x(), tip.y(), tip.z(), found.why));
        }
        const auto distance = [&](const JointPositions& q) { return (q - joints_).cwiseAbs().maxCoeff(); };
        joints_ = *std::ranges::min_element(found.branches, {}, distance);
        records_.push_back({tip, joints_, number});
    }

    const ArmModel& arm_;
    const std::filesystem::path& file_;
    double step_;
    JointPositions joints_;
    std::vector<ArmRecord> records_;
};

/// One line of a result after another.
class Lines {
public:
    Lines(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

    [[nodiscard]] bool at_end() const { return text_.empty(); }
    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] std::string_view next() {
        const std::size_t end = std::min(text_.find('\n'), text_.size());
        const std::string_view line = text_.substr(0, end);
        text_.remove_prefix(std::min(end + 1, text_.size()));
        ++number_;
        return line;
    }
    /// Takes `words` from the front of `line`.
    void expect(std::string_view& line, std::string_view words) const {
        if (!line.starts_with(words)) {
            fail_in_simulation(file_, number_, fmt::format("'{}' is expected here", words));
        }
        line.remove_prefix(words.size());
    }
    /// A number and the blank behind it.
    [[nodiscard]] double value(std::string_view& line) const {
        double found = 0.0;
        const auto [end, failure] = std::from_chars(line.data(), line.data() + line.size(), found);
        if (failure != std::errc() || !std::isfinite(found)) {
            fail_in_simulation(file_, number_, "a number is expected here");
        }
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        expect(line, " ");
        return found;
    }
    void expect_end(std::string_view line) const {
        if (!line.empty()) {
            fail_in_simulation(file_, number_, "nothing more is expected in this line");
        }
    }

private:
    std::string_view text_;
    const std::filesystem::path& file_;
    int number_ = 0;
};

} // namespace

JointPositions arm_home() {
    JointPositions home(5);
    home << 0.0, -0.5 * pi, 0.5 * pi, 0.0, 0.0;
    return home;
}

std::vector<ArmRecord> simulate_arm(const ArmModel& arm,
                                    const std::vector<ArmBlock>& blocks,
                                    const JointPositions& start,
                                    double step_mm,
                                    const std::filesystem::path& file) {
    expects(step_mm > 0.0 && std::isfinite(step_mm), "a step has a length");
    if (!arm.planar_elbow()) {
        throw Error(
            "motion files are for arms like the Motoman L-3: three parallel joints between base and roll");
    }
    Simulation simulation(arm, start, step_mm, file);
    int number = 0;
    for (const ArmWay& way : ways_of(arm, blocks, start, file)) {
        simulation.run(way, number++);
    }
    return simulation.take();
}

std::vector<std::array<double, 3>> first_turns_deg(const std::vector<ArmRecord>& records) {
    std::vector<std::array<double, 3>> turns;
    for (const ArmRecord& record : records) {
        std::array<double, 3> turn{};
        for (std::size_t n = 0; n < turn.size(); ++n) {
            const auto joint = static_cast<Eigen::Index>(n);
            turn[n] = to_degrees(record.joints[joint] - records.front().joints[joint]);
        }
        turns.push_back(turn);
    }
    return turns;
}

std::string arm_result_text(const std::vector<ArmRecord>& records) {
    std::string text;
    for (const ArmRecord& record : records) {
        text += fmt::format("next position {} {} {} \n\n",
                            fixed(record.tip.x(), 5),
                            fixed(record.tip.y(), 5),
                            fixed(record.tip.z(), 5));
        for (Eigen::Index n = 0; n < record.joints.size(); ++n) {
            text += fmt::format(" {} := {} \n", n + 1, fixed(to_degrees(record.joints[n]), 5));
        }
    }
    return text;
}

std::vector<ArmRecord> parse_arm_result(std::string_view text, const std::filesystem::path& file) {
    Lines lines(text, file);
    std::vector<ArmRecord> records;
    while (!lines.at_end()) {
        ArmRecord record;
        std::string_view line = lines.next();
        lines.expect(line, "next position ");
        for (int n = 0; n < 3; ++n) {
            record.tip[n] = lines.value(line);
        }
        lines.expect_end(line);
        lines.expect_end(lines.next());
        record.joints.resize(5);
        for (int n = 0; n < 5; ++n) {
            line = lines.next();
            lines.expect(line, fmt::format(" {} := ", n + 1));
            record.joints[n] = from_degrees(lines.value(line));
            lines.expect_end(line);
        }
        records.push_back(std::move(record));
    }
    return records;
}

} // namespace millwright::kinematics
