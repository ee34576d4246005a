// Programs that are written for Grbl, in an emulated controller and computed time: every line is accepted,
// and the tool goes where the program says.
#include "core/emulators/grbl/grbl_emulator.h"
#include "core/posts/post_file.h"
#include "core/posts/release.h"
#include "tests/support/programs.h"
#include "tests/support/random_paths.h"

#include <gtest/gtest.h>

namespace millwright::emulators {
namespace {

using kinematics::AxisPositions;
using program::Block;
using program::BlockKind;

/// Sends the listing's line `number`, as the driver would. Returns the answer.
std::string answer_to_posted_line(GrblEmulator& grbl, const std::string& line) {
    grbl.receive(line + "\n");
    std::string text;
    constexpr double patience = 600.0; // s of the machine
    for (double time = 0.0; time < patience && text.find("\r\n") == std::string::npos; time += 0.01) {
        grbl.advance(0.01);
        text += grbl.take_output();
    }
    return text;
}

void run_until_planner_is_empty(GrblEmulator& grbl) {
    do {
        grbl.advance(0.01);
    } while (grbl.moving() || grbl.planned_blocks() > 0);
}

std::string without_comment(std::string_view line) {
    return line.starts_with('(') ? std::string() : std::string(line);
}

/// Runs it line by line and compares the place after each move.
void expect_followed(const posts::ReleasedText& text) {
    GrblEmulator grbl;
    (void)grbl.take_output();
    EXPECT_EQ(answer_to_posted_line(grbl, "$110=20000"), "ok\r\n"); // fast, so that the test is
    EXPECT_EQ(answer_to_posted_line(grbl, "$111=20000"), "ok\r\n");
    EXPECT_EQ(answer_to_posted_line(grbl, "$112=20000"), "ok\r\n");
    for (int number = 1; number <= text.listing.line_count(); ++number) {
        const std::string line = without_comment(text.listing.line(number));
        if (line.empty()) {
            continue;
        }
        if (line == "M0") {
            grbl.receive("M0\n");
            grbl.advance(0.1);
            grbl.receive("~");
            grbl.advance(0.1);
            EXPECT_EQ(grbl.take_output().substr(0, 2), "ok");
            continue;
        }
        ASSERT_TRUE(answer_to_posted_line(grbl, line).ends_with("ok\r\n")) << line;
        const int block = text.listing.block_at_line(number);
        const bool moves = block >= 0 && text.program.blocks[static_cast<std::size_t>(block)].moves() &&
                           number >= text.listing.line_of_block[static_cast<std::size_t>(block)];
        if (moves) {
            run_until_planner_is_empty(grbl);
            const AxisPositions& target = text.program.blocks[static_cast<std::size_t>(block)].target;
            for (int axis = 0; axis < 3; ++axis) {
                constexpr double step = 1.0 / 250.0; // mm, as the emulator's axes have it
                EXPECT_NEAR(grbl.position()[static_cast<std::size_t>(axis)], target[axis], step) << line;
            }
        }
    }
}

posts::PostFormat grbl_post() {
    return posts::read_post("assets/posts/grbl.json");
}

TEST(GrblPost, TakesTheEmulatedMachineWhereTheProgramSays) {
    const auto router = test::machine("router-xyz");
    std::mt19937 random(115200);
    for (int n = 0; n < 12; ++n) {
        const program::Program program = test::random_moves(router, 12, random);
        expect_followed(posts::release(program, router, grbl_post()));
    }
}

TEST(GrblPost, DrawsFittedArcsAsTheMovesThatTheyStandFor) {
    const auto router = test::machine("router-xyz");
    program::Program program = test::empty_program(router);
    const auto point = [](int k) {
        return AxisPositions(Vec3(20.0 * std::cos(0.05 * k), 20.0 * std::sin(0.05 * k), -0.02 * k));
    };
    test::add_move(program, point(0));
    for (int k = 1; k <= 100; ++k) {
        test::add_move(program, point(k), 0.1);
    }
    test::add_block(program, BlockKind::end);
    const posts::ReleasedText text = posts::release(program, router, grbl_post(), {.arc_tolerance = 0.01});
    EXPECT_EQ(text.arcs, 1);
    expect_followed(text);
}

} // namespace
} // namespace millwright::emulators
