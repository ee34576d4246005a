#include "core/gcode_programs/cut_program.h"

#include "core/gcode/interpreter.h"
#include "core/gcode/program_text.h"
#include "core/gcode_programs/internal/cut_program_builder.h"
#include "core/gcode_programs/machine_program.h"
#include "core/plot/plot_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <utility>

namespace millwright::gcode {

namespace {

void throw_first(const std::vector<Diagnostic>& found) {
    if (!found.empty()) {
        throw Error(found.front());
    }
}

/// A tool without a diameter would leave the contour where it is.
void expect_known_diameter(const Interpreter& interpreter, const std::filesystem::path& file) {
    const CutterCompensation& cutter = interpreter.state().cutter;
    if (cutter.on() && !(cutter.radius > 0.0)) {
        throw Error(Diagnostic{.place = {.file = file, .line = interpreter.place().line},
                               .message = "cutter compensation is used, but the tool diameter is unknown",
                               .hint = "give the tool table with --tools"});
    }
}

/// The blocks of a program, and which tool each change brings: they do not say.
class ProgramAndTools final : public CanonSink {
public:
    ProgramAndTools(const kinematics::MachineModel& machine,
                    const std::filesystem::path& file,
                    const CutProgramSettings& settings)
        : builder_(machine,
                   file,
                   {.chord_tolerance = settings.chord_tolerance,
                    .chord_length = settings.chord_length,
                    .keeps_speed_changes = true,
                    .most_blocks = plot::most_program_points}) {}

    void move(const Move& move, const SourceLine& now) override { builder_.move(move, now); }
    void curve(const Curve& curve, const SourceLine& now) override { builder_.curve(curve, now); }
    void command(const Command& command, const SourceLine& now) override {
        if (command.kind == CommandKind::select_tool) {
            selected_ = command.index;
        } else if (command.kind == CommandKind::change_tool) {
            tools_[static_cast<std::size_t>(builder_.block_count())] = selected_;
        }
        builder_.command(command, now);
    }

    [[nodiscard]] MachineProgram take() { return builder_.take(); }
    /// That block `n` brings; 0: none.
    [[nodiscard]] int tool_of(std::size_t n) const {
        const auto found = tools_.find(n);
        return found == tools_.end() ? 0 : found->second;
    }

private:
    MachineProgramBuilder builder_;
    int selected_ = 0;
    std::map<std::size_t, int> tools_; ///< by block
};

/// A word of G-code is a letter and a number, of a parameter # and one or its name; a program's number may
/// have a colon before it. Commands of HPGL have two letters.
bool begins_with_word(std::string_view line) {
    constexpr std::string_view letters = "NGMTFSOXYZ#:";
    if (line.empty() || letters.find(static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])))) ==
                            std::string_view::npos) {
        return false;
    }
    const auto number = line.find_first_not_of(" \t", 1);
    return number != std::string_view::npos &&
           std::string_view("0123456789.+-#[<").find(line[number]) != std::string_view::npos;
}

ReaderSettings reader_settings(const CutProgramSettings& settings) {
    ReaderSettings reading;
    reading.tools = settings.tools.value_or(ToolTable());
    reading.any_tool = !settings.tools;
    reading.may_lack_end = true;
    reading.block_delete = settings.block_delete;
    reading.parameters = settings.parameters;
    if (settings.origin) {
        put_origin(reading, *settings.origin);
    }
    return reading;
}

/// Back to positions of the work.
void take_off(program::Program& program, const Vec3& origin) {
    program.start -= origin;
    for (program::Block& block : program.blocks) {
        block.target -= origin;
    }
}

CutProgram made_of(MachineProgram read,
                   const ProgramAndTools& tools,
                   const std::filesystem::path& file,
                   const CutProgramSettings& settings) {
    throw_first(read.faults);
    throw_first(read.lost);
    take_off(read.program, settings.origin.value_or(WorkOrigin()).at());
    internal::CutProgramBuilder cut(read.program, file, settings.safe_height);
    for (std::size_t n = 0; n < read.program.blocks.size(); ++n) {
        cut.add(read.program.blocks[n], tools.tool_of(n));
    }
    CutProgram made = cut.take();
    made.unplaced.insert(made.unplaced.begin(), read.unplaced.begin(), read.unplaced.end());
    for (const auto* found : {&made.unplaced, &read.simplified}) {
        made.notices.insert(made.notices.begin(), found->begin(), found->end());
    }
    if (!(made.spindle_rpm > 0.0) && read.first_rpm > 0.0) {
        made.spindle_rpm = read.first_rpm;
        made.notices.push_back({{file},
                                fmt::format("the program sets a spindle speed, {:g} 1/min, but never starts "
                                            "the spindle (M3); here the spindle is started",
                                            read.first_rpm),
                                {}});
    }
    if (made.strokes.empty()) {
        throw Error(made.safe_height
                        ? fmt::format("the program has no cuts below z {:.3f} mm", *made.safe_height)
                        : "the program has no cuts",
                    file);
    }
    return made;
}

/// `begin` makes the interpreter for a sink.
template <class Begin>
CutProgram
read_by(const Begin& begin, const std::filesystem::path& file, const CutProgramSettings& settings) {
    const kinematics::MachineModel machine = xyz_machine();
    ProgramAndTools sink(machine, file, settings);
    Interpreter interpreter = begin(sink);
    while (interpreter.step()) {
        expect_known_diameter(interpreter, file);
    }
    throw_first(interpreter.errors());
    CutProgram made = made_of(sink.take(), sink, file, settings);
    made.lines = interpreter.line_count();
    if (auto notice = interpreter.end_notice()) {
        made.notices.push_back(std::move(*notice));
    }
    return made;
}

} // namespace

plot::PathLengths named_lengths(const CutProgram& program) {
    if (!program.lowers_unasked) {
        return plot::lengths(program.path);
    }
    plot::CutPath path(program.path.begin() + 1, program.path.end());
    path.front().move = plot::CutMove::rapid;
    path.front().speed = 0.0;
    return plot::lengths(path);
}

CutProgram read_cut_program(std::string_view text,
                            const std::filesystem::path& file,
                            const CutProgramSettings& settings) {
    return read_by([&](CanonSink& sink) { return Interpreter(text, file, reader_settings(settings), sink); },
                   file,
                   settings);
}

CutProgram read_cut_program_file(const std::filesystem::path& file, const CutProgramSettings& settings) {
    return read_by(
        [&](CanonSink& sink) { return Interpreter(file, reader_settings(settings), sink); }, file, settings);
}

bool is_gcode(std::string_view text) {
    text = program_text(text);
    while (!text.empty()) {
        const auto end = std::min(text.find_first_of("\r\n"), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const auto first = line.find_first_not_of(" \t/");
        line.remove_prefix(std::min(first, line.size()));
        if (!line.empty() && line != "%" && line.front() != ';' && line.front() != '(') {
            return begins_with_word(line);
        }
    }
    return false;
}

} // namespace millwright::gcode
