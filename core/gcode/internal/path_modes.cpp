#include "core/gcode/internal/path_modes.h"

#include "core/gcode/internal/refusal.h"

namespace millwright::gcode::internal {

namespace {

void send_mode(Run& run, program::PathMode mode, double tolerance, ModeOrigin origin = ModeOrigin::program) {
    Command command = command_of(CommandKind::set_motion_control_mode, static_cast<int>(mode), tolerance);
    command.mode = static_cast<int>(origin);
    run.out.send(command);
}

} // namespace

void set_path_mode(Run& run, const Block& block, int code) {
    ModalState& s = run.state;
    if (s.cutter.on()) {
        refuse(block.column_of(GGroup::path_control),
               "the path mode cannot change while cutter compensation is on");
    }
    if (code != 640) {
        s.path_mode = code == 610 ? program::PathMode::exact_path : program::PathMode::exact_stop;
        s.path_tolerance = 0.0;
        send_mode(run, s.path_mode, 0.0);
        return;
    }
    for (const char letter : {'P', 'Q'}) {
        if (block.value_or(letter, 0.0) < 0.0) {
            refuse(block.column_of(letter), "a tolerance must be 0 or more");
        }
    }
    s.path_mode = program::PathMode::continuous;
    s.path_tolerance = block.value_or('P', 0.0);
    s.naivecam_tolerance = block.value_or('Q', s.path_tolerance);
    send_mode(run, s.path_mode, s.path_tolerance);
    run.out.send(CommandKind::set_naivecam_tolerance, 0, s.naivecam_tolerance);
}

void go_exactly(Run& run) {
    if (run.state.path_mode != program::PathMode::exact_path) {
        send_mode(run, program::PathMode::exact_path, 0.0, ModeOrigin::cycle);
    }
}

void go_as_before(Run& run) {
    const ModalState& s = run.state;
    if (s.path_mode == program::PathMode::exact_path) {
        return;
    }
    send_mode(run, s.path_mode, s.path_tolerance, ModeOrigin::cycle_end);
    run.out.send(CommandKind::set_naivecam_tolerance, 0, s.naivecam_tolerance);
}

} // namespace millwright::gcode::internal
