#include "app/simulation/simulated_work.h"

#include "app/command_line/command.h"
#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "app/gcode/gcode_options.h"
#include "app/simulation/named_tool.h"
#include "app/simulation/simulated_collisions.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"
#include "core/gcode_programs/tool_calls.h"
#include "core/kinematics/machine_file.h"
#include "core/plan/part_bodies.h"
#include "core/plan/part_stock.h"
#include "core/project/assets.h"
#include "core/project/tool_file.h"
#include "core/project/tool_settings.h"
#include "core/simulation/spec_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace millwright::app {

namespace {

namespace fs = std::filesystem;
using simulation::ToolUse;

/// The tool for T `number`: the one of that number, or the only one if it has none.
const NamedTool* tool_for(const std::vector<NamedTool>& tools, int number, bool only_call) {
    for (const NamedTool& tool : tools) {
        if (tool.number == number) {
            return &tool;
        }
    }
    const bool alone = tools.size() == 1 && !tools.front().number;
    return alone && only_call ? &tools.front() : nullptr;
}

[[noreturn]] void throw_no_tool(const fs::path& file, int number, int line) {
    throw Error(Diagnostic{{file, line, 0, -1},
                           fmt::format("the program calls tool {}, and no tool {} is named", number, number),
                           fmt::format("add --tool {}=SPEC, such as {}=flat:6", number, number)});
}

/// Which of `tools` is in the spindle from which block on.
void take_tools(const std::vector<gcode::ToolCall>& calls,
                const std::vector<NamedTool>& tools,
                SimulatedWork& work) {
    const int highest = std::ranges::max(calls, {}, &gcode::ToolCall::number).number;
    const bool same = std::ranges::all_of(
        calls, [&](const gcode::ToolCall& call) { return call.number == 0 || call.number == highest; });
    for (const gcode::ToolCall& change : calls) {
        if (change.empty) { // T0 M6
            work.tools.push_back({change.first_block, 0, std::nullopt});
            continue;
        }
        const NamedTool* tool = tool_for(tools, change.number, same);
        if (tool == nullptr && change.number == 0 && tools.size() == 1) {
            tool = &tools.front(); // the program calls none, and one is named
        }
        if (tool == nullptr && change.number == 0) {
            throw UsageError(
                "the program calls no tool, and more than one is named", work.file, "name one tool");
        }
        if (tool == nullptr) {
            throw_no_tool(work.file, change.number, change.line);
        }
        work.tools.push_back(
            {change.first_block, change.number, tool->body, tool->machine, tool->shank, tool->holder});
        const std::string text =
            change.number == 0 ? tool->text : fmt::format("T{}: {}", change.number, tool->text);
        if (std::ranges::find(work.tool_texts, text) == work.tool_texts.end()) {
            work.tool_texts.push_back(text);
        }
    }
}

void throw_first_of(const std::vector<Diagnostic>& errors) {
    if (!errors.empty()) {
        throw Error(errors.front());
    }
}

void take_stock(const plan::NamedStock& stock, SimulatedWork& work) {
    work.stock = stock.stock;
    work.stock_text = stock.text;
}

gcode::ReaderSettings reader_settings(const SimulateOptions& options,
                                      const kinematics::MachineModel& machine) {
    GcodeOptions reading;
    reading.dialect = options.dialect.empty() ? "linuxcnc" : options.dialect;
    reading.axes.clear();
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        reading.axes += axis.letter;
    }
    reading.subroutines = options.subroutines;
    reading.block_delete = options.block_delete;
    reading.origin = options.origin;
    return reader_settings(reading);
}

SimulatedWork work_of_program(const SimulateOptions& options, const Progress& progress) {
    if (options.machine.empty() || options.stock.empty() || options.tools.empty()) {
        throw UsageError("a G-code file is simulated with a machine, a stock and a tool",
                         options.file,
                         "add --machine NAME, --stock SPEC and --tool SPEC");
    }
    const fs::path machine_file =
        project::machine_path(options.machine, fs::current_path(), project::assets_folder());
    SimulatedWork work{.file = options.file,
                       .program_file = options.file,
                       .program_text = {},
                       .machine = kinematics::read_machine(machine_file),
                       .program = {},
                       .tools = {},
                       .tool_texts = {},
                       .stock = simulation::BoxStock{},
                       .stock_text = {},
                       .warnings = {}};
    work.machine_file = machine_file;
    std::vector<NamedTool> tools;
    for (const std::string& text : options.tools) {
        tools.push_back(plan::named_tool(text, work.machine, work.warnings));
    }
    expect_different_numbers(tools);
    take_flutes(options.flutes, tools);
    take_stock(plan::stock_from(options.stock, progress), work);
    gcode::MachineProgramSettings making;
    making.chord_tolerance = 0.5 * simulation::tip_tolerance;
    gcode::MachineProgramBuilder builder(work.machine, options.file, making);
    gcode::ToolCallRecorder recorder(builder);
    gcode::Interpreter reader(options.file, reader_settings(options, work.machine), recorder);
    constexpr int lines_per_check = 4096;
    bool more = true;
    for (int line = 0; more; ++line) {
        more = reader.step();
        if (line % lines_per_check == 0) {
            progress.check();
        }
    }
    throw_first_of(reader.errors());
    gcode::MachineProgram made = builder.take();
    throw_first_of(made.faults);
    throw_first_of(made.lost);
    for (const Diagnostic& unknown : made.unknown_positions()) {
        work.warnings.push_back(to_text(unknown));
    }
    work.program = std::move(made.program);
    take_tools(recorder.calls(work.file), tools, work);
    for (const NamedTool& tool : tools) {
        if (tool.number &&
            std::ranges::find(work.tools, *tool.number, &ToolUse::number) == work.tools.end()) {
            work.warnings.push_back(fmt::format("the program never changes to tool {}", *tool.number));
        }
    }
    return work;
}

/// As the option says, else as the project does. Throws Error, of the project's own stock with the file.
plan::NamedStock stock_of_project(const SimulateOptions& options,
                                  const project::StockInput& input,
                                  const geometry::Surface& surface,
                                  const Progress& progress) {
    if (!options.stock.empty()) {
        return plan::stock_from(options.stock, progress);
    }
    if (input.around_part) {
        return plan::stock_around(surface, input.allowance_mm);
    }
    try {
        return plan::stock_from(plan::stock_text(input), progress);
    } catch (const Error& error) {
        throw Error("stock: " + error.diagnostic().message, options.file, error.diagnostic().hint);
    }
}

/// Throws UsageError for options that say how G-code is read.
void expect_no_reading(const SimulateOptions& options) {
    const std::array<std::pair<bool, const char*>, 4> given{{{!options.origin.empty(), "--origin"},
                                                             {!options.dialect.empty(), "--dialect"},
                                                             {!options.subroutines.empty(), "--subroutines"},
                                                             {options.block_delete, "--block-delete"}}};
    for (const auto& [is_given, name] : given) {
        if (is_given) {
            throw UsageError(fmt::format("{} is for G-code files, and a project is none", name),
                             options.file,
                             fmt::format("leave {} out", name));
        }
    }
}

/// In place of the project's tool, where --tool names one.
void take_tool_file(const SimulateOptions& options, project::Project& project) {
    if (options.tools.size() > 1) {
        throw UsageError("a project is cut with one tool", options.file, "name one tool file");
    }
    if (options.tools.empty()) {
        return;
    }
    const simulation::ToolText parsed = simulation::parse_tool(options.tools.front());
    if (parsed.body) {
        throw UsageError("the program of a project is made for its tool",
                         options.file,
                         "give a tool file, from which the program is made anew");
    }
    project.tool = project::read_tool(parsed.file);
}

SimulatedWork
work_of_project(const SimulateOptions& options, const std::stop_token& stop, const Progress& progress) {
    if (!options.machine.empty()) {
        throw UsageError("a project names its own machine", options.file, "leave --machine out");
    }
    expect_no_reading(options);
    OpenedProject opened = open_project(options.file);
    take_tool_file(options, opened.project);
    const toolpath::Tool tool = project::tool_of(opened.project.tool);
    if (!tool.cutter) {
        throw Error("the project's tool is a point, which removes nothing",
                    options.file,
                    "name a tool file with --tool");
    }
    const plan::Plan plan = planned(opened, plan::Scope::program, stop);
    SimulatedWork work{.file = options.file,
                       .program_file = fs::path(options.out) / "program.ngc",
                       .program_text = plan.listing->text,
                       .machine = plan.cutting_setup->machine,
                       .program = *plan.program,
                       .tools = {{.first_block = 0,
                                  .number = opened.project.tool.number,
                                  .body = *tool.cutter,
                                  .holder = tool.holder}},
                       .tool_texts = {project::tool_text(opened.project.tool)},
                       .stock = simulation::BoxStock{},
                       .stock_text = {},
                       .warnings = {}};
    work.machine_file = project::machine_path(
        opened.project, fs::absolute(options.file).parent_path(), project::assets_folder());
    if (options.part.empty()) {
        work.part = plan::part_surface(*plan.cutting_setup);
        for (simulation::CollisionBody& body :
             plan::face_bodies(work.machine, opened.project.surface, *plan.surface)) {
            work.bodies.push_back(std::move(body));
        }
    }
    if (!options.flutes.empty()) {
        std::vector<NamedTool> tools{{std::nullopt, *tool.cutter, {}}};
        take_flutes(options.flutes, tools);
        work.tools.front().body = tools.front().body;
        work.tools.front().shank = tools.front().shank;
    }
    for (std::size_t n = 0; n < work.program.blocks.size(); ++n) {
        work.program.blocks[n].source_line = plan.listing->line_of_block[n];
    }
    take_stock(stock_of_project(options, opened.project.stock, *plan.surface, progress), work);
    return work;
}

bool is_project(const fs::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(
        extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".json";
}

} // namespace

std::vector<fs::path> input_files(const SimulateOptions& options) {
    std::vector<fs::path> files{options.file};
    if (!options.part.empty()) {
        files.emplace_back(options.part);
    }
    if (!options.stock.empty()) {
        const simulation::StockText stock = simulation::parse_stock(options.stock);
        if (!stock.stock) {
            files.emplace_back(stock.mesh_file);
        }
    }
    if (options.stock.empty() && is_project(options.file)) {
        const project::StockInput stock = open_project(options.file).project.stock;
        if (!stock.around_part && !stock.file.empty()) {
            files.push_back(stock.file);
        }
    }
    for (const std::string& text : options.tools) {
        const simulation::ToolText tool = simulation::parse_tool(text);
        if (!tool.body) {
            files.emplace_back(tool.file);
        }
    }
    for (const std::string& text : options.fixtures) {
        files.push_back(parse_fixture(text).file);
    }
    if (!options.machine.empty()) {
        files.push_back(project::machine_path(options.machine, fs::current_path(), project::assets_folder()));
    }
    return files;
}

SimulatedWork simulated_work(const SimulateOptions& options, const std::stop_token& stop) {
    const Progress progress({}, stop);
    SimulatedWork work = is_project(options.file) ? work_of_project(options, stop, progress)
                                                  : work_of_program(options, progress);
    if (!options.part.empty()) {
        work.part = plan::part_surface(options.part, progress);
        add_part(options.part, work, progress);
    }
    take_bodies(options, work, progress);
    return work;
}

} // namespace millwright::app
