// What the blocks of a planned program cannot say of the program that they come from. Each kind is found
// once, where it first stands.
#pragma once

#include "core/base/error.h"
#include "core/gcode/canon.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::gcode::internal {

/// At the first word `letter` of `line`, or where the line begins.
[[nodiscard]] Diagnostic at_word(const std::filesystem::path& file,
                                 SourcePlace source,
                                 std::string_view line,
                                 char letter,
                                 std::string message);

class UnsupportedFeatures {
public:
    explicit UnsupportedFeatures(std::filesystem::path file) : file_(std::move(file)) {}

    /// `line`: of the source; empty where another line is at hand.
    void move(const Move& move, std::string_view line);
    void command(const Command& command, std::string_view line);

    [[nodiscard]] std::vector<Diagnostic> take_lost() { return std::move(lost_); }
    [[nodiscard]] std::vector<Diagnostic> take_simplified() { return std::move(simplified_); }

private:
    enum class Kind { lost, simplified };
    void note(Kind kind, SourcePlace source, std::string_view line, char letter, const std::string& message);

    std::filesystem::path file_;
    std::vector<Diagnostic> lost_, simplified_;
};

} // namespace millwright::gcode::internal
