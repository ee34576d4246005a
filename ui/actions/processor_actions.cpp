#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/processor_workspace.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

Permission can_execute(const FrameState& now) {
    if (now.view_state.workspace != Workspace::processor) {
        return Permission::refused("Available only in the Processor workspace (F7).");
    }
    if (now.processor.failure()) {
        return Permission::refused("The processor cannot execute this program: see the inspector.");
    }
    return {};
}

Permission can_go_on(const FrameState& now) {
    const Permission able = can_execute(now);
    if (able.allowed && now.processor.debugger().state().stop != cordic::Stop::none) {
        return Permission::refused("The processor is halted. Reset it to begin again.");
    }
    return able;
}

Permission runs(const FrameState& now) {
    return now.processor.running() ? Permission{} : Permission::refused("The processor is not running.");
}

Permission has_gcode_file(const FrameState& now) {
    return now.opened_file ? Permission{} : Permission::refused("Open a G-code file first.");
}

Permission has_program(const FrameState& now) {
    if (!now.listing()) {
        return Permission::refused("The project has no program yet.");
    }
    return now.program_is_final() ? Permission{}
                                  : Permission::refused("The program is still being computed.");
}

Permission in_processor(const FrameState& now) {
    return now.view_state.workspace == Workspace::processor
               ? Permission{}
               : Permission::refused("Available only in the Processor workspace (F7).");
}

Permission has_assembler(const FrameState& now) {
    return now.processor.written().input().assembler.empty()
               ? Permission::refused("There is no assembly source yet: write or open one under Assembler.")
               : Permission{};
}

Permission has_microprogram(const FrameState& now) {
    return now.processor.written().input().microprogram.empty()
               ? Permission::refused("There is no microprogram yet: copy the built-in one, or open one.")
               : Permission{};
}

/// Back to the processor's own in any case.
Permission can_turn_microprogram(const FrameState& now) {
    return now.processor.choice().own_microprogram ? Permission{} : has_microprogram(now);
}

void turn_own_microprogram(ActionContext& context) {
    ProcessorWorkspace& workspace = context.app.processor();
    ProcessorChoice choice = workspace.choice();
    choice.own_microprogram = !choice.own_microprogram;
    workspace.set(choice);
}

template <FilePrompt prompt> void ask_for_processor_file(ActionContext& context) {
    context.view_state.file_prompt = prompt;
}

template <ProcessorStep step> void do_step(ActionContext& context) {
    context.app.processor().step(step);
}

template <ProcessorSource source> void load(ActionContext& context) {
    context.view_state.workspace = Workspace::processor;
    context.app.load_processor(source);
}

template <ProcessorSource source> bool is_loaded(const FrameState& now) {
    return now.processor.choice().source == source;
}

void add_steps(Actions& actions) {
    constexpr std::string_view menu = "Processor";
    add(actions,
        {"processor.reset",
         menu,
         "Reset",
         "Restores the state after power-on; breakpoints stay.",
         "",
         icons::reset},
        can_execute,
        [](ActionContext& context) { context.app.processor().reset(); });
    add(actions,
        {"processor.clock", menu, "Step one clock", "Executes one clock of the processor.", "Ctrl+1", ""},
        can_go_on,
        do_step<ProcessorStep::clock>);
    add(actions,
        {"processor.micro",
         menu,
         "Step one micro-instruction",
         "Executes up to another micro-instruction; a loop of one is one step.",
         "Ctrl+2",
         ""},
        can_go_on,
        do_step<ProcessorStep::micro_instruction>);
    add(actions,
        {"processor.instruction",
         menu,
         "Step one instruction",
         "Executes up to the next fetch.",
         "Ctrl+3",
         ""},
        can_go_on,
        do_step<ProcessorStep::instruction>);
    add(actions,
        {"processor.block",
         menu,
         "Step one block",
         "Executes up to the next line of the program.",
         "Ctrl+5",
         ""},
        can_go_on,
        do_step<ProcessorStep::block>);
    add(actions,
        {"processor.set_point",
         menu,
         "Run to the next set-point",
         "Runs until position, speed and acceleration are output.",
         "Ctrl+6",
         icons::step_forward},
        can_go_on,
        do_step<ProcessorStep::set_point>);
    add(actions,
        {"processor.run", menu, "Run", "Runs to a breakpoint or to the end.", "Ctrl+7", icons::play},
        can_go_on,
        [](ActionContext& context) { context.app.processor().run(); });
    add(actions,
        {"processor.pause", menu, "Pause", "Stops between two clocks.", "Ctrl+8", icons::pause},
        runs,
        [](ActionContext& context) { context.app.processor().pause(); });
}

void add_assembler_texts(Actions& actions) {
    constexpr std::string_view menu = "Processor";
    add(actions,
        {"processor.assembler",
         menu,
         "Execute the assembly source",
         "Executes the text under Assembler.",
         "",
         ""},
        has_assembler,
        load<ProcessorSource::assembler>,
        is_loaded<ProcessorSource::assembler>);
    add(actions,
        {"processor.take_over",
         menu,
         "Copy to the assembly source",
         "Replaces the present text under Assembler with the executed program, for editing.",
         "",
         ""},
        can_execute,
        [](ActionContext& context) { context.app.take_over_assembler(); });
    add(actions,
        {"processor.open_assembler",
         menu,
         "Open assembly source or a ROM image",
         "Replaces the present text; an image is disassembled.",
         "",
         icons::folder},
        in_processor,
        ask_for_processor_file<FilePrompt::open_assembler>);
    add(actions,
        {"processor.save_assembler",
         menu,
         "Save the assembly source",
         "Saves it to a separate file.",
         "",
         icons::save},
        has_assembler,
        ask_for_processor_file<FilePrompt::save_assembler>);
    add(actions,
        {"processor.save_image",
         menu,
         "Save the ROM image",
         "Saves the bytes of the executed program, with its number format.",
         "",
         icons::save},
        can_execute,
        ask_for_processor_file<FilePrompt::save_image>);
}

void add_microprogram_texts(Actions& actions) {
    constexpr std::string_view menu = "Processor";
    add(actions,
        {"processor.own_microprogram",
         menu,
         "Execute the edited microprogram",
         "Replaces the built-in microprogram; use it again to return to the built-in one.",
         "",
         ""},
        can_turn_microprogram,
        turn_own_microprogram,
        [](const FrameState& now) { return now.processor.choice().own_microprogram; });
    add(actions,
        {"processor.start_microprogram",
         menu,
         "Copy the built-in microprogram",
         "Replaces the present text with a copy of the processor's own microprogram, for editing.",
         "",
         ""},
        in_processor,
        [](ActionContext& context) { context.app.start_microprogram(); });
    add(actions,
        {"processor.open_microprogram",
         menu,
         "Open a microprogram",
         "Replaces the present text.",
         "",
         icons::folder},
        in_processor,
        ask_for_processor_file<FilePrompt::open_microprogram>);
    add(actions,
        {"processor.save_microprogram",
         menu,
         "Save the microprogram",
         "Saves it to a separate file.",
         "",
         icons::save},
        has_microprogram,
        ask_for_processor_file<FilePrompt::save_microprogram>);
}

void add_texts(Actions& actions) {
    add_assembler_texts(actions);
    add_microprogram_texts(actions);
}

} // namespace

void add_processor_actions(Actions& actions) {
    constexpr std::string_view menu = "Processor";
    add_steps(actions);
    add(actions,
        {"processor.thesis_arc", menu, "Load the thesis's arc", "Loads three quarters of a turn.", "", ""},
        always,
        load<ProcessorSource::thesis_arc>,
        is_loaded<ProcessorSource::thesis_arc>);
    add(actions,
        {"processor.thesis_path",
         menu,
         "Load the thesis's path",
         "Loads lines and two arcs, experiment E7.",
         "",
         ""},
        always,
        load<ProcessorSource::thesis_path>,
        is_loaded<ProcessorSource::thesis_path>);
    add(actions,
        {"processor.opened_file",
         menu,
         "Load the G-code file",
         "Loads the file of the Program workspace.",
         "",
         ""},
        has_gcode_file,
        load<ProcessorSource::opened_file>,
        is_loaded<ProcessorSource::opened_file>);
    add(actions,
        {"processor.project",
         menu,
         "Load the project's program",
         "Loads the program as it is written for LinuxCNC.",
         "",
         ""},
        has_program,
        load<ProcessorSource::project>,
        is_loaded<ProcessorSource::project>);
    add_texts(actions);
}

} // namespace millwright::actions
