#include "app/command_line/record_choice.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace millwright::app {

void add_record_options(CLI::App& command, RecordChoice& choice) {
    command
        .add_option("--record",
                    choice.pattern,
                    "Record format of a coordinate stream, such as \"t {X} {Y} {Z} {a} {s}\"")
        ->type_name("PATTERN")
        ->check([](const std::string& pattern) {
            return pattern.empty() ? std::string("a record must not be empty") : std::string();
        });
    command.add_option("--ending", choice.ending, "Line ending of a record: lf, crlf or cr")
        ->check(CLI::IsMember({"lf", "crlf", "cr"}))
        ->capture_default_str();
    command.add_flag(
        "--relative", choice.format.relative, "Records contain relative moves instead of positions");
    command.add_option("--answer", choice.format.answer, "Answer expected to each record")->type_name("TEXT");
    constexpr double shortest = 0.01;
    constexpr double longest = 3600.0;
    command.add_option("--patience", choice.format.patience, "Longest wait for an answer, s")
        ->check(CLI::Range(shortest, longest))
        ->capture_default_str();
}

std::optional<drivers::RecordFormat> record_of(const RecordChoice& choice) {
    if (choice.pattern.empty()) {
        return std::nullopt;
    }
    drivers::RecordFormat format = choice.format;
    format.pattern = choice.pattern;
    format.ending = choice.ending == "crlf" ? "\r\n" : choice.ending == "cr" ? "\r" : "\n";
    return format;
}

} // namespace millwright::app
