// The subroutines of ControlFlow: definitions, calls, returns, in LinuxCNC's and in Fanuc's manner.
#include "core/gcode/internal/control_flow.h"
#include "core/gcode/internal/expression.h"
#include "core/gcode/internal/line_parser.h"
#include "core/gcode/internal/saved_modes.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace millwright::gcode::internal {

namespace {

constexpr std::size_t most_subroutines = 100'000;

} // namespace

void ControlFlow::define(const Line& line, Cursor& cursor) {
    expect_end_of_line(cursor);
    const SourcePlace place = run_.out.place();
    if (in_subroutine()) {
        refuse(line.column, "a subroutine definition must not contain another one");
    }
    const auto [entry, is_new] = defined_at_.try_emplace(line.label, place);
    if (!is_new && !(entry->second == place)) {
        refuse(line.column,
               fmt::format("subroutine O{} is already defined in line {}", line.label, entry->second.line));
    }
    if (defined_at_.size() > most_subroutines) {
        refuse(line.column, fmt::format("a program may have at most {} subroutines", most_subroutines));
    }
    subroutines_.insert_or_assign(line.label, files_.here());
    skip_to(line.label, {OWord::endsub}, nullptr, place);
}

void ControlFlow::call(const Line& line, Cursor& cursor) {
    std::array<double, argument_count> arguments{};
    std::size_t count = 0;
    for (char c = cursor.peek(); c == '[' || c == '('; c = cursor.peek()) {
        if (c == '(') {
            static_cast<void>(read_comment(cursor));
            continue;
        }
        if (count == arguments.size()) {
            refuse(cursor.column(),
                   fmt::format("a subroutine may have at most {} arguments", argument_count));
        }
        arguments[count++] = read_bracketed(cursor, run_.variables);
    }
    expect_end_of_line(cursor);
    enter(line.label, false, 0);
    for (std::size_t n = 0; n < arguments.size(); ++n) {
        frames_.back().caller_arguments[n] = run_.variables.stored(static_cast<int>(n) + 1);
        run_.variables.set(static_cast<int>(n) + 1, arguments[n]);
    }
    run_.variables.set("n_args", static_cast<double>(count));
}

void ControlFlow::enter(const std::string& name, bool fanuc, int repeats) {
    constexpr std::size_t deepest_calls = 9; // LinuxCNC's INTERP_SUB_ROUTINE_LEVELS is 10, with the program
    if (frames_.size() >= deepest_calls) {
        refuse(1, fmt::format("subroutine calls are nested more than {} deep", deepest_calls));
    }
    const Bookmark return_to = files_.here();
    go_to_subroutine(name, fanuc ? OWord::bare : OWord::sub);
    Frame frame;
    frame.name = name;
    frame.return_to = return_to;
    frame.called_from = run_.out.place();
    frame.caller_names = std::exchange(run_.variables.local_names(), {});
    frame.caller_saved = std::exchange(run_.saved, std::nullopt);
    frame.caller_open = std::exchange(open_, {});
    frame.fanuc = fanuc;
    frame.repeats = repeats;
    frame.begin = files_.here();
    frames_.push_back(std::move(frame));
    run_.variables.program.call_level = static_cast<int>(frames_.size());
}

/// Known ones at once; else a file of that name, else further down in the present file.
void ControlFlow::go_to_subroutine(const std::string& name, OWord head) {
    const auto known = subroutines_.find(name);
    if (known != subroutines_.end()) {
        files_.go_to(known->second);
        return;
    }
    const Bookmark before = files_.here();
    const bool in_file = files_.open_subroutine(name);
    std::string_view text;
    while (files_.next(text) && !closes_program(text)) {
        Cursor cursor(text);
        const auto found = read_plain_o_head(cursor);
        if (found && found->label == name && found->word == head) {
            expect_end_of_line(cursor);
            subroutines_.insert_or_assign(name, files_.here());
            defined_at_.insert_or_assign(name, files_.place());
            return;
        }
    }
    files_.go_to(before);
    refuse(1,
           in_file ? fmt::format("the file of subroutine O<{}> does not define it", name)
                   : fmt::format("subroutine O<{}> is not defined, and there is no file {}.ngc", name, name));
}

/// As in LinuxCNC, the label of the line does not matter.
void ControlFlow::leave_subroutine(const Line& line, Cursor& cursor) {
    if (!in_subroutine() || frames_.back().fanuc) {
        refuse(line.column, "endsub and return are only allowed in a subroutine");
    }
    const bool returns_value = cursor.peek() == '[';
    run_.variables.program.return_value = returns_value ? read_bracketed(cursor, run_.variables) : 0.0;
    run_.variables.program.value_returned = returns_value;
    expect_end_of_line(cursor);
    for (std::size_t n = 0; n < argument_count; ++n) {
        run_.variables.set(static_cast<int>(n) + 1, frames_.back().caller_arguments[n]);
    }
    pop_frame();
}

void ControlFlow::pop_frame() {
    Frame frame = std::move(frames_.back());
    frames_.pop_back();
    run_.variables.local_names() = std::move(frame.caller_names);
    run_.variables.program.call_level = static_cast<int>(frames_.size());
    open_ = std::move(frame.caller_open);
    const std::optional<SavedModes> saved = std::exchange(run_.saved, std::move(frame.caller_saved));
    files_.go_to(frame.return_to);
    if (saved && saved->restore_on_return) {
        restore_modes(run_, *saved);
    }
}

// ---- Fanuc's manner

void ControlFlow::call_fanuc(const ParsedLine& line) {
    const Block& block = line.block;
    constexpr std::uint32_t used = words_of("PL");
    if ((block.words & ~used) != 0 || block.g_groups != 0 || block.m_groups != 0 || block.polar() ||
        !line.assignments.empty()) {
        refuse(1, "only P and L may be in a line with M98: anything else would not be executed");
    }
    const double p = block.value_or('P', -1.0);
    constexpr double largest_number = 1e8;
    if (!(p >= 0.0 && p <= largest_number) || std::abs(p - std::round(p)) > 1e-4) {
        refuse(block.column_of('P'), "M98 needs a subprogram number, P");
    }
    const int repeats = static_cast<int>(block.value_or('L', 1.0));
    if (repeats > 0) {
        enter(std::to_string(static_cast<int>(std::round(p))), true, repeats - 1);
    }
}

bool ControlFlow::return_fanuc(Cursor& cursor) {
    if (!in_subroutine()) {
        return false;
    }
    refuse_return(); // until it is known to be right
    if (cursor.peek() == 'P') {
        refuse(cursor.column(),
               "M99 with P continues at another line of the caller, which LinuxCNC does not support",
               "use M99 without P");
    }
    expect_end_of_line(cursor, "M99");
    if (!frames_.back().fanuc) {
        refuse(1, "M99 ends a subprogram called by M98, but this one ends with endsub");
    }
    return_refused_ = false;
    if (frames_.back().repeats-- > 0) {
        note_turn(outer_depth() - 1, frames_.back().called_from);
        files_.go_to(frames_.back().begin);
        return true;
    }
    pop_frame();
    return true;
}

} // namespace millwright::gcode::internal
