#include "ui/actions/synonyms.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace millwright::actions {

namespace {

using Synonyms = std::pair<std::string_view, std::string_view>;

constexpr auto synonyms = std::to_array<Synonyms>({
    {"arm.clear_trace", "erase trace, delete trace"},
    {"arm.enable", "motors on, power on, close loops"},
    {"arm.go_joints", "move joints, point to point, PTP"},
    {"arm.go_straight", "move linear, straight line, LIN"},
    {"arm.play_points", "run points, replay"},
    {"arm.teach", "record point, store pose"},
    {"edit.join_tangent", "G1, C1, tangent"},
    {"edit.redo", "repeat"},
    {"edit.select_none", "deselect, clear selection"},
    {"edit.smooth", "fair, relax"},
    {"edit.undo", "revert, step back"},
    {"file.close_program", "unload, close NC"},
    {"file.export", "save STL, STEP, IGES, OBJ, PLY, glb"},
    {"file.import", "load STL, STEP, IGES, OBJ, PLY, CAD, mesh"},
    {"file.open", "load, browse, HPGL, PLT, NC, picture, image"},
    {"file.quit", "exit, close, leave"},
    {"file.read_again", "reload, refresh"},
    {"file.save", "store"},
    {"file.save_as", "save copy, rename"},
    {"file.write_program", "post, export NC, output, save program"},
    {"grid.adapt", "elliptic, refine"},
    {"grid.brush", "brush, density"},
    {"grid.no_tool", "stop drawing, stop painting"},
    {"grid.optimise", "optimize, shortest path"},
    {"grid.outline", "boundary, lasso, polygon"},
    {"grid.redistribute", "equal shares, equidistribution"},
    {"help.about", "version, licence, license"},
    {"help.commands", "online commands, Delta Tau"},
    {"help.keys", "shortcuts, hotkeys, key bindings"},
    {"help.workspace", "manual, documentation, guide"},
    {"machine.arm_gamepad", "joystick, controller, manual"},
    {"machine.arm_keys", "keyboard jog, arrow keys, manual"},
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
    {"play.toggle", "simulate, animate, preview"},
    {"plot.write_program", "post, NC, export"},
    {"processor.reset", "restart"},
    {"program.find", "search text, replace"},
    {"set_up.search", "optimize set-up, fixture, placement, work offset"},
    {"view.arm", "robot, joints, inverse kinematics"},
    {"view.colors", "colors, background"},
    {"view.design",
     "degree, control points, weights, control net, split, symmetric, preset, Bezier, NURBS, elevate"},
    {"view.fit", "zoom, whole view, zoom to fit, show all"},
    {"view.four", "split view, quad view"},
    {"view.from_above", "top view, plan view"},
    {"view.from_front", "front view"},
    {"view.from_right", "side view, right view"},
    {"view.grid", "nodes, mesh, weight, density, Program uses"},
    {"view.inspector", "properties, right pane, sidebar"},
    {"view.into_space", "isometric, perspective, 3D"},
    {"view.keep_result", "pin, compare"},
    {"view.lower", "bottom pane, console, log, listing, plots"},
    {"view.machine",
     "zero, work zero, offsets, G54, driver, serial port, baud, jog, overrides, probe, spindle, coolant, "
     "queue"},
    {"view.outline", "tree, left pane, sidebar"},
    {"view.plot", "HPGL, engrave, relief, hatch, image, drawing, levels"},
    {"view.processor", "CORDIC, microprogram, registers"},
    {"view.program", "G-code, listing, feeds, clearances, safe height, units, inch"},
    {"view.search", "commands, palette"},
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
