// LinuxCNC's interpreter reads what we write and must go to the very positions that our program says.
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/posts/prepare.h"
#include "core/posts/release.h"
#include "core/posts/writer.h"
#include "tests/support/oracle.h"
#include "tests/support/programs.h"
#include "tests/support/random_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>

namespace millwright::gcode {
namespace {

using kinematics::AxisKind;

/// One canonical move: X Y Z A B C in mm and degrees, as rs274 prints them.
struct CanonicalMove {
    bool feed = false;
    double rate = 0.0; ///< mm/min, or deg/min where only rotary axes move
    std::array<double, 6> target{};
};

std::vector<CanonicalMove> moves_in(const std::string& output) {
    std::vector<CanonicalMove> moves;
    std::istringstream lines(output);
    double rate_now = 0.0;
    for (std::string line; std::getline(lines, line);) {
        const auto set_rate = line.find("SET_FEED_RATE(");
        if (set_rate != std::string::npos) {
            rate_now = std::stod(line.substr(set_rate + 14));
        }
        const auto move = line.find("STRAIGHT_");
        if (move == std::string::npos) {
            continue;
        }
        CanonicalMove found;
        found.feed = line.compare(move, 13, "STRAIGHT_FEED") == 0;
        found.rate = rate_now;
        auto& q = found.target;
        const int count = std::sscanf(line.c_str() + line.find('(', move),
                                      "(%lf, %lf, %lf, %lf, %lf, %lf)",
                                      &q[0],
                                      &q[1],
                                      &q[2],
                                      &q[3],
                                      &q[4],
                                      &q[5]);
        EXPECT_EQ(count, 6) << line;
        moves.push_back(found);
    }
    return moves;
}

/// Where the arcs of rs274's output end: X Y Z. It prints them in the axes of their plane.
std::vector<Vec3> arc_ends_in(const std::string& output) {
    std::vector<Vec3> ends;
    std::istringstream lines(output);
    int shift = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("SELECT_PLANE(") != std::string::npos) {
            shift = line.find("YZ") != std::string::npos ? 1 : line.find("XZ") != std::string::npos ? 2 : 0;
        }
        const auto arc = line.find("ARC_FEED(");
        if (arc == std::string::npos) {
            continue;
        }
        double first = 0.0;
        double second = 0.0;
        double third = 0.0;
        EXPECT_EQ(
            std::sscanf(line.c_str() + arc, "ARC_FEED(%lf, %lf, %*f, %*f, %*d, %lf", &first, &second, &third),
            3)
            << line;
        Vec3 end;
        end[shift] = first;
        end[(shift + 1) % 3] = second;
        end[(shift + 2) % 3] = third;
        ends.push_back(end);
    }
    return ends;
}

/// What LinuxCNC takes for the length of a move in inverse time: of its linear axes, else of its rotary ones.
double inverse_time_length(const program::Program& program, int block) {
    const kinematics::AxisPositions step =
        program::position_before(program, block + 1) - program::position_before(program, block);
    double linear = 0.0;
    double rotary = 0.0;
    for (std::size_t n = 0; n < program.axes.size(); ++n) {
        const double d = step[static_cast<Eigen::Index>(n)];
        (program.axes[n].kind == AxisKind::rotary ? rotary : linear) += d * d;
    }
    return linear > 0.0 ? std::sqrt(linear) : to_degrees(std::sqrt(rotary));
}

class Rs274 : public OracleTest {
protected:
    Rs274() : OracleTest("rs274", "linuxcnc-uspace") {}
    ~Rs274() override { std::filesystem::remove(file_); }

    /// What rs274 prints for a text.
    std::string canon(const std::string& text) {
        write_file(file_, text);
        const ProgramRun answer = run({"-g", file_.string()});
        EXPECT_EQ(answer.exit_code, 0) << answer.output;
        return answer.output;
    }

    std::vector<CanonicalMove> interpret(const program::Program& program,
                                         const program::ProgramSettings& settings) {
        return moves_in(canon(posts::write_gcode(program, settings).text));
    }

    void expect_same_moves(const program::Program& program, const program::ProgramSettings& settings) {
        const std::vector<CanonicalMove> canonical = interpret(program, settings);
        std::size_t n = 0;
        for (int number = 0; number < program.block_count(); ++number) {
            const program::Block& block = program.blocks[static_cast<std::size_t>(number)];
            if (!block.moves()) {
                continue;
            }
            ASSERT_LT(n, canonical.size());
            const CanonicalMove& move = canonical[n++];
            EXPECT_EQ(move.feed, block.kind == program::BlockKind::feed);
            if (move.feed) {
                const double rate = 60.0 / block.duration * inverse_time_length(program, number);
                EXPECT_NEAR(move.rate, rate, 1e-4 + 1e-9 * rate);
            }
            for (std::size_t axis = 0; axis < program.axes.size(); ++axis) {
                const std::size_t column = std::string("XYZABC").find(program.axes[axis].letter);
                const double position = block.target[static_cast<Eigen::Index>(axis)];
                const bool rotary = program.axes[axis].kind == AxisKind::rotary;
                // The axes that the first move does not name are where rs274 starts: at zero, like ours.
                EXPECT_NEAR(move.target[column], rotary ? to_degrees(position) : position, 1.01e-4 / 2.0);
            }
        }
        EXPECT_EQ(n, canonical.size());
    }

private:
    std::filesystem::path file_ =
        std::filesystem::path(::testing::TempDir()) / ("gcode_oracle_" + std::to_string(getpid()) + ".ngc");
};

TEST_F(Rs274, GoesWhereOurProgramsSayOnEveryShippedMachine) {
    for (const char* machine : {"rotary-tilt-listing", "rotary-tilt-gui", "ac-table"}) {
        for (const char* surface : {"dome", "two-bell"}) {
            SCOPED_TRACE(std::string(machine) + " " + surface);
            expect_same_moves(test::post_over(surface, test::machine(machine), 10, 10).program, {});
        }
    }
}

TEST_F(Rs274, GoesWhereRandomProgramsSay) {
    std::mt19937 random(274);
    for (int n = 0; n < 20; ++n) {
        const auto machine = test::machine(n % 2 == 0 ? "ac-table" : "router-xyz");
        const posts::PreparedProgram ready =
            posts::prepare(test::random_moves(machine, 40, random), machine, posts::PostFormat{});
        expect_same_moves(ready.program, {});
    }
}

TEST_F(Rs274, TurnsFittedArcsAsTheMovesThatTheyStandFor) {
    const auto machine = test::machine("router-xyz");
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int n = 0; n < 30; ++n) {
        const double radius = 5.0 + 30.0 * unit(random);
        const double sweep = (n % 2 == 0 ? 1.0 : -1.0) * (1.0 + 4.0 * unit(random));
        const double rise = n % 3 == 0 ? 5.0 * unit(random) : 0.0;
        program::Program program = test::empty_program(machine);
        for (int k = 0; k <= 80; ++k) {
            Vec3 p(radius * std::cos(k / 80.0 * sweep), radius * std::sin(k / 80.0 * sweep), k / 80.0 * rise);
            p = Vec3(p[n % 3], p[(n + 1) % 3], p[(n + 2) % 3]); // every plane in turn
            test::add_move(program, p, k == 0 ? 0.0 : 0.1);
        }
        test::add_block(program, program::BlockKind::end);
        const posts::ReleasedText text =
            posts::release(program, machine, posts::PostFormat{}, {.arc_tolerance = 0.02});
        ASSERT_GE(text.arcs, 1) << n;
        const auto ends = arc_ends_in(canon(text.listing.text));
        ASSERT_EQ(std::ssize(ends), text.arcs) << n;
        const Vec3 last = program.blocks[80].target;
        EXPECT_LT((ends.back() - last).cwiseAbs().maxCoeff(), 1.01e-4) << n;
    }
}

TEST_F(Rs274, AcceptsEveryWayOfWriting) {
    program::ProgramSettings settings;
    settings.link = program::LinkKind::on_surface;
    settings.line_numbers = true;
    settings.path_tolerance = 0.0;
    settings.coolant = true;
    const auto machine = test::machine("rotary-tilt-listing");
    program::Program program = test::post_over("dome", machine, 6, 6, settings).program;
    program.blocks[0].text = "project: (nested) \xE0\xB9\x82 " + std::string(400, 'x');
    expect_same_moves(program, settings);
}

} // namespace
} // namespace millwright::gcode
