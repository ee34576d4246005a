// Texts that were tampered with are never released.
#include "core/posts/read_back.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/posts/arc_fit.h"
#include "core/posts/post_file.h"
#include "core/posts/prepare.h"
#include "tests/support/programs.h"
#include "tests/support/random_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace millwright::posts {
namespace {

using ::testing::HasSubstr;

struct Written {
    PostFormat format;
    PreparedProgram ready;
    program::Listing listing;
    double arc_tolerance = 0.0;

    [[nodiscard]] std::vector<std::string> lines() const {
        std::vector<std::string> all;
        for (int n = 1; n <= listing.line_count(); ++n) {
            all.emplace_back(listing.line(n));
        }
        return all;
    }

    /// What is said of these lines in place of the written ones; empty if they pass.
    [[nodiscard]] std::string verdict(const std::vector<std::string>& changed) const {
        program::Listing other;
        for (const std::string& line : changed) {
            other.text += line + "\n";
        }
        try {
            check_read_back(other, ready.program, ready.program_words, format, arc_tolerance, "part");
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return {};
    }

    /// Lines that move, dwell or turn the spindle; not those that say how.
    [[nodiscard]] std::vector<std::size_t> acting_lines() const {
        std::set<std::size_t> numbers;
        for (int n = 0; n < ready.program.block_count(); ++n) {
            if (ready.program.blocks[static_cast<std::size_t>(n)].moves()) {
                const int first = listing.line_of_block[static_cast<std::size_t>(n)];
                const int next = listing.line_of_block[static_cast<std::size_t>(n) + 1];
                numbers.insert(static_cast<std::size_t>(next > first ? next - 1 : first) -
                               1); // behind a switch
            }
        }
        return {numbers.begin(), numbers.end()};
    }
};

Written written(const std::string& post) {
    const auto machine = test::machine(post == "grbl" ? "router-xyz" : "ac-table");
    Written result;
    result.format = read_post("assets/posts/" + post + ".json");
    std::mt19937 random(77);
    result.ready = prepare(test::random_moves(machine, 12, random), machine, result.format);
    result.listing = write_text(result.ready.program, result.ready.program_words, result.format, {});
    return result;
}

/// An arc and some straight moves.
Written written_with_arcs() {
    const auto machine = test::machine("router-xyz");
    Written result;
    result.arc_tolerance = 0.01;
    program::Program program = test::empty_program(machine);
    const auto point = [](int k) {
        return kinematics::AxisPositions(
            Vec3(20.0 * std::cos(0.05 * k), 20.0 * std::sin(0.05 * k), 0.01 * k));
    };
    test::add_move(program, point(0));
    for (int k = 1; k <= 60; ++k) {
        test::add_move(program, point(k), 0.1);
    }
    test::add_move(program, point(0), 2.0);
    test::add_block(program, program::BlockKind::end);
    result.ready = prepare(program, machine, result.format);
    result.ready.program_words.arcs =
        fit_arcs(result.ready.program, result.ready.program_words, result.format, result.arc_tolerance);
    result.listing = write_text(result.ready.program, result.ready.program_words, result.format, {});
    return result;
}

std::vector<Written> all_written() {
    std::vector<Written> all;
    for (const char* post : {"fanuc-tcp", "grbl", "heidenhain", "linuxcnc", "linuxcnc-tcp", "virtual"}) {
        all.push_back(written(post));
    }
    all.push_back(written_with_arcs());
    return all;
}

// Near a singular point on the edge of a face: LinuxCNC makes no feed slower than 0.1 mm per minute, and by
// that would make the turn in 0.06 s. The text was refused, and with it the whole program.
TEST(ReadBack, PassesATurnBesideNextToNothingOfAWay) {
    const auto machine = test::machine("ac-table");
    const int y = machine.axis_index('Y'), c = machine.axis_index('C');
    program::Program program = test::empty_program(machine);
    kinematics::AxisPositions at = program.start;
    test::add_move(program, at);
    const auto go = [&](double mm, double degrees) {
        at[y] += mm;
        at[c] += from_degrees(degrees);
        test::add_move(program, at, 0.1557);
    };
    go(0.5, 2.0);
    go(1e-4, 2.2334);
    go(-0.07, 2.2);
    test::add_block(program, program::BlockKind::end);
    Written now;
    now.ready = prepare(program, machine, now.format);
    now.listing = write_text(now.ready.program, now.ready.program_words, now.format, {});
    EXPECT_EQ(now.verdict(now.lines()), "");
    const auto& blocks = now.ready.program.blocks;
    EXPECT_EQ(blocks[2].target[y], blocks[1].target[y]);
    EXPECT_NEAR(blocks[2].target[c], from_degrees(4.2334), 1e-6);
    EXPECT_NEAR(blocks[3].target[y], 0.5 + 1e-4 - 0.07, 1e-9);
}

TEST(ReadBack, PassesWhatWasWritten) {
    for (const Written& now : all_written()) {
        EXPECT_EQ(now.verdict(now.lines()), "") << now.format.name;
    }
}

TEST(ReadBack, FindsEveryChangedDigit) {
    int changes = 0;
    for (const Written& now : all_written()) {
        const auto lines = now.lines();
        for (const std::size_t n : now.acting_lines()) {
            for (std::size_t at = 0; at < lines[n].size(); ++at) {
                if (std::isdigit(static_cast<unsigned char>(lines[n][at])) == 0) {
                    continue;
                }
                auto changed = lines;
                char& digit = changed[n][at];
                digit = digit == '9' ? '0' : static_cast<char>(digit + 1);
                EXPECT_NE(now.verdict(changed), "")
                    << now.format.name << ": " << lines[n] << " -> " << changed[n];
                ++changes;
            }
        }
    }
    EXPECT_GT(changes, 2000);
}

TEST(ReadBack, FindsEveryLostLine) {
    for (const Written& now : all_written()) {
        const auto lines = now.lines();
        for (const std::size_t n : now.acting_lines()) {
            auto changed = lines;
            changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(n));
            EXPECT_NE(now.verdict(changed), "") << now.format.name << ": " << lines[n];
        }
    }
}

TEST(ReadBack, FindsEveryDoubledLine) {
    for (const Written& now : all_written()) {
        const auto lines = now.lines();
        for (const std::size_t n : now.acting_lines()) {
            auto changed = lines;
            changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(n), lines[n]);
            EXPECT_NE(now.verdict(changed), "") << now.format.name << ": " << lines[n];
        }
    }
}

TEST(ReadBack, FindsEverySwappedPair) {
    for (const Written& now : all_written()) {
        const auto lines = now.lines();
        const auto acting = now.acting_lines();
        for (const std::size_t n :
             std::vector(acting.begin() + 1, acting.end())) { // the first is behind the head
            auto changed = lines;
            std::swap(changed[n], changed[n - 1]);
            EXPECT_NE(now.verdict(changed), "")
                << now.format.name << ": " << lines[n - 1] << " | " << lines[n];
        }
    }
}

TEST(ReadBack, FindsEveryLostWord) {
    for (const Written& now : all_written()) {
        const auto lines = now.lines();
        for (const std::size_t n : now.acting_lines()) {
            for (std::size_t at = lines[n].find(' '); at != std::string::npos;
                 at = lines[n].find(' ', at + 1)) {
                auto changed = lines;
                changed[n].erase(at, std::min(lines[n].find(' ', at + 1), lines[n].size()) - at);
                const std::string word = lines[n].substr(at, lines[n].size() - changed[n].size());
                const bool rapid_already = word == " G0" && n > 0 && lines[n - 1].starts_with("G53 G0 ");
                if (word == " R0" || word == " J0.0000" || rapid_already) {
                    continue; // the same without it
                }
                EXPECT_NE(now.verdict(changed), "")
                    << now.format.name << ": " << lines[n] << " without" << word;
            }
        }
    }
}

TEST(ReadBack, FindsALostSwitch) {
    for (const Written& now : all_written()) {
        const auto lines = now.lines();
        int switches = 0;
        for (std::size_t n = 0; n < lines.size(); ++n) {
            for (const char* what : {"M3",
                                     "M4",
                                     "M5",
                                     "M8",
                                     "M9",
                                     "M0",
                                     "STOP",
                                     "G4 P",
                                     "DWELL",
                                     "M2",
                                     "M30",
                                     "M428",
                                     "M429",
                                     "G43.4",
                                     "G49",
                                     "TCPM"}) {
                const std::size_t found = lines[n].find(what);
                const bool numbered = now.format.reader == TextReader::klartext; // each line counts there
                const bool acts = found == 0 || (numbered && found != std::string::npos) ||
                                  (lines[n].front() == 'S' && found != std::string::npos);
                if (!acts || (n < 4 && lines[n] == "M429")) { // of the head: how controls start anyway
                    continue;
                }
                auto changed = lines;
                changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(n));
                EXPECT_NE(now.verdict(changed), "") << now.format.name << ": " << lines[n];
                ++switches;
            }
        }
        EXPECT_GE(switches, 1) << now.format.name;
    }
}

TEST(ReadBack, NamesLineBlockAndBothValues) {
    const Written now = written("linuxcnc");
    auto lines = now.lines();
    const std::size_t n = now.acting_lines().at(3);
    const std::size_t at = lines[n].find('.') + 4;
    lines[n][at] = lines[n][at] == '9' ? '0' : static_cast<char>(lines[n][at] + 1);
    const std::string verdict = now.verdict(lines);
    EXPECT_THAT(verdict, HasSubstr("part:" + std::to_string(n + 1) + ": block "));
    EXPECT_THAT(verdict, HasSubstr(" in the text, but "));
    EXPECT_THAT(verdict, HasSubstr("it is not released"));
}

TEST(ReadBack, FindsAPositionThatIsTakenForOneOfTheMachine) {
    for (const char* post : {"linuxcnc-tcp", "fanuc-tcp"}) {
        const Written now = written(post);
        auto lines = now.lines();
        for (std::string& line : lines) {
            const std::size_t at = line.find("G53 ");
            if (at != std::string::npos && line.find('Z') != std::string::npos) {
                line.erase(at, 4);
                EXPECT_NE(now.verdict(lines), "");
                break;
            }
        }
    }
}

} // namespace
} // namespace millwright::posts
