#include "ui/actions/internal/simple_action.h"
#include "ui/actions/processor_bench.h"
#include "ui/actions/workshop.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

Permission can_execute(const Workbench& now) {
    if (now.session.workspace != Workspace::processor) {
        return Permission::refused("In the Processor workspace (F7) only.");
    }
    if (now.processor.failure()) {
        return Permission::refused("The processor cannot execute this program: see the inspector.");
    }
    return {};
}

Permission can_go_on(const Workbench& now) {
    const Permission able = can_execute(now);
    if (able.allowed && now.processor.debugger().state().stop != cordic::Stop::none) {
        return Permission::refused("The processor stands. Reset it to begin again.");
    }
    return able;
}

Permission runs(const Workbench& now) {
    return now.processor.running() ? Permission{} : Permission::refused("The processor does not run.");
}

Permission has_gcode_file(const Workbench& now) {
    return now.opened ? Permission{} : Permission::refused("Open a G-code file first.");
}

Permission has_program(const Workbench& now) {
    return now.listing() ? Permission{} : Permission::refused("The project has no program yet.");
}

template <ProcessorStep step> void do_step(Hands& hands) {
    hands.workshop.processor().step(step);
}

template <ProcessorSource source> void load(Hands& hands) {
    hands.session.workspace = Workspace::processor;
    hands.workshop.load_processor(source);
}

template <ProcessorSource source> bool is_loaded(const Workbench& now) {
    return now.processor.choice().source == source;
}

void add_steps(Actions& actions) {
    constexpr std::string_view menu = "Processor";
    add(actions,
        {"processor.reset", menu, "Reset", "As after power on; breakpoints stay.", "", icons::reset},
        can_execute,
        [](Hands& hands) { hands.workshop.processor().reset(); });
    add(actions,
        {"processor.clock", menu, "Step a clock", "One clock of the processor.", "Ctrl+1", ""},
        can_go_on,
        do_step<ProcessorStep::clock>);
    add(actions,
        {"processor.micro",
         menu,
         "Step a micro-instruction",
         "To another micro-instruction; a loop of one is one step.",
         "Ctrl+2",
         ""},
        can_go_on,
        do_step<ProcessorStep::micro_instruction>);
    add(actions,
        {"processor.instruction", menu, "Step an instruction", "To the next fetch.", "Ctrl+3", ""},
        can_go_on,
        do_step<ProcessorStep::instruction>);
    add(actions,
        {"processor.block", menu, "Step a block", "To the next line of the program.", "Ctrl+5", ""},
        can_go_on,
        do_step<ProcessorStep::block>);
    add(actions,
        {"processor.set_point",
         menu,
         "Run to the next set-point",
         "Until position, speed and acceleration are handed over.",
         "Ctrl+6",
         icons::step_forward},
        can_go_on,
        do_step<ProcessorStep::set_point>);
    add(actions,
        {"processor.run", menu, "Run", "To a breakpoint or the end.", "Ctrl+7", icons::play},
        can_go_on,
        [](Hands& hands) { hands.workshop.processor().run(); });
    add(actions,
        {"processor.pause", menu, "Pause", "Stops between two clocks.", "Ctrl+8", icons::pause},
        runs,
        [](Hands& hands) { hands.workshop.processor().pause(); });
}

} // namespace

void add_processor_actions(Actions& actions) {
    constexpr std::string_view menu = "Processor";
    add_steps(actions);
    add(actions,
        {"processor.thesis_arc", menu, "Load the thesis's arc", "Three quarters of a turn.", "", ""},
        always,
        load<ProcessorSource::thesis_arc>,
        is_loaded<ProcessorSource::thesis_arc>);
    add(actions,
        {"processor.thesis_path",
         menu,
         "Load the thesis's path",
         "Lines and two arcs, experiment E7.",
         "",
         ""},
        always,
        load<ProcessorSource::thesis_path>,
        is_loaded<ProcessorSource::thesis_path>);
    add(actions,
        {"processor.opened_file", menu, "Load the G-code file", "The one of the Program workspace.", "", ""},
        has_gcode_file,
        load<ProcessorSource::opened_file>,
        is_loaded<ProcessorSource::opened_file>);
    add(actions,
        {"processor.project", menu, "Load the project's program", "As it is written for LinuxCNC.", "", ""},
        has_program,
        load<ProcessorSource::project>,
        is_loaded<ProcessorSource::project>);
}

} // namespace millwright::actions
