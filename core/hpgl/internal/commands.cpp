#include "core/hpgl/internal/commands.h"

#include "core/hpgl/internal/letters.h"
#include "core/hpgl/internal/moves.h"
#include "core/hpgl/internal/polygons.h"
#include "core/hpgl/internal/setup.h"

#include <array>
#include <cstdint>
#include <limits>

namespace millwright::hpgl::internal {
namespace {

constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
constexpr Arguments number_arguments = Arguments::numbers;

constexpr CommandRow moving(std::string_view name, Count count, Handler follow) {
    return {.name = name, .arguments = number_arguments, .count = count, .follow = follow, .moves = true};
}
constexpr CommandRow setting(std::string_view name, Count count, Handler follow) {
    return {.name = name, .arguments = number_arguments, .count = count, .follow = follow};
}
constexpr CommandRow placing(std::string_view name, Count count, Handler follow) {
    return {.name = name, .arguments = number_arguments, .count = count, .follow = follow, .places = true};
}
constexpr CommandRow
written(std::string_view name, Arguments arguments, Count count, Handler follow, bool moves) {
    return {.name = name, .arguments = arguments, .count = count, .follow = follow, .moves = moves};
}
constexpr CommandRow
left_out(std::string_view name, std::string_view why, Arguments arguments = Arguments::numbers) {
    return {.name = name, .arguments = arguments, .count = {0, any}, .why = why};
}

constexpr std::string_view a_question = "queries to the plotter";
constexpr std::string_view a_page = "pages are drawn on top of each other";
constexpr std::string_view a_font = "labels are drawn with Millwright's stroke font";
constexpr std::string_view a_colour = "colours of pens and paper have no effect on cutting";
constexpr std::string_view a_device = "plotter device settings";
constexpr std::string_view a_line_end = "line ends and joins have no effect on cutting";
constexpr std::string_view a_text = "text for the plotter's display";

constexpr std::array command_rows = {
    moving("AA", {3, 4}, arc_absolute),
    left_out("AC", "hatch lines start from P1"),
    left_out("AD", a_font),
    left_out("AF", a_page),
    left_out("AH", a_page),
    left_out("AP", a_device),
    moving("AR", {3, 4}, arc_relative),
    left_out("AS", a_device),
    moving("AT", {4, 5}, three_point_arc_absolute),
    written("BL", Arguments::label, {}, buffer_label, false),
    setting("BP", {0, any}, begin_plot),
    moving("BR", {6, any, 6}, bezier_relative),
    moving("BZ", {6, any, 6}, bezier_absolute),
    left_out("CA", a_font),
    left_out("CC", a_font),
    left_out("CF", a_font),
    moving("CI", {1, 2}, circle),
    left_out("CM", a_font),
    left_out("CO", "a comment", Arguments::comment),
    moving("CP", {0, 2, 2}, character_plot),
    left_out("CR", a_colour),
    left_out("CS", a_font),
    setting("CT", {0, 1}, chord_mode),
    left_out("CV", a_device),
    left_out("DC", a_device),
    setting("DF", {0, 0}, defaults),
    setting("DI", {0, 2, 2}, label_direction),
    left_out("DL", a_font),
    left_out("DP", a_device),
    setting("DR", {0, 2, 2}, relative_label_direction),
    left_out("DS", a_font),
    written("DT", Arguments::character, {0, 1}, label_terminator, false),
    setting("DV", {0, 2}, label_path),
    moving("EA", {2, 2}, edge_rectangle_absolute),
    left_out("EC", a_device),
    moving("EP", {0, 1}, edge_polygon),
    moving("ER", {2, 2}, edge_rectangle_relative),
    setting("ES", {0, 2}, extra_space),
    moving("EW", {3, 4}, edge_wedge),
    left_out("FI", a_font),
    left_out("FN", a_font),
    moving("FP", {0, 1}, fill_polygon),
    left_out("FR", a_page),
    left_out("FS", a_device),
    setting("FT", {0, 3}, fill_type),
    left_out("GC", a_device),
    left_out("GM", a_device),
    left_out("IM", a_device),
    setting("IN", {0, 1}, initialise),
    placing("IP", {0, 4, 2}, input_points),
    placing("IR", {0, 4, 2}, input_relative_points),
    left_out("IV", a_font),
    placing("IW", {0, 4, 4}, input_window),
    left_out("KY", a_device),
    left_out("LA", a_line_end),
    written("LB", Arguments::label, {}, label, true),
    left_out("LM", a_font),
    setting("LO", {0, 1}, label_origin),
    setting("LT", {0, 3}, line_type),
    left_out("MC", a_colour),
    left_out("MG", a_text, Arguments::label),
    left_out("MT", a_device),
    left_out("NP", a_colour),
    left_out("NR", a_page),
    left_out("OA", a_question),
    left_out("OC", a_question),
    left_out("OD", a_question),
    left_out("OE", a_question),
    left_out("OF", a_question),
    left_out("OG", a_question),
    left_out("OH", a_question),
    left_out("OI", a_question),
    left_out("OK", a_question),
    left_out("OL", a_question),
    left_out("OO", a_question),
    left_out("OP", a_question),
    left_out("OS", a_question),
    left_out("OT", a_question),
    left_out("OW", a_question),
    moving("PA", {0, any, 2}, plot_absolute),
    moving("PB", {0, 0}, print_buffered_label),
    left_out("PC", a_colour),
    moving("PD", {0, any, 2}, pen_down),
    written("PE", Arguments::encoded, {}, encoded_polyline, true),
    left_out("PG", a_page),
    moving("PM", {0, 1}, polygon_mode),
    left_out("PP", a_colour),
    moving("PR", {0, any, 2}, plot_relative),
    left_out("PS", "paper size"),
    setting("PT", {0, 1}, pen_thickness),
    moving("PU", {0, any, 2}, pen_up),
    setting("PW", {0, 2}, pen_width),
    left_out("QL", a_device),
    moving("RA", {2, 2}, fill_rectangle_absolute),
    left_out("RF", a_colour),
    placing("RO", {0, 1}, rotate),
    left_out("RP", a_page),
    moving("RR", {2, 2}, fill_rectangle_relative),
    moving("RT", {4, 5}, three_point_arc_relative),
    left_out("SA", a_font),
    left_out("SB", a_font),
    placing("SC", {0, 7}, scale),
    left_out("SD", a_font),
    setting("SI", {0, 2, 2}, character_size),
    setting("SL", {0, 1}, character_slant),
    written("SM", Arguments::character, {}, symbol_mode, false),
    setting("SP", {0, 1}, select_pen),
    setting("SR", {0, 2, 2}, relative_character_size),
    left_out("SS", a_font),
    left_out("ST", a_device),
    left_out("SV", a_colour),
    left_out("TD", a_font),
    setting("TL", {0, 2}, tick_length),
    left_out("TR", a_colour),
    moving("UC", {0, any}, user_character),
    left_out("UF", "custom hatch lines are drawn according to FT"),
    setting("UL", {0, 21}, user_line_type),
    setting("VS", {0, 2}, pen_speed),
    left_out("WD", a_text, Arguments::label),
    moving("WG", {3, 4}, fill_wedge),
    setting("WU", {0, 1}, width_unit),
    moving("XT", {0, 0}, x_tick),
    moving("YT", {0, 0}, y_tick),
};

constexpr std::uint8_t no_row = 255;
static_assert(command_rows.size() < no_row);

/// The row of each pair of letters.
constexpr auto row_of = [] {
    std::array<std::uint8_t, 26 * 26> table{};
    table.fill(no_row);
    for (std::size_t n = 0; n < command_rows.size(); ++n) {
        const auto first = static_cast<std::size_t>(command_rows[n].name[0] - 'A');
        const auto second = static_cast<std::size_t>(command_rows[n].name[1] - 'A');
        table[first * 26 + second] = static_cast<std::uint8_t>(n);
    }
    return table;
}();

} // namespace

const CommandRow* find_command(std::string_view name) {
    const auto row = row_of[static_cast<std::size_t>((name[0] - 'A') * 26 + (name[1] - 'A'))];
    return row == no_row ? nullptr : &command_rows[row];
}

Arguments arguments_of(std::string_view name) {
    const CommandRow* row = find_command(name);
    return row == nullptr ? Arguments::numbers : row->arguments;
}

std::span<const CommandRow> all_commands() {
    return command_rows;
}

} // namespace millwright::hpgl::internal
