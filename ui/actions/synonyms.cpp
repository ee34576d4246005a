#include "ui/actions/synonyms.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace millwright::actions {

namespace {

using Synonyms = std::pair<std::string_view, std::string_view>;

constexpr auto synonyms = std::to_array<Synonyms>({
    {"arm.card_settings", "load settings of the card"},
    {"arm.clear_trace", "erase trace, delete trace"},
    {"arm.enable", "motors on, power on, close loops, give the motors power"},
    {"arm.go_joints", "move joints, point to point, PTP, go to the goal by joints"},
    {"arm.go_straight", "move linear, straight line, LIN, go to the goal in a line"},
    {"arm.home", "draw at home"},
    {"arm.play_motion", "play the motion file that is written"},
    {"arm.play_points", "run points, replay"},
    {"arm.send_path", "go the path, follow path"},
    {"arm.stop", "stop the drawn arm"},
    {"arm.teach", "record point, store pose"},
    {"edit.join_tangent", "G1, C1, tangent"},
    {"edit.redo", "repeat"},
    {"edit.select_none", "clear selection, select nothing"},
    {"edit.smooth", "fair, relax"},
    {"edit.undo", "revert, step back"},
    {"file.close_program", "unload, close NC"},
    {"file.export", "save STL, STEP, IGES, OBJ, PLY, glb"},
    {"file.import", "load STL, STEP, IGES, OBJ, PLY, CAD, mesh"},
    {"file.open", "load, browse, HPGL, PLT, NC, picture, image"},
    {"file.quit", "exit, close, leave"},
    {"file.read_again", "refresh, read the G-code file again"},
    {"file.save", "store"},
    {"file.save_as", "save copy, rename"},
    {"file.write_program", "post, export NC, output, save program"},
    {"grid.adapt", "elliptic, refine"},
    {"grid.brush", "brush, density"},
    {"grid.harmonic", "make the harmonic map"},
    {"grid.no_tool", "stop painting, put the tool away"},
    {"grid.optimise", "optimize, shortest path"},
    {"grid.outline", "boundary, lasso, polygon, region of adaptation"},
    {"grid.redistribute", "equal shares, equidistribution"},
    {"grid.reset", "back to the start grid"},
    {"grid.step", "one step of the adaptation"},
    {"help.about", "version, licence, license"},
    {"help.commands", "online commands, Delta Tau, commands of a PMAC"},
    {"help.keys", "hotkeys, key bindings"},
    {"help.workspace", "manual, documentation, guide, this workspace"},
    {"machine.arm_gamepad", "joystick, controller, manual, jog by gamepad"},
    {"machine.arm_keys", "arrow keys, manual, jog by keys"},
    {"machine.connect", "link, serial port, COM, USB"},
    {"machine.disconnect", "unlink, close port"},
    {"machine.emergency_stop", "e-stop, abort, kill, panic"},
    {"machine.hold", "feed hold, pause"},
    {"machine.home", "zero, reference, find limit switches, $H"},
    {"machine.reset", "clear alarm, $X"},
    {"machine.resume", "cycle start, continue"},
    {"machine.run", "cycle start, send, stream, start job"},
    {"machine.single_block", "step, block by block"},
    {"machine.stop", "cancel job, abort job"},
    {"machine.trust_position", "the position is right, trust position"},
    {"play.first", "to the start"},
    {"play.last", "to the end"},
    {"play.toggle", "simulate, animate, preview"},
    {"plot.flat", "plan view, look from above"},
    {"plot.light", "against the light"},
    {"plot.picture", "picture below the path"},
    {"plot.play_table", "play to the table"},
    {"plot.space", "3D, perspective, look into space"},
    {"plot.to_machine", "to the machine, send"},
    {"plot.write_program", "post, NC, export"},
    {"processor.assembler", "execute the assembler text"},
    {"processor.block", "step a block"},
    {"processor.clock", "step a clock"},
    {"processor.instruction", "step an instruction"},
    {"processor.micro", "step a micro-instruction"},
    {"processor.open_assembler", "open assembler text"},
    {"processor.own_microprogram", "execute the microprogram that is written"},
    {"processor.reset", "restart"},
    {"processor.save_assembler", "save the assembler text"},
    {"processor.start_microprogram", "start a microprogram"},
    {"processor.take_over", "take over as assembler text"},
    {"program.find", "search text, replace"},
    {"program.find_next", "find the next place"},
    {"program.find_previous", "find the place before"},
    {"set_up.accept", "accept the place on the table"},
    {"set_up.search", "optimize set-up, fixture, placement, work offset, search the best place on the table"},
    {"view.arm", "robot, joints, inverse kinematics"},
    {"view.colors", "colors, background, colours of the view"},
    {"view.design",
     "degree, control points, weights, control net, split, symmetric, preset, Bezier, NURBS, elevate"},
    {"view.fit", "zoom, whole view, zoom to fit, show all"},
    {"view.four", "split view, quad view"},
    {"view.from_above", "plan view, look from above"},
    {"view.from_front", "look from the front"},
    {"view.from_right", "side view, look from the right"},
    {"view.grid", "nodes, mesh, weight, density, Program uses"},
    {"view.inspector", "properties, right pane, sidebar"},
    {"view.into_space", "perspective, 3D, look into space"},
    {"view.keep_result", "keep this result, compare"},
    {"view.lower", "bottom pane, console, log, listing, plots"},
    {"view.machine",
     "zero, work zero, offsets, G54, driver, serial port, baud, jog, overrides, probe, spindle, coolant, "
     "queue"},
    {"view.outline", "tree, left pane, sidebar"},
    {"view.plot", "HPGL, engrave, relief, hatch, image, drawing, levels"},
    {"view.processor", "CORDIC, microprogram, registers"},
    {"view.program", "G-code, listing, feeds, clearances, safe height, units, inch"},
    {"view.search", "palette, actions, search for an action"},
    {"view.theme", "dark, bright, dark mode, night, appearance, colors"},
    {"view.toolpath",
     "ball nose, bull nose, flat end mill, tool, cutter, radius, scallop, strategy, zigzag, spiral, set-up, "
     "gouge"},
    {"work.cancel", "stop computing, abort"},
});

const Synonyms* row_of_action(std::string_view action) {
    const auto* const entry = std::ranges::find(synonyms, action, &Synonyms::first);
    return entry == synonyms.end() ? nullptr : entry;
}

} // namespace

std::string_view synonyms_of(std::string_view action) {
    const Synonyms* const entry = row_of_action(action);
    return entry == nullptr ? std::string_view() : entry->second;
}

std::vector<std::string_view> actions_with_synonyms() {
    std::vector<std::string_view> ids;
    std::ranges::transform(synonyms, std::back_inserter(ids), &Synonyms::first);
    return ids;
}

} // namespace millwright::actions
