#include "core/emulators/grbl/internal/parser.h"

#include "core/base/numbers.h"
#include "core/emulators/grbl/internal/arcs.h"
#include "core/emulators/grbl/internal/error_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::emulators::internal {

namespace {

class Parser {
public:
    Parser(const Words& words, const Modes& modes, const Eeprom& eeprom, const Build& build)
        : words_(words), before_(modes), build_(build) {
        result_.modes = modes;
        result_.eeprom = eeprom;
    }

    Parsed line() {
        for (const auto step : {&Parser::take_numbers,
                                &Parser::take_modes,
                                &Parser::take_feed,
                                &Parser::take_switches,
                                &Parser::take_dwell,
                                &Parser::take_tool_length,
                                &Parser::take_target,
                                &Parser::take_non_modal,
                                &Parser::take_motion,
                                &Parser::take_flow,
                                &Parser::check_all_used}) {
            result_.error = (this->*step)();
            if (result_.error != error_code::none) {
                break;
            }
        }
        return result_;
    }

    Parsed jog() {
        const bool others = words_.motion >= 0 || words_.plane >= 0 || words_.feed_mode >= 0 ||
                            words_.tool_length >= 0 || words_.coordinates >= 0 || words_.flow >= 0 ||
                            words_.spindle >= 0 || words_.coolant >= 0 || words_.cutter_off ||
                            words_.exact_path || words_.arc_distance ||
                            (words_.non_modal >= 0 && words_.non_modal != 530);
        const Modes before = result_.modes;
        result_.error = others                                  ? error_code::bad_jog
                        : !has_axes()                           ? error_code::no_axes
                        : words_.value('F').value_or(0.0) > 0.0 ? error_code::none
                                                                : error_code::no_feed;
        if (result_.error != error_code::none) {
            return result_;
        }
        (void)take_modes();
        (void)take_target();
        use("NF");
        result_.tasks.push_back(
            {.action = Action::move, .points = {target_}, .rate = *words_.value('F') * unit()});
        result_.modes = before;
        result_.modes.position = target_;
        result_.error = check_all_used();
        return result_;
    }

private:
    const Words words_;
    const Modes before_;
    const Build& build_;
    Parsed result_;
    std::string used_;
    Axes target_{};
    AxisUse axis_use_ = AxisUse::none;

    Modes& modes() { return result_.modes; }
    Eeprom& eeprom() { return result_.eeprom; }
    void use(std::string_view letters) { used_ += letters; }
    [[nodiscard]] bool has_axes() const { return words_.has_axes(build_.axes); }
    [[nodiscard]] double unit_of(std::size_t axis) const {
        return axis_unit(axis, result_.modes.inches, result_.eeprom, build_);
    }
    [[nodiscard]] double unit() const { return result_.modes.inches ? mm_per_inch : 1.0; }
    void add(Action action) { result_.tasks.push_back({.action = action}); }

    int take_numbers() {
        constexpr double greatest_line = 10'000'000.0;
        use("NFST");
        if (words_.value('N').value_or(0.0) > greatest_line) {
            return error_code::bad_line_number;
        }
        result_.line_number = static_cast<int>(words_.value('N').value_or(0.0));
        modes().tool = static_cast<int>(words_.value('T').value_or(modes().tool));
        return error_code::none;
    }

    int take_modes() {
        axis_use_ = words_.axis_use;
        if (words_.units >= 0) {
            modes().inches = words_.units == 200;
        }
        if (words_.distance >= 0) {
            modes().absolute = words_.distance == 900;
        }
        if (words_.plane >= 0) {
            modes().plane = words_.plane;
        }
        if (words_.motion >= 0) {
            modes().motion = words_.motion;
        }
        if (words_.coordinates >= 0) {
            modes().coordinates = (words_.coordinates - 540) / 10;
        }
        if (has_axes() && axis_use_ == AxisUse::none) {
            axis_use_ = AxisUse::motion;
        }
        return error_code::none;
    }

    /// In inverse time each move of a feed has its own F; else the last one counts.
    int take_feed() {
        const bool was_inverse = modes().inverse_time;
        if (words_.feed_mode >= 0) {
            modes().inverse_time = words_.feed_mode == 930;
        }
        const bool feeds = axis_use_ == AxisUse::motion && modes().motion != 0 && modes().motion != 800;
        if (modes().inverse_time) {
            modes().feed = words_.value('F').value_or(0.0);
            return feeds && !words_.has('F') ? error_code::no_feed : error_code::none;
        }
        if (words_.has('F')) {
            modes().feed = *words_.value('F') * unit();
        } else if (was_inverse) {
            modes().feed = 0.0;
        }
        return error_code::none;
    }

    int take_switches() {
        const double rpm = words_.value('S').value_or(modes().spindle_rpm);
        const bool turns = modes().spindle != 50;
        const int spindle = words_.spindle >= 0 ? words_.spindle : modes().spindle;
        if (spindle != modes().spindle || (turns && !exactly_equal(rpm, modes().spindle_rpm))) {
            add(Action::spindle);
        }
        modes().spindle = spindle;
        modes().spindle_rpm = rpm;
        if (words_.coolant >= 0) {
            const bool off = words_.coolant == 90;
            modes().flood = !off && (modes().flood || words_.coolant == 80);
            modes().mist = !off && (modes().mist || words_.coolant == 70);
            add(Action::coolant);
        }
        return error_code::none;
    }

    int take_dwell() {
        if (words_.non_modal != 40) {
            return error_code::none;
        }
        if (!words_.has('P')) {
            return error_code::value_missing;
        }
        use("P");
        result_.tasks.push_back({.action = Action::dwell, .seconds = *words_.value('P')});
        return error_code::none;
    }

    int take_tool_length() {
        if (words_.tool_length == 490) {
            modes().tool_length.reset();
        } else if (words_.tool_length == 431) {
            const auto others = std::ranges::count_if(build_.axes, [this](char c) { return words_.has(c); });
            if (others != 1 || !words_.has('Z')) {
                return error_code::wrong_length_axis;
            }
            use("Z");
            modes().tool_length = *words_.value('Z') * unit();
        }
        return error_code::none;
    }

    /// Where the axis words lead, in machine coordinates.
    int take_target() {
        target_ = modes().position;
        if (axis_use_ == AxisUse::none || axis_use_ == AxisUse::tool_length) {
            return error_code::none;
        }
        const Axes offset = work_offset(modes(), eeprom());
        for (std::size_t n = 0; n < build_.axis_count(); ++n) {
            const auto& word = words_.value(build_.axes[n]);
            if (!word) {
                continue;
            }
            use(build_.axes.substr(n, 1));
            const double way = *word * unit_of(n);
            const bool in_machine = words_.non_modal == 530; // in incremental mode too
            target_[n] = in_machine ? way : way + (modes().absolute ? offset[n] : target_[n]);
        }
        return error_code::none;
    }

    int take_non_modal() {
        if (modes().coordinates != before_.coordinates ||
            !exactly_equal(modes().tool_length_offset(), before_.tool_length_offset())) {
            add(Action::offset);
        }
        switch (words_.non_modal) {
        case 100:
            return set_offset();
        case 280:
        case 300:
            go_home(words_.non_modal == 280 ? eeprom().g28 : eeprom().g30);
            return error_code::none;
        case 281:
        case 301:
            (words_.non_modal == 281 ? eeprom().g28 : eeprom().g30) = modes().position;
            add(Action::store);
            return error_code::none;
        case 530:
            return modes().motion == 0 || modes().motion == 10 ? error_code::none
                                                               : error_code::g53_without_line;
        case 920:
            return shift_coordinates();
        case 921:
            modes().g92 = {};
            add(Action::offset);
            return error_code::none;
        default:
            return error_code::none;
        }
    }

    /// By way of the axis words' point, if there are any; then only these axes go home.
    void go_home(const Axes& home) {
        Axes end = modes().position;
        const bool all = !has_axes();
        for (std::size_t n = 0; n < build_.axis_count(); ++n) {
            end[n] = all || words_.has(build_.axes[n]) ? home[n] : end[n];
        }
        Task task{.action = Action::move, .points = {end}, .rapid = true};
        if (!all) {
            task.points.insert(task.points.begin(), target_);
        }
        result_.tasks.push_back(task);
        modes().position = end;
    }

    int set_offset() {
        if (!has_axes()) {
            return error_code::no_axes;
        }
        if (!words_.has('P') && !words_.has('L')) { // one of them is enough for the real one, too
            return error_code::value_missing;
        }
        constexpr double most = 255.0;
        const int which = static_cast<int>(std::min(words_.value('P').value_or(0.0), most));
        const int how = static_cast<int>(std::clamp(words_.value('L').value_or(0.0), 0.0, most));
        constexpr int last_system = 6;
        if (which > last_system) {
            return error_code::no_such_offset;
        }
        if ((how != 2 && how != 20) || (how == 2 && words_.has('R'))) {
            return error_code::unsupported_command;
        }
        use("PL");
        const int slot = which < 1 ? modes().coordinates : which - 1;
        Axes& offset = eeprom().work_offsets[static_cast<std::size_t>(slot)];
        for (std::size_t n = 0; n < build_.axis_count(); ++n) {
            if (const auto& word = words_.value(build_.axes[n])) {
                const double value = *word * unit_of(n);
                const double other = modes().g92[n] + (n == 2 ? modes().tool_length_offset() : 0.0);
                offset[n] = how > 2 ? modes().position[n] - other - value : value;
            }
        }
        add(Action::store);
        if (slot == modes().coordinates) {
            add(Action::offset);
        }
        return error_code::none;
    }

    int shift_coordinates() {
        if (!has_axes()) {
            return error_code::no_axes;
        }
        const Axes offset = work_offset(modes(), eeprom());
        for (std::size_t n = 0; n < build_.axis_count(); ++n) {
            if (const auto& word = words_.value(build_.axes[n])) {
                modes().g92[n] += modes().position[n] - offset[n] - *word * unit_of(n);
            }
        }
        add(Action::offset);
        return error_code::none;
    }

    int take_motion() {
        if (modes().motion == 800 && has_axes()) { // also beside G10, G92 and G43.1
            return error_code::axes_without_motion;
        }
        if (axis_use_ != AxisUse::motion || modes().motion == 800) {
            return error_code::none;
        }
        const bool arc = modes().motion == 20 || modes().motion == 30;
        const bool probe = modes().motion >= 382 && modes().motion <= 385;
        if (modes().motion != 0 && !(modes().feed > 0.0)) {
            return error_code::no_feed;
        }
        if (!has_axes()) {
            return arc || probe ? error_code::no_axes : error_code::none;
        }
        Task task{.action = probe ? Action::probe : Action::move,
                  .points = {target_},
                  .rapid = modes().motion == 0,
                  .inverse_time = modes().inverse_time,
                  .rate = modes().feed,
                  .probe = probe ? modes().motion : 0};
        if (probe && target_ == modes().position) {
            return error_code::bad_target;
        }
        if (arc) {
            const ArcPoints points = arc_points(arc_of_words());
            if (points.error != error_code::none) {
                return points.error;
            }
            use(words_.has('R') ? "R" : "IJK"); // a centre beside a radius is of no use
            task.points = points.points;
        }
        result_.tasks.push_back(task);
        modes().position = target_;
        return error_code::none;
    }

    [[nodiscard]] ArcWords arc_of_words() const {
        ArcWords arc;
        arc.from = result_.modes.position;
        arc.to = target_;
        arc.plane = result_.modes.plane;
        arc.clockwise = result_.modes.motion == 20;
        arc.tolerance = result_.eeprom.setting(12);
        constexpr std::string_view offset_letters = "IJK";
        for (std::size_t n = 0; n < offset_letters.size(); ++n) {
            arc.has_axis[n] = words_.has(build_.axes[n]);
            if (const auto& offset = words_.value(offset_letters[n])) {
                arc.offset[n] = *offset * unit();
            }
        }
        if (const auto& radius = words_.value('R')) {
            arc.radius = *radius * unit();
        }
        return arc;
    }

    int take_flow() {
        if (words_.changes_tool) {
            add(Action::tool);
        }
        if (words_.flow == 0) {
            add(Action::pause);
        } else if (words_.flow == 20 || words_.flow == 300) {
            add(Action::end);
        }
        return error_code::none;
    }

    int check_all_used() {
        for (char letter = 'A'; letter <= 'Z'; ++letter) {
            if (words_.has(letter) && used_.find(letter) == std::string::npos) {
                return error_code::unused_words;
            }
        }
        return error_code::none;
    }
};

Parsed failed(int error, const Modes& modes, const Eeprom& eeprom) {
    Parsed result;
    result.error = error;
    result.modes = modes;
    result.eeprom = eeprom;
    return result;
}

/// Halves up, as Grbl prints.
double rounded(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::floor(value * scale + 0.5) / scale;
}

std::string command_text(char letter, int tenths) {
    return tenths % 10 == 0 ? fmt::format("{}{}", letter, tenths / 10)
                            : fmt::format("{}{}.{}", letter, tenths / 10, tenths % 10);
}

/// What a grblHAL shows of tool length, retract mode and scaling, between G94 and the spindle.
std::string modes_of_grblhal(const Modes& modes) {
    return modes.tool_length ? " G43.1 G98 G50" : " G49 G98 G50";
}

} // namespace

Axes work_offset(const Modes& modes, const Eeprom& eeprom) {
    Axes offset = eeprom.work_offsets[static_cast<std::size_t>(modes.coordinates)];
    for (std::size_t n = 0; n < offset.size(); ++n) {
        offset[n] += modes.g92[n];
    }
    offset[2] += modes.tool_length_offset();
    return offset;
}

Parsed parse_line(std::string_view line, const Modes& modes, const Eeprom& eeprom, const Build& build) {
    const ReadWords read = read_words(line, build);
    return read.error != error_code::none ? failed(read.error, modes, eeprom)
                                          : Parser(read.words, modes, eeprom, build).line();
}

Parsed parse_jog(std::string_view line, const Modes& modes, const Eeprom& eeprom, const Build& build) {
    const ReadWords read = read_words(line, build);
    return read.error != error_code::none ? failed(read.error, modes, eeprom)
                                          : Parser(read.words, modes, eeprom, build).jog();
}

double axis_unit(std::size_t n, bool inches, const Eeprom& eeprom, const Build& build) {
    constexpr std::size_t first = 3;
    const bool degrees = build.is_rotary(n) && (!build.is(EmulatedFirmware::grblhal) ||
                                                eeprom.has_bit(rotary_mask_setting, n - first));
    return inches && !degrees ? mm_per_inch : 1.0;
}

std::string modes_report(const Modes& modes, bool report_inches, const Build& build) {
    std::string coolant = modes.mist ? " M7" : "";
    coolant += modes.flood ? " M8" : "";
    coolant += coolant.empty() ? " M9" : "";
    return fmt::format("[GC:{} G{} {} G{} G{} G{}{} {}{} T{} F{:.{}f} S{:.0f}]",
                       command_text('G', modes.motion),
                       54 + modes.coordinates,
                       command_text('G', modes.plane),
                       modes.inches ? 20 : 21,
                       modes.absolute ? 90 : 91,
                       modes.inverse_time ? 93 : 94,
                       build.is(EmulatedFirmware::grblhal) ? modes_of_grblhal(modes) : std::string(),
                       command_text('M', modes.spindle),
                       coolant,
                       modes.tool,
                       rounded(report_inches ? modes.feed / mm_per_inch : modes.feed, report_inches ? 1 : 0),
                       report_inches ? 1 : 0,
                       rounded(modes.spindle_rpm, 0));
}

} // namespace millwright::emulators::internal
