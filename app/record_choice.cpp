#include "app/record_choice.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace millwright::app {

void add_record_options(CLI::App& command, RecordChoice& choice) {
    command
        .add_option(
            "--record", choice.pattern, "Records of a coordinate stream, as \"t {X} {Y} {Z} {a} {s}\"")
        ->type_name("PATTERN")
        ->check([](const std::string& pattern) {
            return pattern.empty() ? std::string("a record tells something") : std::string();
        });
    command.add_option("--ending", choice.ending, "Of a record: lf, crlf or cr")
        ->check(CLI::IsMember({"lf", "crlf", "cr"}))
        ->capture_default_str();
    command.add_flag("--relative", choice.format.relative, "Records say how far, not where");
    command.add_option("--answer", choice.format.answer, "What comes back for each record")
        ->type_name("TEXT");
    constexpr double shortest = 0.01;
    constexpr double longest = 3600.0;
    command.add_option("--patience", choice.format.patience, "An answer takes no longer, s")
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
