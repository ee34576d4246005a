#include "core/gcode/canon_printer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

namespace millwright::gcode {

namespace {

constexpr std::size_t piece_size = 64 * 1024;

/// Commands without arguments, and those with one kind of arguments each.
enum class Form {
    plain,         ///< NAME()
    spindle,       ///< NAME(0)
    value,         ///< NAME(1.0000)
    spindle_value, ///< NAME(0, 1.0000)
    index,         ///< NAME(1)
    index_value,   ///< NAME(1,2.000000)
    text,          ///< NAME("text")
    axes,          ///< NAME(x, y, z, a, b, c)
    indexed_axes,  ///< NAME(1, x, y, ...)
    own            ///< each its own way
};

struct CanonFunction {
    CommandKind kind;
    std::string_view name;
    Form form;
};

// In the order of CommandKind.
constexpr std::array<CanonFunction, 59> canon_functions{{
    {CommandKind::use_length_units, "USE_LENGTH_UNITS", Form::own},
    {CommandKind::set_g5x_offset, "SET_G5X_OFFSET", Form::indexed_axes},
    {CommandKind::set_g92_offset, "SET_G92_OFFSET", Form::axes},
    {CommandKind::set_xy_rotation, "SET_XY_ROTATION", Form::value},
    {CommandKind::set_feed_reference, "SET_FEED_REFERENCE(CANON_XYZ)", Form::own},
    {CommandKind::set_feed_mode, "SET_FEED_MODE", Form::own},
    {CommandKind::set_feed_rate, "SET_FEED_RATE", Form::value},
    {CommandKind::set_motion_control_mode, "SET_MOTION_CONTROL_MODE", Form::own},
    {CommandKind::set_naivecam_tolerance, "SET_NAIVECAM_TOLERANCE", Form::value},
    {CommandKind::select_plane, "SELECT_PLANE", Form::own},
    {CommandKind::start_speed_feed_synch, "START_SPEED_FEED_SYNC", Form::own},
    {CommandKind::stop_speed_feed_synch, "STOP_SPEED_FEED_SYNCH", Form::plain},
    {CommandKind::dwell, "DWELL", Form::value},
    {CommandKind::set_spindle_mode, "SET_SPINDLE_MODE", Form::own},
    {CommandKind::set_spindle_speed, "SET_SPINDLE_SPEED", Form::spindle_value},
    {CommandKind::start_spindle_clockwise, "START_SPINDLE_CLOCKWISE", Form::spindle},
    {CommandKind::start_spindle_counterclockwise, "START_SPINDLE_COUNTERCLOCKWISE", Form::spindle},
    {CommandKind::stop_spindle_turning, "STOP_SPINDLE_TURNING", Form::spindle},
    {CommandKind::orient_spindle, "ORIENT_SPINDLE", Form::own},
    {CommandKind::wait_spindle_orient, "SPINDLE.0.WAIT_ORIENT_COMPLETE", Form::value},
    {CommandKind::use_tool_length_offset, "USE_TOOL_LENGTH_OFFSET", Form::own},
    {CommandKind::control_tip, "CONTROL_TIP", Form::index}, // rs274 has none
    {CommandKind::select_tool, "SELECT_TOOL", Form::index},
    {CommandKind::start_change, "START_CHANGE", Form::plain},
    {CommandKind::change_tool, "CHANGE_TOOL", Form::index},
    {CommandKind::change_tool_number, "CHANGE_TOOL_NUMBER", Form::index},
    {CommandKind::set_tool_table_entry, "SET_TOOL_TABLE_ENTRY", Form::own},
    {CommandKind::comment, "COMMENT", Form::text},
    {CommandKind::message, "MESSAGE", Form::text},
    {CommandKind::print, "", Form::own},
    {CommandKind::log, "LOG", Form::text},
    {CommandKind::logopen, "LOGOPEN", Form::text},
    {CommandKind::logappend, "LOGAPPEND", Form::text},
    {CommandKind::logclose, "LOGCLOSE", Form::plain},
    {CommandKind::mist_on, "MIST_ON", Form::plain},
    {CommandKind::mist_off, "MIST_OFF", Form::plain},
    {CommandKind::flood_on, "FLOOD_ON", Form::plain},
    {CommandKind::flood_off, "FLOOD_OFF", Form::plain},
    {CommandKind::enable_feed_override, "ENABLE_FEED_OVERRIDE", Form::plain},
    {CommandKind::disable_feed_override, "DISABLE_FEED_OVERRIDE", Form::plain},
    {CommandKind::enable_speed_override, "ENABLE_SPEED_OVERRIDE", Form::spindle},
    {CommandKind::disable_speed_override, "DISABLE_SPEED_OVERRIDE", Form::spindle},
    {CommandKind::enable_adaptive_feed, "ENABLE_ADAPTIVE_FEED", Form::plain},
    {CommandKind::disable_adaptive_feed, "DISABLE_ADAPTIVE_FEED", Form::plain},
    {CommandKind::enable_feed_hold, "ENABLE_FEED_HOLD", Form::plain},
    {CommandKind::disable_feed_hold, "DISABLE_FEED_HOLD", Form::plain},
    {CommandKind::turn_probe_on, "TURN_PROBE_ON", Form::plain},
    {CommandKind::turn_probe_off, "TURN_PROBE_OFF", Form::plain},
    {CommandKind::set_motion_output_bit, "SET_MOTION_OUTPUT_BIT", Form::index},
    {CommandKind::clear_motion_output_bit, "CLEAR_MOTION_OUTPUT_BIT", Form::index},
    {CommandKind::set_aux_output_bit, "SET_AUX_OUTPUT_BIT", Form::index},
    {CommandKind::clear_aux_output_bit, "CLEAR_AUX_OUTPUT_BIT", Form::index},
    {CommandKind::set_motion_output_value, "SET_MOTION_OUTPUT_VALUE", Form::index_value},
    {CommandKind::set_aux_output_value, "SET_AUX_OUTPUT_VALUE", Form::index_value},
    {CommandKind::wait_input, "", Form::own},
    {CommandKind::user_command, "USER_DEFINED_FUNCTION", Form::own},
    {CommandKind::pallet_shuttle, "PALLET_SHUTTLE", Form::plain},
    {CommandKind::program_stop, "PROGRAM_STOP", Form::plain},
    {CommandKind::optional_program_stop, "OPTIONAL_PROGRAM_STOP", Form::plain},
}};

std::string_view plane_name(int plane) {
    constexpr std::array<std::string_view, 6> names{"XY", "XZ", "YZ", "UNKNOWN", "UNKNOWN", "UNKNOWN"};
    return names[static_cast<std::size_t>(plane)];
}

std::string own_text(const Command& c) {
    switch (c.kind) {
    case CommandKind::use_length_units:
        return c.index == 1 ? "USE_LENGTH_UNITS(CANON_UNITS_INCHES)" : "USE_LENGTH_UNITS(CANON_UNITS_MM)";
    case CommandKind::set_feed_reference:
        return "SET_FEED_REFERENCE(CANON_XYZ)";
    case CommandKind::set_feed_mode:
        return fmt::format("SET_FEED_MODE(0, {})", c.index);
    case CommandKind::set_motion_control_mode:
        return c.index == static_cast<int>(program::PathMode::continuous)
                   ? fmt::format("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, {:.6f})", c.value)
               : c.index == static_cast<int>(program::PathMode::exact_stop)
                   ? "SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)"
                   : "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)";
    case CommandKind::select_plane:
        return fmt::format("SELECT_PLANE(CANON_PLANE_{})", plane_name(c.index));
    case CommandKind::start_speed_feed_synch:
        return fmt::format("START_SPEED_FEED_SYNC({:.6f},0)", c.value);
    case CommandKind::set_spindle_mode:
        return fmt::format("SET_SPINDLE_MODE(0 {:.4f})", c.value);
    case CommandKind::orient_spindle:
        return fmt::format("ORIENT_SPINDLE(0, {:.4f}, {})", c.value, c.index);
    case CommandKind::user_command:
        return fmt::format("USER_DEFINED_FUNCTION({}, {:.4f}, {:.4f})", c.index, c.value, c.value_2);
    case CommandKind::program_end:
        return "PROGRAM_END()";
    case CommandKind::finish:
        return "FINISH()";
    case CommandKind::on_reset:
        return "ON_RESET()";
    default:
        return {};
    }
}

/// Of three axes, from `first` on.
std::string three(const AxisValues& values, std::size_t first) {
    return fmt::format("{:.4f} {:.4f} {:.4f}", values[first], values[first + 1], values[first + 2]);
}

std::string offset_text(const AxisValues& o) {
    return fmt::format("USE_TOOL_LENGTH_OFFSET({}, {}, {})", three(o, 0), three(o, 3), three(o, 6));
}

std::string tool_text(int row, const Tool& tool) {
    const AxisValues& o = tool.offset;
    return fmt::format("SET_TOOL_TABLE_ENTRY({}, {}, {} {} {}, {:.4f}, {:.4f}, {})",
                       row,
                       tool.number,
                       three(o, 0),
                       three(o, 3),
                       three(o, 6),
                       tool.front_angle,
                       tool.back_angle,
                       tool.orientation);
}

std::string_view move_name(MoveKind kind) {
    switch (kind) {
    case MoveKind::feed:
        return "STRAIGHT_FEED(";
    case MoveKind::arc:
        return "ARC_FEED(";
    case MoveKind::probe:
        return "STRAIGHT_PROBE(";
    case MoveKind::rigid_tap:
        return "RIGID_TAP(";
    case MoveKind::traverse:
        break;
    }
    return "STRAIGHT_TRAVERSE(";
}

/// As "{:.4f}" writes it, several times as fast: most of the time of a long program goes here.
void append_number(std::string& text, double value) {
    constexpr double largest = 1e11;  // so that the rounding of the product stays far below `doubtful`
    constexpr double doubtful = 1e-3; // nearer to a tie the exact decimals decide
    const double scaled = std::abs(value) * 1e4;
    const double whole = std::floor(scaled);
    const double rest = scaled - whole;
    const bool minus_nothing = std::signbit(value) && scaled < 1.0;
    if (!(scaled < largest) || std::abs(rest - 0.5) < doubtful || minus_nothing) {
        fmt::format_to(std::back_inserter(text), "{:.4f}", value);
        return;
    }
    const auto units = static_cast<std::uint64_t>(whole) + (rest > 0.5 ? 1U : 0U);
    if (std::signbit(value)) {
        text += '-';
    }
    const fmt::format_int ones(units / 10'000);
    text.append(ones.data(), ones.size());
    const auto decimals = static_cast<std::uint32_t>(units % 10'000);
    const auto digit = [](std::uint32_t n) { return static_cast<char>('0' + n % 10); };
    const std::array<char, 5> fraction{
        '.', digit(decimals / 1000), digit(decimals / 100), digit(decimals / 10), digit(decimals)};
    text.append(fraction.data(), fraction.size());
}

} // namespace

CanonPrinter::CanonPrinter(Write write) : write_(std::move(write)) {
    text_.reserve(piece_size + 4096);
}

void CanonPrinter::flush() {
    if (!text_.empty()) {
        write_(text_);
        text_.clear();
    }
}

/// The running number and the N number of the program's line.
void CanonPrinter::begin_line(const SourceLine& now) {
    const fmt::format_int number(++number_);
    text_.append(number.size() < 5 ? 5 - number.size() : 0, ' ');
    text_.append(number.data(), number.size());
    text_ += ' ';
    std::string_view line = now.text;
    const std::size_t begin = line.find_first_not_of("\t /");
    line.remove_prefix(begin == std::string_view::npos ? line.size() : begin);
    if (line.empty() || (line.front() != 'N' && line.front() != 'n')) {
        text_ += "N..... ";
        return;
    }
    line.remove_prefix(1);
    const std::string_view digits = line.substr(0, line.find_first_not_of("0123456789"));
    fmt::format_to(std::back_inserter(text_), "N{:<6}", digits);
}

void CanonPrinter::end_line() {
    text_ += ")\n";
    if (text_.size() >= piece_size) {
        flush();
    }
}

void CanonPrinter::argument(double value) {
    append_number(text_, value);
    text_ += ", ";
}

/// Those behind the first three, or all.
void CanonPrinter::axes(const AxisValues& values) {
    for (std::size_t n = 6; n < axis_count; ++n) {
        uvw_ = uvw_ || values[n] < 0.0 || values[n] > 0.0;
    }
    for (std::size_t n = 3; n < (uvw_ ? axis_count : 6); ++n) {
        argument(values[n]);
    }
    text_.resize(text_.size() - 2);
}

void CanonPrinter::move(const Move& move, const SourceLine& now) {
    begin_line(now);
    text_ += move_name(move.kind);
    const AxisValues& t = move.target;
    if (move.kind == MoveKind::arc) {
        const bool xy = move.plane == Plane::xy;
        const bool xz = move.plane == Plane::xz;
        argument(xy ? t[Axis::x] : xz ? t[Axis::z] : t[Axis::y]);
        argument(xy ? t[Axis::y] : xz ? t[Axis::x] : t[Axis::z]);
        argument(move.centre_1);
        argument(move.centre_2);
        fmt::format_to(std::back_inserter(text_), "{}, ", move.turns);
        argument(xy ? t[Axis::z] : xz ? t[Axis::y] : t[Axis::x]);
    } else {
        argument(t[Axis::x]);
        argument(t[Axis::y]);
        argument(t[Axis::z]);
    }
    if (move.kind == MoveKind::rigid_tap) {
        text_.resize(text_.size() - 2);
    } else {
        axes(t);
    }
    end_line();
}

void CanonPrinter::curve(const Curve& curve, const SourceLine& now) {
    begin_line(now);
    fmt::format_to(std::back_inserter(text_), "NURBS_FEED({}, ...", curve.points.size());
    end_line();
}

void CanonPrinter::command(const Command& c, const SourceLine& now) {
    const auto out = std::back_inserter(text_);
    if (c.kind == CommandKind::wait_input || c.kind == CommandKind::measure_position ||
        c.kind == CommandKind::read_unknown) {
        return; // rs274 prints nothing
    }
    if (c.kind == CommandKind::print) {
        fmt::format_to(out, "{}\n", c.text);
        return;
    }
    begin_line(c.kind == CommandKind::on_reset ? SourceLine{} : now); // the program is over: no line's number
    if (c.kind > CommandKind::optional_program_stop) {
        text_ += own_text(c);
        text_ += '\n';
        return;
    }
    const CanonFunction& word = canon_functions[static_cast<std::size_t>(c.kind)];
    switch (word.form) {
    case Form::plain:
        fmt::format_to(out, "{}(", word.name);
        break;
    case Form::spindle:
        fmt::format_to(out, "{}(0", word.name);
        break;
    case Form::value:
        fmt::format_to(out, "{}({:.4f}", word.name, c.value);
        break;
    case Form::spindle_value:
        fmt::format_to(out, "{}(0, {:.4f}", word.name, c.value);
        break;
    case Form::index:
        fmt::format_to(out, "{}({}", word.name, c.index);
        break;
    case Form::index_value:
        fmt::format_to(out, "{}({},{:.6f}", word.name, c.index, c.value);
        break;
    case Form::text:
        fmt::format_to(out, "{}(\"{}\"", word.name, c.text);
        break;
    case Form::axes:
    case Form::indexed_axes:
        text_ += word.name;
        text_ += '(';
        if (word.form == Form::indexed_axes) {
            fmt::format_to(out, "{}, ", c.index);
        }
        argument(c.axes[0]);
        argument(c.axes[1]);
        argument(c.axes[2]);
        axes(c.axes);
        break;
    case Form::own:
        text_ += c.kind == CommandKind::use_tool_length_offset ? offset_text(c.axes)
                 : c.kind == CommandKind::set_tool_table_entry ? tool_text(c.index, c.tool)
                                                               : own_text(c);
        text_.pop_back();
        break;
    }
    end_line();
}

} // namespace millwright::gcode
