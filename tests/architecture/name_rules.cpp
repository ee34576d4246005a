#include "tests/architecture/name_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::architecture {

namespace {

struct Misnomer {
    std::string_view name, remedy;
};

constexpr std::array misnomers{
    Misnomer{"ArmBench", "ArmWorkspace"},
    Misnomer{"BentTrackSettings", "CurvedTrackSettings"},
    Misnomer{"ChordTurner", "ChordEndModel"},
    Misnomer{"EndlessWatch", "LoopDetector"},
    Misnomer{"FileQuestion", "FilePrompt"},
    Misnomer{"GridImprover", "GridOptimiser"},
    Misnomer{"GridPromise", "QualityGuard"},
    Misnomer{"Hands", "ActionContext"},
    Misnomer{"JogHand", "HoldToRunJog"},
    Misnomer{"Losses", "UnsupportedFeatures"},
    Misnomer{"Outbox", "CanonQueue"},
    Misnomer{"OwnPause", "HostStall"},
    Misnomer{"PlotBench", "PlotWorkspace"},
    Misnomer{"ProcessorBench", "ProcessorWorkspace"},
    Misnomer{"Proof", "ExecutedLineTracker"},
    Misnomer{"RoadBuilder", "AxisPathBuilder"},
    Misnomer{"SeenSide", "VisibleSide"},
    Misnomer{"Soup", "PolygonSoup"},
    Misnomer{"SquareMap", "HarmonicParametrization"},
    Misnomer{"Survey", "ProgramCheck"},
    Misnomer{"ToldText", "ProgressStream"},
    Misnomer{"WayOn", "ResumePoint"},
    Misnomer{"Workbench", "FrameState"},
    Misnomer{"Workpiece", "CuttingSetup"},
    Misnomer{"Workshop", "AppController"},
    Misnomer{"astir", "moving_by_command"},
    Misnomer{"astray", "off_target"},
    Misnomer{"bare_line", "stripped_line"},
    Misnomer{"held_moves", "compensation_lookahead"},
    Misnomer{"larger_figures", "worse_metrics"},
    Misnomer{"way_on", "resume_point"},
};

/// What stands behind "a" or "an" where "per" is meant.
constexpr std::array units{"block",  "byte",   "chunk", "column", "frame",  "gap",        "height",
                           "inch",   "level",  "line",  "mark",   "metre",  "minute",     "mm",
                           "move",   "ms",     "node",  "notch",  "pass",   "piece",      "point",
                           "radius", "report", "s",     "second", "side",   "step",       "track",
                           "turn",   "batch",  "check", "event",  "update", "microsecond"};

/// "nodes_per_piece" of "nodes_a_piece"; nothing where the name is in order.
std::optional<std::string> with_per(std::string_view name) {
    for (const std::string_view article : {"_a_", "_an_"}) {
        const std::size_t at = name.find(article);
        if (at == std::string_view::npos || at == 0 || name[at - 1] != 's') {
            continue;
        }
        std::string_view unit = name.substr(at + article.size());
        unit = unit.substr(0, unit.find('_'));
        if (std::ranges::find(units, unit) != units.end()) {
            return std::string(name.substr(0, at)) + "_per_" + std::string(name.substr(at + article.size()));
        }
    }
    return std::nullopt;
}

std::optional<std::string> remedy_of(std::string_view name) {
    const auto* const found = std::ranges::find(misnomers, name, &Misnomer::name);
    return found != misnomers.end() ? std::optional<std::string>(found->remedy) : with_per(name);
}

bool is_of_name(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

/// The line up to its comment, with blanks in place of literals.
std::string code_of_line(std::string_view line) {
    std::string code;
    char literal = 0;
    for (std::size_t n = 0; n < line.size(); ++n) {
        const char letter = line[n];
        if (literal != 0) {
            n += letter == '\\' ? 1U : 0U;
            literal = letter == literal ? '\0' : literal;
            code += ' ';
        } else if (line.substr(n).starts_with("//")) {
            break;
        } else if (letter == '"' || (letter == '\'' && (n == 0 || !is_of_name(line[n - 1])))) {
            literal = letter;
            code += ' ';
        } else {
            code += letter;
        }
    }
    return code;
}

void check_line(const TextFile& file, const Line& line, std::vector<Finding>& findings) {
    const std::string code = code_of_line(line.text);
    if (code.starts_with("#include")) {
        return;
    }
    std::size_t end = 0;
    for (std::size_t at = 0; at < code.size(); at = end + 1) {
        for (end = at; end < code.size() && is_of_name(code[end]); ++end) {
        }
        const std::string_view name = std::string_view(code).substr(at, end - at);
        if (const auto remedy = remedy_of(name)) {
            findings.push_back({file.path, line.number, std::string(name) + ": call it " + *remedy});
        }
    }
}

} // namespace

std::vector<Finding> check_identifiers(const std::vector<TextFile>& files) {
    std::vector<Finding> findings;
    for (const TextFile& file : files) {
        if (!is_source(file.path) || is_inside(file.path, "tests/architecture")) {
            continue;
        }
        const std::string_view path = file.path;
        const std::string_view name = path.substr(path.rfind('/') + 1);
        if (const auto remedy = remedy_of(name.substr(0, name.rfind('.')))) {
            findings.push_back({file.path, 0, "call it " + *remedy});
        }
        for (const Line& line : lines_of(file.text)) {
            check_line(file, line, findings);
        }
    }
    return findings;
}

} // namespace millwright::architecture
