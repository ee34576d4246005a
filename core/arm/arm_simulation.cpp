#include "core/arm/arm_simulation.h"

#include "core/arm/arm_hold.h"
#include "core/arm/arm_motion_file.h"
#include "core/arm/arm_path.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace millwright::arm {

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

class Simulation {
public:
    Simulation(const ArmModel& arm,
               const JointPositions& start,
               double step,
               const std::filesystem::path& file)
        : arm_(arm), file_(file), step_(step), aim_(aim_of(arm, quarter_turn)), joints_(start) {}

    void run(const ArmWay& way, int number) {
        if (way.length > 0.0) {
            const double du = step_ / std::ceil(way.length);
            for (double u = 0.0; u <= 1.0; u += du) {
                add(way, u, number);
            }
        }
        if (records_.empty() || records_.back().block != number ||
            single(way.at(1.0).translation()) != records_.back().tip) {
            add(way, 1.0, number);
        }
        before_ += way.length;
    }

    /// Throws Error if the arm was not everywhere.
    [[nodiscard]] std::vector<ArmRecord> take() {
        if (!holes_.empty()) {
            fail_in_simulation(file_, holes_.front().first().line, sentence_about(holes_.front()));
        }
        return std::move(records_);
    }

private:
    static constexpr double quarter_turn = 0.5 * pi;

    static Vec3 single(const Vec3& point) { return point.unaryExpr(&in_single_precision); }

    void add(const ArmWay& way, double share, int number) {
        if (records_.size() >= most_records) {
            fail_in_simulation(file_,
                               way.line,
                               fmt::format("more than {} points are needed; use longer steps", most_records));
        }
        Frame goal = way.at(share);
        goal.translation() = single(goal.translation());
        ArmHold hold = hold_tool(arm_, goal, aim_, joints_);
        joints_ = hold.joints;
        records_.push_back({goal.translation(), joints_, number, hold.tilt});
        if (hold.trouble != ArmTrouble::none) {
            add_hole(std::move(hold), way, share);
        }
    }

    void add_hole(ArmHold hold, const ArmWay& way, double share) {
        const std::size_t point = records_.size(); // from 1
        const bool goes_on = !holes_.empty() && holes_.back().last().point + 1 == point &&
                             holes_.back().trouble == hold.trouble;
        if (!goes_on) {
            holes_.push_back({0.0, hold.trouble, std::move(hold.why), {}});
        }
        holes_.back().points.push_back(
            {point, way.line, before_ + share * way.length, records_.back().tip, hold.off});
    }

    [[nodiscard]] std::string sentence_about(const ArmHole& hole) const {
        const auto place = [](const Vec3& tip) {
            return fmt::format("{:.3f} {:.3f} {:.3f}", tip.x(), tip.y(), tip.z());
        };
        const std::string off = to_text(arm_, hole.trouble, hole.worst().off);
        std::string text =
            fmt::format("the arm cannot reach {}, point {} of the path, {:.3f} mm along it: {}",
                        place(hole.first().tip),
                        hole.first().point,
                        hole.first().along,
                        hole.why);
        if (hole.points.size() > 1) {
            text += fmt::format("; nor the points after it up to point {}, {}, line {}",
                                hole.last().point,
                                place(hole.last().tip),
                                hole.last().line);
        }
        if (!off.empty()) {
            text += fmt::format("; the worst, at point {}, {}", hole.worst().point, off);
        }
        if (holes_.size() > 1) {
            text +=
                fmt::format("; followed by {}", counted(holes_.size() - 1, "more section", "more sections"));
        }
        return text;
    }

    const ArmModel& arm_;
    const std::filesystem::path& file_;
    double step_;
    ArmAim aim_;
    JointPositions joints_;
    double before_ = 0.0; ///< length of the ways that are behind, mm
    std::vector<ArmRecord> records_;
    std::vector<ArmHole> holes_;
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
            fail_in_simulation(file_, number_, "the line has extra text at its end");
        }
    }

private:
    std::string_view text_;
    const std::filesystem::path& file_;
    int number_ = 0;
};

} // namespace

std::vector<ArmRecord> simulate_arm(const ArmModel& arm,
                                    const std::vector<ArmBlock>& blocks,
                                    const JointPositions& start,
                                    double step_mm,
                                    const std::filesystem::path& file) {
    expects(step_mm > 0.0 && std::isfinite(step_mm), "a step has a length");
    Simulation simulation(arm, start, step_mm, file);
    int number = 0;
    for (const ArmWay& way : ways_of(arm, blocks, start, file)) {
        simulation.run(way, number++);
    }
    return simulation.take();
}

std::vector<std::array<double, 3>> first_turns_deg(const ArmModel& arm,
                                                   const std::vector<ArmRecord>& records) {
    constexpr int axes = 3;
    for (int n = 0; n < axes; ++n) {
        if (n >= arm.joint_count() || arm.joint(n).kind != JointKind::revolute) {
            throw Error(fmt::format(
                "the card can only turn three joints, but joint {} of {} does not turn", n + 1, arm.name()));
        }
    }
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

std::string arm_result_text(const ArmModel& arm, const std::vector<ArmRecord>& records) {
    std::string text;
    for (const ArmRecord& record : records) {
        text += fmt::format("next position {} {} {} \n\n",
                            fixed(record.tip.x(), 5),
                            fixed(record.tip.y(), 5),
                            fixed(record.tip.z(), 5));
        for (Eigen::Index n = 0; n < record.joints.size(); ++n) {
            const bool turns = arm.joint(static_cast<int>(n)).kind == JointKind::revolute;
            text += fmt::format(
                " {} := {} \n", n + 1, fixed(turns ? to_degrees(record.joints[n]) : record.joints[n], 5));
        }
    }
    return text;
}

std::vector<ArmRecord>
parse_arm_result(const ArmModel& arm, std::string_view text, const std::filesystem::path& file) {
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
        record.joints.resize(arm.joint_count());
        for (int n = 0; n < arm.joint_count(); ++n) {
            line = lines.next();
            lines.expect(line, fmt::format(" {} := ", n + 1));
            const double value = lines.value(line);
            record.joints[n] = arm.joint(n).kind == JointKind::revolute ? from_degrees(value) : value;
            lines.expect_end(line);
        }
        records.push_back(std::move(record));
    }
    return records;
}

} // namespace millwright::arm
