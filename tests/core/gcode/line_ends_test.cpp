#include "core/base/files.h"
#include "core/gcode/canon_printer.h"
#include "core/gcode/interpreter.h"
#include "core/gcode/program_text.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

/// Letter by letter.
std::vector<std::string> lines_letter_by_letter(const std::string& text) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] != '\n' && text[n] != '\r') {
            line += text[n];
            continue;
        }
        n += text[n] == '\r' && n + 1 < text.size() && text[n + 1] == '\n' ? 1 : 0;
        lines.push_back(line);
        line.clear();
    }
    if (!line.empty()) {
        lines.push_back(line);
    }
    return lines;
}

std::string random_text(std::mt19937& random, int lines) {
    std::uniform_int_distribution<int> length(0, 600);
    std::uniform_int_distribution<int> end(0, 3);
    std::string text;
    for (int n = 0; n < lines; ++n) {
        text += std::string(static_cast<std::size_t>(length(random)), 'x');
        const int kind = end(random);
        text += kind == 0 ? "\n" : kind == 1 ? "\r\n" : kind == 2 ? "\r" : "\r\r\n\n";
    }
    return text + std::string(static_cast<std::size_t>(length(random)), 'y');
}

TEST(LineEnds, AreFoundWhereverTheyStand) {
    std::mt19937 random(1);
    for (int k = 0; k < 300; ++k) {
        const std::string text = random_text(random, 20);
        std::vector<std::string> found;
        for (std::size_t at = 0; at < text.size(); at = next_line(text, at)) {
            const std::string_view rest = std::string_view(text).substr(at);
            found.emplace_back(rest.substr(0, end_of_line(rest)));
        }
        EXPECT_EQ(found, lines_letter_by_letter(text));
        const LineIndex index(text);
        ASSERT_EQ(index.count(), std::ssize(found));
        for (std::size_t n = 0; n < found.size(); ++n) {
            EXPECT_EQ(index.line(static_cast<std::ptrdiff_t>(n)), found[n]);
        }
    }
}

TEST(LineEnds, BecomeNewlinesByteForByte) {
    EXPECT_EQ(with_newlines("a\rb\r\nc\n\r"), "a\nb\r\nc\n\n");
    EXPECT_EQ(with_newlines(""), "");
}

struct Printed {
    std::string canon;
    std::vector<std::string> errors;
    int lines = 0;

    friend bool operator==(const Printed&, const Printed&) = default;
};

Printed printed_file(const std::filesystem::path& file) {
    Printed result;
    CanonPrinter printer([&](std::string_view text) { result.canon += text; });
    ReaderSettings settings;
    settings.any_tool = true;
    settings.most_errors = 10;
    Interpreter reader(file, settings, printer);
    reader.run();
    printer.flush();
    for (const Diagnostic& error : reader.errors()) {
        result.errors.push_back(to_text(error));
    }
    result.lines = reader.line_count();
    return result;
}

/// Long enough for many buffers of the reader; loops go back in the file.
TEST(LineEnds, OfAnyComputerMakeTheSameProgram) {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> number(-99, 99);
    std::string text = "G21 G90\n#1 = 0\nO1 while [#1 LT 3]\n#1 = [#1 + 1]\n";
    for (int n = 0; n < 40'000; ++n) {
        text += "X" + std::to_string(number(random)) + " Y" + std::to_string(number(random)) + "\n";
    }
    text += "O1 endwhile\n(here) X1 X2\n; a comment\nM2\n";
    text.insert(text.find('X'), "G1 F100 ");
    const test::ScratchFolder folder;
    const auto file = folder / "part.ngc";
    write_file(file, text);
    const Printed expected = printed_file(file);
    ASSERT_EQ(expected.errors.size(), 1U);
    EXPECT_NE(expected.errors[0].find("part.ngc:40006:11"), std::string::npos) << expected.errors[0];
    for (const std::string end : {"\r", "\r\n"}) {
        std::string other;
        for (const char c : text) {
            other += c == '\n' ? end : std::string(1, c);
        }
        write_file(file, other);
        EXPECT_EQ(printed_file(file), expected);
    }
}

} // namespace
} // namespace millwright::gcode
