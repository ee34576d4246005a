#include "app/gcode/gcode_command.h"

#include "app/command_line/command.h"
#include "app/command_line/origin_choice.h"
#include "app/command_line/posting.h"
#include "app/gcode/gcode_options.h"
#include "app/gcode/gcode_pulses.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/gcode/canon_printer.h"
#include "core/gcode/interpreter.h"
#include "core/gcode/language.h"
#include "core/gcode/program_text.h"
#include "core/gcode/tool_comments.h"
#include "core/gcode_programs/klartext.h"
#include "core/gcode_programs/machine_program.h"
#include "core/kinematics/machine_file.h"
#include "core/motion/planner.h"
#include "core/motion/time_estimate.h"
#include "core/project/assets.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

/// `check` shows so many errors of a program at most.
constexpr int most_errors_shown = 100;

/// The tools that rs274 knows when it is given no table.
constexpr std::string_view rs274_tools = "T1 P1 Z0.511 D0.125\n"
                                         "T2 P2 Z0.1 D0.0625\n"
                                         "T3 P3 Z1.273 D0.201\n"
                                         "T99999 P123 Z0.1\n";

class MoveCounter final : public gcode::CanonSink {
public:
    void move(const gcode::Move&, const gcode::SourceLine&) override { ++count_; }
    void curve(const gcode::Curve&, const gcode::SourceLine&) override { ++count_; }
    void command(const gcode::Command&, const gcode::SourceLine&) override {}

    [[nodiscard]] std::int64_t count() const { return count_; }

private:
    std::int64_t count_ = 0;
};

/// Of a file whose first lines are Klartext; the others are read line by line, however long they are.
std::optional<std::string> klartext_in(const std::string& file) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) {
        return std::nullopt;
    }
    constexpr std::size_t enough = 4096;
    std::string head(enough, '\0');
    std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(enough));
    const bool klartext = gcode::language_of(head.substr(0, head.find('\0'))) == gcode::Language::klartext;
    return klartext ? std::optional(read_file(file)) : std::nullopt;
}

nlohmann::ordered_json diagnostics_json(const std::vector<Diagnostic>& errors) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Diagnostic& error : errors) {
        nlohmann::ordered_json entry;
        entry["file"] = error.place.file.string();
        entry["line"] = error.place.line;
        entry["column"] = error.place.column;
        entry["message"] =
            error.hint.empty() ? error.message : fmt::format("{} ({})", error.message, error.hint);
        list.push_back(std::move(entry));
    }
    return list;
}

void print_program_json(const gcode::Interpreter& program, std::int64_t moves) {
    nlohmann::ordered_json answer;
    answer["lines"] = program.line_count();
    answer["moves"] = moves;
    answer["errors"] = diagnostics_json(program.errors());
    if (program.further_errors() > 0) {
        answer["further_errors"] = program.further_errors();
    }
    if (const std::optional<Diagnostic> notice = program.end_notice()) {
        answer["warnings"] = diagnostics_json({*notice});
    }
    fmt::print("{}\n", answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

/// A control that accepts a program without an end does not tell whether its file was cut off.
void print_end_notice(const gcode::Interpreter& program) {
    if (const std::optional<Diagnostic> notice = program.end_notice()) {
        print_warnings({*notice});
    }
}

/// Heidenhain's blocks, as far as our posts write them. Its reader ends with the first error.
int check_klartext(const GcodeOptions& options, std::string_view text) {
    std::vector<gcode::WrittenStep> steps;
    std::vector<Diagnostic> errors;
    try {
        steps = gcode::read_written_klartext(text, options.file, {});
    } catch (const Error& error) {
        errors.push_back(error.diagnostic());
        errors.back().hint = "Millwright reads only the Klartext blocks that its posts write";
    }
    const auto moves = std::ranges::count_if(steps, [](const gcode::WrittenStep& step) {
        return step.kind == gcode::StepKind::rapid || step.kind == gcode::StepKind::feed ||
               step.kind == gcode::StepKind::arc;
    });
    const std::ptrdiff_t lines = gcode::LineIndex(text, Progress()).count();
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["lines"] = lines;
        answer["moves"] = moves;
        answer["errors"] = diagnostics_json(errors);
        fmt::print("{}\n", answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    } else {
        for (const Diagnostic& error : errors) {
            fmt::print(stderr, "millwright: {}\n", to_text(error));
        }
        fmt::print("{} of {}, {}, {}\n",
                   counted(lines, "line"),
                   name_of(gcode::Language::klartext),
                   counted(moves, "move"),
                   counted(errors.size(), "error"));
    }
    return errors.empty() ? 0 : 1;
}

int check(const GcodeOptions& options) {
    if (const std::optional<std::string> text = klartext_in(options.file)) {
        return check_klartext(options, gcode::program_text(*text));
    }
    gcode::ReaderSettings settings = reader_settings(options);
    settings.most_errors = most_errors_shown;
    settings.read_on = true;
    MoveCounter moves;
    gcode::Interpreter program(options.file, std::move(settings), moves);
    program.run();
    if (options.json) {
        print_program_json(program, moves.count());
    } else {
        print_end_notice(program);
        for (const Diagnostic& error : program.errors()) {
            fmt::print(stderr, "millwright: {}\n", to_text(error));
        }
        if (program.further_errors() > 0) {
            fmt::print(stderr,
                       "millwright: {}: {} not listed\n",
                       options.file,
                       counted(program.further_errors(), "more error is", "more errors are"));
        }
        fmt::print("{}, {}, {}\n",
                   counted(program.line_count(), "line"),
                   counted(moves.count(), "move"),
                   counted(std::ssize(program.errors()) + program.further_errors(), "error"));
    }
    return program.errors().empty() ? 0 : 1;
}

/// As rs274 does: tool table and parameters in inch, the first error is the last.
int canon(const GcodeOptions& options) {
    gcode::ReaderSettings settings = reader_settings(options);
    settings.machine_unit = gcode::LengthUnit::inch;
    if (options.tools.empty()) {
        settings.tools = gcode::parse_tool_table(rs274_tools, "rs274's tool table");
        settings.any_tool = false;
    }
    gcode::CanonPrinter printer(
        [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); });
    gcode::Interpreter program(options.file, std::move(settings), printer);
    program.run();
    printer.flush();
    if (!program.errors().empty()) {
        throw Error(program.errors().front());
    }
    return 0;
}

/// The first thing that is wrong: in the program, or that the machine cannot do.
void throw_first(const std::vector<Diagnostic>& errors) {
    if (!errors.empty()) {
        throw Error(errors.front());
    }
}

/// A program as its machine executes it. Throws Error with the first thing that is wrong.
struct MachineRun {
    kinematics::MachineModel machine;
    gcode::MachineProgram found;
};

/// Of a Grbl nothing comes at the end of its text.
void end_program(program::Program& program) {
    program::Block end;
    end.kind = program::BlockKind::end;
    end.target = program.blocks.empty() ? program.start : program.blocks.back().target;
    program.blocks.push_back(std::move(end));
}

/// Which speeds of the spindle become blocks: those of its starts, or each S too.
enum class SpindleSpeeds { of_starts, each };

MachineRun machine_run(const GcodeOptions& options, SpindleSpeeds speeds) {
    auto machine = kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder()));
    gcode::MachineProgramSettings making;
    making.chord_length = options.chord_length;
    making.keeps_speed_changes = speeds == SpindleSpeeds::each;
    gcode::MachineProgramBuilder builder(machine, options.file, making);
    gcode::Interpreter program(options.file, reader_settings(options), builder);
    program.run();
    throw_first(program.errors());
    gcode::MachineProgram found = builder.take();
    throw_first(found.faults);
    if (program.end_notice()) {
        print_end_notice(program);
        end_program(found.program);
    }
    return {std::move(machine), std::move(found)};
}

/// Whose lines are those of `file`.
PostedText posted_from(const std::string& file,
                       const program::Program& program,
                       const kinematics::MachineModel& machine,
                       const PostChoice& post,
                       const std::string& remark) {
    try {
        return posted(program, machine, post, std::filesystem::path(file).stem().string(), remark);
    } catch (const Error& error) {
        Diagnostic found = error.diagnostic();
        if (found.place.line > 0 && found.place.file.empty()) {
            found.place.file = file;
        }
        throw Error(std::move(found));
    }
}

/// That the comments of the file name, which are not taken along otherwise. What can be read but once has
/// none.
std::vector<program::ProgramCutter> cutters_named_in(const std::string& file) {
    std::vector<program::ProgramCutter> cutters;
    std::error_code none;
    if (std::filesystem::is_regular_file(file, none)) {
        for (const gcode::CommentTool& tool : gcode::tools_in_comments(read_file(file))) {
            cutters.push_back({.number = tool.number.value_or(0), .diameter = tool.diameter});
        }
    }
    return cutters;
}

/// At the top of a program whose work has been placed on the machine: who runs it sees no warning of ours.
constexpr const char* machine_positions_remark =
    "all positions are machine positions: run with a work offset of zero";

/// For another control.
int convert_gcode(const GcodeOptions& options) {
    MachineRun run = machine_run(options, SpindleSpeeds::each);
    run.found.program.cutters = cutters_named_in(options.file);
    throw_first(run.found.lost);
    throw_first(run.found.unplaced);
    for (const Diagnostic& simplified : run.found.simplified) {
        fmt::print(stderr, "warning: {}\n", to_text(simplified));
    }
    if (run.found.start_notice) {
        fmt::print(stderr, "warning: {}\n", to_text(*run.found.start_notice));
    }
    const bool spindle_turns = std::ranges::any_of(run.found.program.blocks, [](const program::Block& block) {
        return block.kind == program::BlockKind::spindle_on;
    });
    if (!spindle_turns && run.found.first_rpm > 0.0) {
        fmt::print(stderr,
                   "warning: {}: the program sets a spindle speed, {:g} 1/min, but never starts the spindle "
                   "(M3): the speed is left out\n",
                   options.file,
                   run.found.first_rpm);
    }
    if (!options.origin.empty()) {
        fmt::print(stderr,
                   "warning: {}: the positions are machine coordinates, because --origin places the work "
                   "there: run the program with a work offset (G54) of zero\n",
                   options.file);
    }
    const PostedText result = posted_from(options.file,
                                          run.found.program,
                                          run.machine,
                                          options.post,
                                          options.origin.empty() ? std::string() : machine_positions_remark);
    print_notes(result);
    const std::string& text = result.text.listing.text;
    if (options.out.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
    } else {
        write_file(options.out, text);
    }
    return 0;
}

/// The blocks of a G-code file for a machine, a thousand at a time.
class BlockStream {
public:
    /// `text`: the file's, if it can be read only once.
    BlockStream(const GcodeOptions& options,
                const kinematics::MachineModel& machine,
                const std::optional<std::string>& text)
        : builder_(machine, options.file, settings()),
          reader_(text ? gcode::Interpreter(*text, options.file, reader_settings(options), builder_)
                       : gcode::Interpreter(options.file, reader_settings(options), builder_)) {}

    /// False at the end of the file.
    [[nodiscard]] bool next(std::vector<program::Block>& blocks) {
        blocks.clear();
        constexpr int lines = 1000;
        bool more = true;
        for (int n = 0; n < lines && more; ++n) {
            more = reader_.step();
        }
        builder_.take_blocks(blocks);
        return more;
    }
    [[nodiscard]] const std::vector<Diagnostic>& errors() const { return reader_.errors(); }
    [[nodiscard]] std::optional<Diagnostic> end_notice() const { return reader_.end_notice(); }
    [[nodiscard]] int block_count() const { return builder_.block_count(); }
    [[nodiscard]] gcode::MachineProgram rest() { return builder_.take(); }

private:
    static gcode::MachineProgramSettings settings() {
        gcode::MachineProgramSettings settings;
        settings.most_blocks = std::numeric_limits<int>::max(); // none is kept
        return settings;
    }

    gcode::MachineProgramBuilder builder_;
    gcode::Interpreter reader_;
};

/// Reads as much as it takes to know: of most programs the first lines.
motion::FilterTime filter_time(const GcodeOptions& options,
                               const kinematics::MachineModel& machine,
                               const kinematics::AxisPositions& start,
                               const std::optional<std::string>& text) {
    motion::FilterTime filter(machine, start);
    BlockStream stream(options, machine, text);
    std::vector<program::Block> blocks;
    for (bool more = true; more && !filter.settled();) {
        more = stream.next(blocks);
        for (const program::Block& block : blocks) {
            filter.add(block);
        }
    }
    if (!filter.settled()) {
        for (const program::Block& block : stream.rest().program.blocks) {
            filter.add(block);
        }
    }
    return filter;
}

struct EstimatedTime {
    double seconds = 0.0;
    double length = 0.0; ///< mm
    int blocks = 0;
    std::vector<Diagnostic> warnings; ///< what was taken for 0, and ways beyond the travel
};

/// How long the machine takes: the duration of the motion that is planned for it. Throws Error with the first
/// thing that is wrong.
EstimatedTime estimated_time(const GcodeOptions& options) {
    const auto machine = kinematics::read_machine(
        project::machine_path(options.machine, std::filesystem::current_path(), project::assets_folder()));
    const auto start = gcode::MachineProgramBuilder(machine, options.file).take().program.start;
    std::error_code none;
    const std::optional<std::string> text =
        std::filesystem::is_fifo(options.file, none) ? std::optional(read_file(options.file)) : std::nullopt;
    motion::TimeEstimate estimate(
        machine, planner_settings(options), start, filter_time(options, machine, start, text));
    BlockStream stream(options, machine, text);
    std::vector<program::Block> blocks;
    for (bool more = true; more;) {
        more = stream.next(blocks);
        for (const program::Block& block : blocks) {
            estimate.add(block);
        }
    }
    throw_first(stream.errors());
    const int count = stream.block_count();
    const gcode::MachineProgram rest = stream.rest();
    throw_first(rest.faults);
    for (const program::Block& block : rest.program.blocks) {
        estimate.add(block);
    }
    std::vector<Diagnostic> warnings = rest.unknown_positions();
    if (std::optional<Diagnostic> notice = stream.end_notice()) {
        warnings.push_back(std::move(*notice));
    }
    warnings.insert(warnings.end(), rest.beyond_travel.begin(), rest.beyond_travel.end());
    return {estimate.finish(), rest.length, count, std::move(warnings)};
}

int time(const GcodeOptions& options) {
    const EstimatedTime found = estimated_time(options);
    print_warnings(found.warnings);
    if (options.json) {
        nlohmann::ordered_json answer;
        answer["time_s"] = found.seconds;
        answer["length_mm"] = found.length;
        answer["blocks"] = found.blocks;
        answer["warnings"] = diagnostics_json(found.warnings);
        fmt::print("{}\n", answer.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    } else {
        fmt::print("{} ({:.3f} s), {:.1f} mm, {}\n",
                   clock_time(found.seconds),
                   found.seconds,
                   found.length,
                   counted(found.blocks, "block"));
    }
    return 0;
}

int pulses(const GcodeOptions& options) {
    const MachineRun run = machine_run(options, SpindleSpeeds::of_starts);
    print_warnings(run.found.unknown_positions());
    const motion::Trajectory trajectory =
        motion::plan(run.found.program, run.machine, planner_settings(options), Progress());
    return report_pulses(trajectory, run.found.program, options.pulses, options.file, options.json);
}

} // namespace

void add_gcode_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<GcodeOptions>();
    CLI::App& group = *app.add_subcommand("gcode", "Check, analyse or convert a G-code program");
    group.require_subcommand(1);
    CLI::App& checking = add_reader_options(group, "check", "Check for errors", options);
    checking.add_flag("--json", options->json, "Print the result as JSON");
    checking.callback([&chosen, options] { chosen = [options] { return check(*options); }; });
    CLI::App& printing = add_reader_options(
        group, "canon", "Print the machine's actions, in the format of LinuxCNC's rs274", options);
    CLI::App& timing = add_reader_options(group, "time", "Estimate machining time", options);
    add_motion_options(timing, options);
    CLI::App& stepping =
        add_reader_options(group, "pulses", "Report the step pulses of a machine and their jitter", options);
    add_motion_options(stepping, options);
    add_pulse_options(stepping, options->pulses);
    CLI::App& converting =
        add_reader_options(group,
                           "convert",
                           "Convert for another control; the result is read back before it is released",
                           options);
    converting.add_option("--machine", options->machine, "Shipped machine or machine file")->required();
    add_origin_option(converting, options->origin);
    converting.add_option("--out", options->out, "Output file (default: standard output)")->type_name("FILE");
    constexpr double shortest_chord = 1e-3;
    constexpr double longest_chord = 1e3;
    converting
        .add_option("--chord-length",
                    options->chord_length,
                    "Divide arcs into equal chords no longer than this, mm, as in the thesis of 2006")
        ->check(CLI::Range(shortest_chord, longest_chord));
    options->post.tip_tolerance = 0.01;
    converting
        .add_option("--tip-tolerance",
                    options->post.tip_tolerance,
                    "For posts that keep the tool tip: divide feed moves until the tip is this close to the "
                    "path of linear axis moves, mm (0: do not divide)")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
    add_post_options(converting, options->post).required();
    converting.callback([&chosen, options] { chosen = [options] { return convert_gcode(*options); }; });
    timing.callback([&chosen, options] { chosen = [options] { return time(*options); }; });
    stepping.callback([&chosen, options] { chosen = [options] { return pulses(*options); }; });
    printing.callback([&chosen, options] { chosen = [options] { return canon(*options); }; });
}

} // namespace millwright::app
