#include "core/machine/drivers/grbl/grbl_driver.h"

#include "core/base/error.h"
#include "core/machine/drivers/grbl/internal/console_words.h"
#include "core/machine/drivers/grbl/internal/session.h"
#include "core/machine/drivers/grbl/settings.h"

#include <utility>

namespace millwright::machine {

using grbl::Session;

GrblDriver::GrblDriver(std::unique_ptr<Link> link, const Clock& clock, GrblOptions options)
    : SessionDriver(std::move(link),
                    clock,
                    std::make_unique<Session>(grbl::SessionSettings{
                        options.one_by_one, options.poll_interval, options.patience, options.greeting_time}),
                    grbl::console_words()) {}

Session& GrblDriver::talk() const {
    return static_cast<Session&>(session());
}

Capabilities GrblDriver::capabilities() const {
    using kinematics::AxisKind;
    constexpr int homing_cycle = 22;
    const GrblReadout known = readout();
    const auto& settings = known.settings;
    const auto cycle = settings.find(homing_cycle);
    const bool homes = cycle == settings.end() || cycle->second > 0.0;
    return {.plans = true,
            .axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}},
            .overrides = true,
            .other_overrides = true,
            .jog = true,
            .home = homes,
            .why_no_home = homes ? "" : "Homing is switched off in this controller ($22=0).",
            .command = true,
            .probe = true,
            .settings = true,
            .single_block = true,
            .piecewise = true,
            .mist = known.mist,
            .dialect = gcode::Dialect::grbl};
}

GrblReadout GrblDriver::readout() const {
    const std::scoped_lock lock(session_mutex());
    const grbl::Readout& known = talk().readout();
    return {.version = known.version,
            .settings = known.settings,
            .planner_blocks = known.planner_blocks,
            .buffer_bytes = known.buffer_bytes,
            .mist = known.mist,
            .began_anew = known.began_anew};
}

void GrblDriver::check(const gcode::Listing& listing, const std::filesystem::path& file) const {
    (void)grbl::program_lines(listing, file);
}

void GrblDriver::start(Work work) {
    expects(work.listing != nullptr, "Grbl is given a program's text");
    grbl::ProgramLines lines = grbl::program_lines(*work.listing, {});
    const Turn turn(*this);
    talk().start(std::move(lines), turn.now(), std::move(work.ahead));
}

int GrblDriver::command(const std::string& lines) {
    grbl::ProgramLines ready = grbl::command_lines(lines);
    const Turn turn(*this);
    return talk().command(std::move(ready), turn.now());
}

void GrblDriver::set_single_block(bool on) {
    const Turn turn(*this);
    talk().set_single_block(on);
}

MachineLimits GrblDriver::limits() const {
    const std::scoped_lock lock(session_mutex());
    const std::map<int, double>& settings = talk().readout().settings;
    const auto setting = [&settings](int number) {
        const auto found = settings.find(number);
        return found == settings.end() ? std::nullopt : std::optional(found->second);
    };
    constexpr double seconds_per_minute = 60.0;
    MachineLimits limits;
    for (int n = 0; n < 3 && !settings.empty(); ++n) {
        MachineLimits::Axis axis{.letter = "XYZ"[n], .min = {}, .max = {}, .speed = {}};
        if (const auto rate = setting(110 + n)) {
            axis.speed = *rate / seconds_per_minute;
        }
        const auto travel = setting(130 + n);
        if (travel && setting(22).value_or(0.0) > 0.0) {
            axis.min = -*travel;
            axis.max = 0.0;
        } else {
            axis.travel = travel;
        }
        limits.axes.push_back(axis);
    }
    limits.spindle_rpm = setting(30);
    return limits;
}

std::vector<ControllerSetting> GrblDriver::settings() const {
    const std::scoped_lock lock(session_mutex());
    std::vector<ControllerSetting> table;
    for (const auto& [number, value] : talk().readout().settings) {
        const GrblSetting* known = find_grbl_setting(number);
        const GrblSetting words =
            known != nullptr ? *known
                             : GrblSetting{number, "Not of Grbl 1.1", "", "see the controller's makers"};
        table.push_back({"$" + std::to_string(number), value, words.title, words.unit, words.explanation});
    }
    return table;
}

std::vector<StoredOffset> GrblDriver::stored_offsets() const {
    const std::scoped_lock lock(session_mutex());
    std::vector<StoredOffset> table;
    for (const auto& [name, axes] : talk().readout().offsets) {
        table.push_back({name, kinematics::AxisPositions{Vec3(axes[0], axes[1], axes[2])}});
    }
    return table;
}

} // namespace millwright::machine
