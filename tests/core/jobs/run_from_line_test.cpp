#include "core/jobs/run_from_line.h"

#include "core/base/error.h"
#include "core/gcode/canon_frame.h"
#include "core/gcode/interpreter.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace millwright::jobs {
namespace {

using gcode::AxisValues;
using gcode::Dialect;
using testing::HasSubstr;

/// What happens from a line on, as the interpreter tells it: moves on the machine with what is in force.
class Recorder final : public gcode::CanonSink {
public:
    explicit Recorder(int from) : from_(from) {}

    void move(const gcode::Move& move, const gcode::SourceLine&) override {
        const AxisValues end = frame_.to_machine(move.target);
        const bool before = move.source.line < from_;
        (before ? approach : moves)
            .push_back({end,
                        fmt::format("{} sweep {:.2f} F {:.1f} S {} coolant {} feedmode {}",
                                    static_cast<int>(move.kind),
                                    move.sweep,
                                    move.kind == gcode::MoveKind::traverse ? 0.0 : feed_,
                                    spindle_,
                                    coolant_,
                                    feed_mode_)});
    }
    void curve(const gcode::Curve&, const gcode::SourceLine&) override {}
    void command(const gcode::Command& command, const gcode::SourceLine&) override {
        using gcode::CommandKind;
        frame_.command(command);
        feed_ = command.kind == CommandKind::set_feed_rate ? command.value * frame_.unit() : feed_;
        feed_mode_ = command.kind == CommandKind::set_feed_mode ? command.index : feed_mode_;
        speed_ = command.kind == CommandKind::set_spindle_speed ? command.value : speed_;
        turning_ = command.kind == CommandKind::start_spindle_clockwise          ? 1.0
                   : command.kind == CommandKind::start_spindle_counterclockwise ? -1.0
                   : command.kind == CommandKind::stop_spindle_turning           ? 0.0
                                                                                 : turning_;
        spindle_ = turning_ * speed_;
        coolant_ =
            command.kind == CommandKind::flood_on || (command.kind != CommandKind::flood_off && coolant_);
    }

    struct Step {
        AxisValues end;
        std::string text;
    };
    std::vector<Step> approach, moves;

private:
    int from_;
    gcode::CanonFrame frame_;
    double feed_ = 0.0, speed_ = 0.0, turning_ = 0.0, spindle_ = 0.0;
    int feed_mode_ = 0;
    bool coolant_ = false;
};

Recorder recorded_from_line(const std::string& text, int from, Dialect dialect) {
    Recorder recorder(from);
    gcode::ReaderSettings settings;
    settings.dialect = dialect;
    settings.any_tool = true;
    gcode::Interpreter reader(std::string_view(text), "test.ngc", settings, recorder);
    reader.run();
    EXPECT_TRUE(reader.errors().empty())
        << (reader.errors().empty() ? "" : to_text(reader.errors().front())) << text;
    return recorder;
}

std::vector<std::string> texts(const std::vector<Recorder::Step>& steps) {
    std::vector<std::string> result;
    for (const Recorder::Step& step : steps) {
        result.push_back(step.text);
    }
    return result;
}

class RandomText {
public:
    RandomText(unsigned seed, Dialect dialect) : random_(seed), linuxcnc_(dialect == Dialect::linuxcnc) {}

    std::string operator()() {
        std::string text = "%\n(made up)\nG21 G17 G90 G94\nG0 Z20\nM3 S800\nF300\n";
        text.erase(0, linuxcnc_ ? 0 : 2);
        for (int n = 0; n < 40; ++n) {
            text += line();
        }
        return text + "G0 Z20\nM5\nM9\nM2\n" + (linuxcnc_ ? "%\n" : "");
    }

private:
    std::mt19937 random_;
    bool linuxcnc_;
    int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

    std::string line() {
        switch (pick(16)) {
        case 0:
            return pick(2) == 0 ? "G20\nF12\n" : "G21\nF400\n";
        case 1:
            return pick(3) == 0 ? "G91\n" : "G90\n";
        case 2:
            return fmt::format("G{}\n", 17 + pick(3));
        case 3:
            return fmt::format("M{} S{}\n", 3 + pick(2), 100 * (1 + pick(9)));
        case 4:
            return pick(2) == 0 ? "M8\n" : "M9\n";
        case 5:
            return fmt::format("F{}\n", 100 + pick(900));
        case 6:
            return fmt::format("G{}\n", 54 + pick(3));
        case 7:
            return fmt::format("G93 G1 X{} F{}\nG94\nF200\n", pick(9), 2 + pick(9));
        case 8:
            return linuxcnc_ ? fmt::format("G64 P0.0{}\n", 1 + pick(8)) : "G61\n";
        case 9:
            return linuxcnc_
                       ? fmt::format(
                             "G17 G90 G81 X{} Y{} Z-1 R2\nX{}\nG80\nG0 Z15\n", pick(9), pick(9), pick(9))
                       : "G0 Z15\n";
        case 10:
            return "G17 G91 G2 X2 Y0 I1 J0\nG90\n";
        case 11:
            return fmt::format("G0 Z{}\n", 5 + pick(15));
        default:
            return fmt::format("G1 X{} Y{}.{} Z-{}\n", pick(30), pick(30), pick(9), pick(3));
        }
    }
};

TEST(RunFromLine, DoesTheRestOfAnyProgramAsTheWholeWouldAndComesFromAbove) {
    int begun = 0;
    int refused = 0;
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl}) {
        for (unsigned seed = 1; seed <= 40; ++seed) {
            const std::string text = RandomText(seed, dialect)();
            const int lines = static_cast<int>(std::ranges::count(text, '\n'));
            for (int line = 1; line <= lines; line += 3) {
                RunFrom rest;
                try {
                    rest = run_from_line(text, "test.ngc", line, {.dialect = dialect, .clearance = 1000.0});
                } catch (const Error&) {
                    ++refused;
                    continue;
                }
                ++begun;
                ASSERT_EQ(std::ranges::count(rest.text, '\n'), lines);
                const Recorder whole = recorded_from_line(text, line, dialect);
                const Recorder part = recorded_from_line(rest.text, line, dialect);
                ASSERT_TRUE(texts(part.moves) == texts(whole.moves)) << rest.text << "line " << line;
                for (std::size_t n = 0; n < part.moves.size(); ++n) {
                    for (const gcode::Axis axis : {gcode::Axis::x, gcode::Axis::y, gcode::Axis::z}) {
                        ASSERT_NEAR(part.moves[n].end[axis], whole.moves[n].end[axis], 1e-3);
                    }
                }
                // up, across, down, and the motion mode of the line, which moves nothing
                ASSERT_GE(part.approach.size(), 3U) << rest.text << "line " << line;
                const auto& end = whole.approach.back().end;
                EXPECT_GE(part.approach[0].end[gcode::Axis::z], 999.0);
                EXPECT_GE(part.approach[1].end[gcode::Axis::z], 999.0);
                for (const gcode::Axis axis : {gcode::Axis::x, gcode::Axis::y}) {
                    EXPECT_NEAR(part.approach[1].end[axis], end[axis], 1e-3);
                }
                for (std::size_t n = 2; n < part.approach.size(); ++n) {
                    EXPECT_NEAR(part.approach[n].end[gcode::Axis::z], end[gcode::Axis::z], 1e-3);
                }
            }
        }
    }
    EXPECT_GT(begun, 400);
    EXPECT_GT(refused, 20);
}

std::string with_head(const std::string& middle, const std::string& rest = "G1 X9\nM2\n") {
    return "G21 G90 G94\nG0 X0 Y0 Z20\nM3 S100\nF100\n\n\n\n\n\n\n\n\n" + middle + rest;
}

std::string start_line_refusal(const std::string& text, int line, RunFromSettings settings = {}) {
    try {
        (void)run_from_line(text, "test.ngc", line, settings);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(RunFromLine, RefusesWhatNobodyCanKnow) {
    EXPECT_THAT(start_line_refusal(with_head("G41 D1\nG1 X5\n"), 14), HasSubstr("cutter compensation"));
    EXPECT_THAT(start_line_refusal(with_head("G81 X1 Z-1 R1\nX2\n"), 14), HasSubstr("canned cycle"));
    EXPECT_THAT(start_line_refusal(with_head("o1 if [1]\nG1 X1\no1 endif\n"), 14),
                HasSubstr("subroutines or loops"));
    EXPECT_THAT(start_line_refusal(with_head("#1=3\nG1 X#1\n"), 14), HasSubstr("parameters"));
    EXPECT_THAT(start_line_refusal(with_head("G38.2 Z-5\n"), 14), HasSubstr("probes"));
    EXPECT_THAT(start_line_refusal(with_head("G92 X0\n"), 14), HasSubstr("offsets"));
    EXPECT_THAT(start_line_refusal(with_head("G10 L2 P2 X5\n"), 14), HasSubstr("offsets"));
    EXPECT_THAT(start_line_refusal(with_head("G53 G0 Z0\n"), 14), HasSubstr("machine position"));
    EXPECT_THAT(start_line_refusal(with_head("G28\nG0 X1 Y1\n"), 15),
                HasSubstr("Z is not specified afterwards"));
    const std::string blank(9, '\n');
    EXPECT_THAT(start_line_refusal("G21 G90\nF600\nG0 X60 Y50\n" + blank + "G1 X61\nG1 X62\n", 14),
                HasSubstr("specifies Z"));
    EXPECT_THAT(start_line_refusal("G21 G90\nF600\nG0 Z5\nG91\n" + blank + "G1 X1 Y1\nG1 X1\n", 15),
                HasSubstr("specifies X"))
        << "ways alone lead from nowhere";
    EXPECT_THAT(start_line_refusal(with_head("G2 X2 I1\n", "X4 I1\nM2\n"), 14), HasSubstr("arc or a spline"));
    EXPECT_THAT(start_line_refusal(with_head("G1 X1\n"), 3),
                HasSubstr("needs 5 lines above it, but there are only 2"));
    EXPECT_THAT(start_line_refusal(with_head("G1 X1\n"), 6),
                HasSubstr("needs 6 lines above it, but there are only 5"));
    EXPECT_EQ(start_line_refusal(with_head("G1 X1\n"), 7), "");
    EXPECT_THAT(start_line_refusal(with_head("G1 X1\n"), 99), HasSubstr("has only 15 lines"));
    EXPECT_THAT(start_line_refusal(with_head("M2\n"), 14), HasSubstr("ends at line 13"));
    EXPECT_THAT(start_line_refusal(with_head("G1 X1\n"), 14, {.clearance = -5.0}), HasSubstr("is below"));
    EXPECT_EQ(start_line_refusal(with_head("G28\nG0 X1 Y1 Z9\n"), 15), "");
}

TEST(RunFromLine, TakesTheHighestRapidForItsClearance) {
    const RunFrom rest = run_from_line(with_head("G0 X5\nG1 Z-1\nG0 Z7\nG1 Z-2\n"), "test.ngc", 17, {});
    EXPECT_THAT(rest.text, HasSubstr("G0 Z20\nG0 X5 Y0 M3 S100\nG4 P3\nG1 Z-2 F100\n"));
}

TEST(RunFromLine, NamesTheToolAndChangesItWhereTheProgramDoes) {
    const RunFrom rest = run_from_line(with_head("T4 M6\nG0 X5\n"), "test.ngc", 15, {});
    EXPECT_EQ(rest.tool, 4);
    EXPECT_THAT(rest.text, HasSubstr(" T4 M6\nG0 Z20\n"));
}

// It wrote G49: the tool would have gone down by its own length.
TEST(RunFromLine, KeepsTheLengthOfTheToolByItsNumber) {
    EXPECT_THAT(run_from_line(with_head("T4 M6\nG43 H4\nG0 Z20\nG0 X5\n"), "test.ngc", 17, {}).text,
                HasSubstr("G43 H4"));
    EXPECT_THAT(run_from_line(with_head("T4 M6\nG43\nG0 Z20\nG0 X5\n"), "test.ngc", 17, {}).text,
                HasSubstr("G43 H4"));
    EXPECT_THAT(run_from_line(with_head("T4 M6\nG43 H4\nG49\nG0 Z20\nG0 X5\n"), "test.ngc", 18, {}).text,
                HasSubstr("G49"));
}

TEST(RunFromLine, TheLongestApproachHasItsRoom) {
    const std::string text =
        "G20 G90 G93\nT4 M6\nM4 S100 F3\nM7\nM8\nG0 X0 Y0 Z20\nG0 Z30\nG1 X1 Y2 F4\nM2\n";
    const RunFrom rest = run_from_line(text, "test.ngc", 8, {});
    EXPECT_THAT(rest.text, HasSubstr("G93\nG1 X1 Y2 F4\n"));
    EXPECT_EQ(rest.text.find("\n\n"), std::string::npos) << "all seven lines are taken: " << rest.text;
}

TEST(RunFromLine, GoesDownAsTheProgramDoesAndOnAtItsFeed) {
    const std::string cut = "G1 Z-2 F120\nG1 X20 F600\nG1 X30 Z-1\nG1 Y9\n";
    const RunFrom rest = run_from_line(with_head(cut), "test.ngc", 16, {});
    EXPECT_THAT(rest.text, HasSubstr("G1 Z-1 F120\nG1 F600\n")) << "a ramp is not the way straight down";
    const RunFrom slow = run_from_line(with_head("G1 Z-2 F900\nG1 X20 F60\nG1 X30\n"), "test.ngc", 15, {});
    EXPECT_THAT(slow.text, HasSubstr("G1 Z-2 F60\nG1\n"));
    const RunFrom inches =
        run_from_line(with_head("G1 Z-2 F120\nG20\nG1 X1 F30\nG0 Z1\nG1 X2\n"), "test.ngc", 17, {});
    EXPECT_THAT(inches.text, HasSubstr(" F4.724409\nG")) << "120 mm are 4.72 inches";
}

TEST(RunFromLine, KnowsTheHighestRapidAlsoInAnotherUnit) {
    const RunFrom rest =
        run_from_line(with_head("G0 Z50.8\nG1 Z-2 F120\nG20\nG1 X1 F30\nX2\n"), "test.ngc", 17, {});
    EXPECT_THAT(rest.text, HasSubstr("G0 Z2\n")) << "50.8 mm are 2 inches";
}

TEST(RunFromLine, TakesTheClearanceInMillimetresWhateverTheProgramIsIn) {
    const std::string text = with_head("G1 Z-2 F120\nG20\nG1 X1 F30\nX2\n");
    EXPECT_THAT(run_from_line(text, "test.ngc", 16, {.clearance = 25.4}).text, HasSubstr("G0 Z1\n"));
    EXPECT_THAT(run_from_line(with_head("G1 Z-2 F120\nX1\nX2\n"), "test.ngc", 15, {.clearance = 25.4}).text,
                HasSubstr("G0 Z25.4\n"));
}

} // namespace
} // namespace millwright::jobs
