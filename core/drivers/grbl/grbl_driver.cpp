#include "core/drivers/grbl/grbl_driver.h"

#include "core/base/error.h"
#include "core/drivers/grbl/grbl_settings.h"
#include "core/drivers/grbl/internal/axis_limits.h"
#include "core/drivers/grbl/internal/axis_units.h"
#include "core/drivers/grbl/internal/console_words.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <utility>

namespace millwright::drivers {

using grbl::GrblSession;

GrblDriver::GrblDriver(std::unique_ptr<links::Link> link, const Clock& clock, GrblOptions options)
    : SessionDriver(std::move(link),
                    clock,
                    std::make_unique<GrblSession>(grbl::SessionSettings{
                        options.one_by_one, options.poll_interval, options.patience, options.greeting_time}),
                    grbl::console_words()) {}

GrblSession& GrblDriver::talk() const {
    return static_cast<GrblSession&>(session());
}

Capabilities GrblDriver::capabilities() const {
    constexpr int homing_cycle = 22;
    const GrblReadout known = readout();
    const auto& settings = known.settings;
    const auto cycle = settings.find(homing_cycle);
    const bool is_mask = facts_of(known.firmware).homing_mask;
    const bool homes = cycle == settings.end() ||
                       (is_mask ? (static_cast<unsigned>(cycle->second) & 1U) != 0 : cycle->second > 0.0);
    constexpr int laser_mode = 32; // 1: a laser; a grblHAL has 2, a lathe
    const auto mode = settings.find(laser_mode);
    const bool laser = mode != settings.end() && mode->second > 0.5 && mode->second < 1.5;
    return {.takes = Capabilities::Takes::text,
            .axes = grbl::program_axes(known.axes),
            .overrides = Capabilities::OverrideRange::all,
            .manual = {.jog = true,
                       .home = homes,
                       .command = true,
                       .probe = true,
                       .why_no_home = homes ? "" : "Homing is disabled in this controller ($22=0)."},
            .reports = {},
            .program = {.check_mode = true, .single_block = true, .piecewise = true, .tool_changes = true},
            .mist = known.mist,
            .laser = laser,
            .firmware = facts_of(known.firmware).name,
            .dialect = gcode::Dialect::grbl};
}

GrblReadout GrblDriver::readout() const {
    const std::scoped_lock lock(session_mutex());
    const grbl::Readout& known = talk().readout();
    return {.firmware = known.firmware,
            .version = known.version,
            .build = known.build,
            .axes = known.axes,
            .settings = known.settings,
            .planner_blocks = known.planner_blocks,
            .buffer_bytes = known.buffer_bytes,
            .mist = known.mist,
            .began_anew = known.began_anew};
}

void GrblDriver::check(const program::Listing& listing, const std::filesystem::path& file) const {
    (void)grbl::program_lines(listing, file);
}

void GrblDriver::start(Work work) {
    expects(work.listing != nullptr, "Grbl is given a program's text");
    grbl::ProgramLines lines = grbl::program_lines(*work.listing, {});
    const Turn turn(*this);
    talk().start(std::move(lines), turn.now(), std::move(work.ahead), std::move(work.tool_changes));
}

int GrblDriver::command(const std::string& lines) {
    grbl::ProgramLines ready = grbl::command_lines(lines);
    const Turn turn(*this);
    return talk().command(std::move(ready), turn.now());
}

int GrblDriver::check_there(const program::Listing& listing) {
    grbl::ProgramLines lines = grbl::program_lines(listing, {});
    const Turn turn(*this);
    return talk().check(std::move(lines), turn.now());
}

void GrblDriver::set_single_block(bool on) {
    const Turn turn(*this);
    talk().set_single_block(on);
}

MachineLimits GrblDriver::limits() const {
    const std::scoped_lock lock(session_mutex());
    return grbl::machine_limits(talk().readout());
}

std::vector<std::string> GrblDriver::remarks() const {
    const std::scoped_lock lock(session_mutex());
    return grbl::setup_remarks(talk().readout());
}

std::string GrblDriver::firmware() const {
    const std::scoped_lock lock(session_mutex());
    const grbl::Readout& known = talk().readout();
    if (known.version.empty()) {
        return {};
    }
    const std::string who = std::string(facts_of(known.firmware).name) + " " + known.version;
    return known.build.empty() ? who : who + " (" + known.build + ")";
}

std::vector<ControllerSetting> GrblDriver::settings() const {
    const std::scoped_lock lock(session_mutex());
    std::vector<ControllerSetting> table;
    for (const auto& [number, value] : talk().readout().settings) {
        const GrblSetting* known = find_grbl_setting(number, talk().readout().firmware);
        const GrblSetting words =
            known != nullptr
                ? *known
                : GrblSetting{number, "Not a Grbl 1.1 setting", "", "see the controller's documentation"};
        table.push_back({"$" + std::to_string(number), value, words.title, words.unit, words.explanation});
    }
    return table;
}

std::vector<StoredOffset> GrblDriver::stored_offsets() const {
    const std::scoped_lock lock(session_mutex());
    std::vector<StoredOffset> table;
    for (const auto& [name, axes] : talk().readout().offsets) {
        table.push_back({name, grbl::positions_of(axes, talk().readout().axes)});
    }
    return table;
}

} // namespace millwright::drivers
