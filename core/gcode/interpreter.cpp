#include "core/gcode/interpreter.h"

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/gcode/internal/compensation_lookahead.h"
#include "core/gcode/internal/control_flow.h"
#include "core/gcode/internal/cursor.h"
#include "core/gcode/internal/execute.h"
#include "core/gcode/internal/expression.h"
#include "core/gcode/internal/grbl_words.h"
#include "core/gcode/internal/machine_codes.h"
#include "core/gcode/internal/offsets.h"
#include "core/gcode/internal/start_modes.h"
#include "core/gcode/language.h"
#include "core/gcode/word_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

namespace millwright::gcode {

using internal::ControlFlow;
using internal::Cursor;
using internal::is_percent;
using internal::LineSource;
using internal::ParsedLine;
using internal::Refusal;
using internal::Run;
using internal::SourceFiles;

namespace {

/// LinuxCNC's line buffer (LINELEN), without the end of the line.
constexpr std::size_t longest_line = 254;

std::vector<std::filesystem::path> folders_for(const std::filesystem::path& file,
                                               const ReaderSettings& settings) {
    std::vector<std::filesystem::path> folders{file.parent_path().empty() ? "." : file.parent_path()};
    folders.insert(folders.end(), settings.subroutine_folders.begin(), settings.subroutine_folders.end());
    return folders;
}

/// Left out when a program is sent to Grbl, wherever it stands.
bool is_grbl_percent(std::string_view line) {
    return is_percent(line.substr(0, line.find_first_of("(;")));
}

Refusal of_other_language(Language language) {
    return {1, fmt::format("this is {}, not G-code", name_of(language)), std::string(advice_for(language))};
}

bool says_the_end(std::string_view line) {
    constexpr double m2 = 2.0;
    constexpr double m30 = 30.0;
    return column_of_word(line, 'M', m2) > 0 || column_of_word(line, 'M', m30) > 0;
}

} // namespace

struct Interpreter::Parts {
    Parts(std::unique_ptr<LineSource> source,
          std::vector<std::filesystem::path> folders,
          ReaderSettings with,
          CanonSink& sink)
        : settings(std::move(with)), run(settings, sink), files(std::move(source), std::move(folders)),
          flow(run, files) {
        settings.any_tool = settings.any_tool || is_grbl(); // which has no tool table
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts() = default;

    enum class End { none, percent, program };

    [[nodiscard]] bool is_grbl() const { return settings.dialect == Dialect::grbl; }
    void start();
    bool step();
    void end_of_text();
    void reset();
    void expect_text(std::string_view text);
    void execute(std::string_view text);
    void execute_words(Cursor& cursor);
    void send_reads();
    bool execute_flow(Cursor& cursor);
    [[nodiscard]] std::optional<LineLanguage> language_ahead() const;
    void look_for_percent();
    void refuse_lines_behind_the_end();
    void check_repetition();
    void report(SourcePlace place, const Refusal& refusal);

    ReaderSettings settings;
    Run run;
    SourceFiles files;
    ControlFlow flow;
    ParsedLine line;
    std::string grbl_line; ///< as Grbl takes it, where that differs from the text
    std::vector<Diagnostic> errors;
    std::set<std::tuple<int, int, int>> told; ///< file, line and column of each error
    std::int64_t further_errors = 0;
    enum class Stage { fresh, reading, stopped };
    Stage stage = Stage::fresh;
    bool no_text = false;   ///< the file is of another kind
    bool seen_text = false; ///< a line that is not blank
    bool lacks_end = false;
    bool end_refused = false; ///< there is an end, in a line with something wrong
    bool watching_turns = false;
};

void Interpreter::Parts::start() {
    stage = Stage::reading;
    ModalState& s = run.state;
    if (is_grbl()) {
        s.motion = 0;
    }
    if (settings.dialect != Dialect::linuxcnc) { // whose work systems are not turned
        for (int system = 1; system <= 9; ++system) {
            run.variables.set(internal::parameter_g5x(system) + 9, 0.0);
        }
    }
    for (const auto& [number, value] : settings.parameters) {
        expects(internal::Variables::is_number(number), "a parameter that is set at the start exists");
        run.variables.set(number, value);
    }
    using internal::parameter_g5x;
    s.g5x_offset = run.to_program(run.variables.axes_from(parameter_g5x(1)));
    s.rotation_deg = run.variables.stored(parameter_g5x(1) + 9);
    if (run.variables.stored(internal::parameter_g92_active) > 0.0) {
        s.g92_offset = run.to_program(run.variables.axes_from(internal::parameter_g92));
        run.g92_known = run.variables.axes_set(internal::parameter_g92);
    } else if (run.variables.is_set(internal::parameter_g92_active)) {
        run.g92_known = internal::every_axis;
    }
    s.spindle_tool.unknown = tool_unknown;
    s.tool_offset[Axis::z] = settings.tool_length * run.machine_to_program();
    s.position = internal::relative_to_system(run.to_program(settings.start), s);
    run.out.send(CommandKind::use_length_units, static_cast<int>(s.unit));
    internal::send_system(run);
    internal::send_g92(run);
    internal::send_rotation(run);
    if (!exactly_equal(settings.tool_length, 0.0)) {
        run.out.send(internal::command_of(CommandKind::use_tool_length_offset, s.tool_offset));
    }
    run.out.send(CommandKind::set_feed_reference);
    run.out.send(CommandKind::on_reset);
    if (!settings.modes.empty()) {
        internal::take_modes(run, settings.modes);
    }
}

bool Interpreter::Parts::step() {
    if (stage == Stage::fresh) {
        start();
    }
    if (stage == Stage::stopped) {
        return false;
    }
    run.line_begin = files.here();
    std::string_view text;
    if (!files.next(text)) {
        end_of_text();
        return false;
    }
    run.out.begin({files.place(), text});
    run.variables.program.line = files.place().line;
    check_repetition();
    try {
        if (stage != Stage::stopped) {
            expect_text(text);
            execute(text);
        }
    } catch (const Refusal& refusal) {
        static_cast<void>(run.variables.take_reads());
        if (no_text) {
            stage = Stage::stopped; // what follows is no better
            report(files.place(), refusal);
        } else if (const std::optional<Language> language = language_of_line(text)) {
            stage = Stage::stopped; // each further line would only say it again
            report(files.place(), of_other_language(*language));
        } else if (const auto later = errors.empty() ? language_ahead() : std::nullopt) {
            stage = Stage::stopped;
            report({files.place().line + later->line, files.place().file},
                   of_other_language(later->language));
        } else {
            report(files.place(), refusal);
        }
        end_refused = end_refused || says_the_end(text);
    }
    if (run.ended && is_grbl()) {
        refuse_lines_behind_the_end();
    } else if (run.ended && run.in_percents) {
        look_for_percent();
    }
    const bool enough = !settings.read_on && std::ssize(errors) >= settings.most_errors;
    if (run.ended || enough) {
        stage = Stage::stopped;
    }
    if (stage == Stage::stopped) {
        reset();
    }
    return stage != Stage::stopped;
}

/// By a line soon behind the present one, whose own words are of no language alone: G71 G90 of Sinumerik,
/// #1=0 of a macro that Grbl is to read. The words of printers and plots may stand in G-code, too.
std::optional<LineLanguage> Interpreter::Parts::language_ahead() const {
    constexpr std::size_t soon = 1 << 16; // bytes
    const std::optional<LineLanguage> found = first_language(files.at_hand().substr(0, soon));
    const bool may_be_gcode =
        found && (found->language == Language::printer || found->language == Language::hpgl);
    return may_be_gcode ? std::nullopt : found;
}

/// Behind M2 the text is read on to its closing %.
void Interpreter::Parts::look_for_percent() {
    std::string_view text;
    while (files.next(text)) {
        if (is_percent(text)) {
            return;
        }
    }
    run.out.send(
        internal::command_of(CommandKind::comment, "interpreter: percent sign missing from end of file"));
}

/// M2 ends nothing for Grbl: it would execute what is sent behind it.
void Interpreter::Parts::refuse_lines_behind_the_end() {
    std::string_view text;
    while (files.next(text)) {
        Cursor cursor(text);
        try {
            while (cursor.peek() == '(') {
                static_cast<void>(internal::read_comment(cursor));
            }
            if (!cursor.at_end() && cursor.peek() != ';' && !is_grbl_percent(text)) {
                internal::refuse(cursor.column(),
                                 "this line is after the end of the program, but Grbl would execute it",
                                 "delete it, or the M2 or M30 above it");
            }
        } catch (const Refusal& refusal) {
            report(files.place(), refusal);
            return;
        }
    }
}

/// The outermost loop that has gone round in the second half of the patience is taken for the one without
/// end.
void Interpreter::Parts::check_repetition() {
    const std::int64_t repeated = files.repeated_lines();
    if (repeated <= settings.most_repeated_lines / 2) {
        return;
    }
    if (!std::exchange(watching_turns, true)) {
        flow.forget_turns();
    }
    if (repeated > settings.most_repeated_lines) {
        stage = Stage::stopped;
        report(flow.turned().value_or(files.place()),
               {1,
                fmt::format(
                    "the program seems to loop forever from here: more than {} lines were executed again",
                    settings.most_repeated_lines),
                {}});
    }
}

void Interpreter::Parts::end_of_text() {
    stage = Stage::stopped;
    run.out.begin({files.place(), {}});
    try {
        // after a return that was refused, what is missing behind it is no further fault
        const bool is_lost = flow.return_refused();
        if (flow.in_subroutine() && !is_lost) {
            internal::refuse(
                1,
                fmt::format("the file ends inside a subroutine called in line {}", flow.called_from().line));
        }
        if (run.in_percents) {
            internal::refuse(
                1, "the program starts with % but does not end with %", "end the program with M2 or %");
        }
        if (!seen_text) {
            internal::refuse(1, "the program is empty");
        }
        if (end_refused || is_lost) {
            return reset();
        }
        if (!is_grbl() && !settings.may_lack_end) {
            internal::refuse(
                1,
                "the program has no end: M2, M30 or % is missing",
                "LinuxCNC reports an error there; if the file is complete, add M2 as the last line");
        }
        lacks_end = true;
        if (!is_grbl()) {
            internal::end_program(run, false);
        }
    } catch (const Refusal& refusal) {
        report(files.place(), refusal);
    }
    reset();
}

/// LinuxCNC does so when it closes the file, and once more when the interpreter ends.
void Interpreter::Parts::reset() {
    run.out.send(CommandKind::on_reset);
    run.out.send(CommandKind::on_reset);
}

void Interpreter::Parts::expect_text(std::string_view text) {
    const std::string_view encoding = files.place().line == 1 ? wide_encoding(text) : std::string_view();
    const std::size_t zero = text.find('\0');
    no_text = !encoding.empty() || zero != std::string_view::npos;
    if (!encoding.empty()) {
        internal::refuse(1, fmt::format("the file is {}", encoding), "save it as plain text");
    }
    if (no_text) {
        internal::refuse(
            static_cast<int>(zero) + 1, "byte 0x00 found: this is a binary file", "choose a G-code file");
    }
}

void Interpreter::Parts::execute(std::string_view text) {
    if (files.cut() || (!is_grbl() && text.size() > longest_line)) {
        internal::refuse(static_cast<int>(longest_line) + 1,
                         fmt::format("a line may have at most {} characters", longest_line));
    }
    Cursor cursor(text);
    if (cursor.at_end()) {
        return;
    }
    if (is_grbl() && is_grbl_percent(text)) {
        return;
    }
    if (!is_grbl() && cursor.peek() == '%' && is_percent(text)) {
        if (!seen_text) {
            run.in_percents = seen_text = true;
            return;
        }
        if (run.in_percents) {
            internal::finish_waiting(run);
            run.out.send(CommandKind::finish);
            stage = Stage::stopped;
            return;
        }
    }
    seen_text = true;
    if (is_grbl()) {
        cursor = Cursor(
            internal::grbl_words(text, {settings.mist, settings.grbl_axes, settings.grbl_name}, grbl_line));
    }
    if (cursor.take('/') && settings.block_delete) {
        return;
    }
    if (cursor.take('N')) {
        internal::read_line_number(cursor);
    }
    if (!execute_flow(cursor)) {
        execute_words(cursor);
    }
    send_reads();
}

/// Before the line moves anything: its words are only as certain as what it reads.
void Interpreter::Parts::send_reads() {
    for (const internal::ParameterRead& read : run.variables.take_reads()) {
        if (read.unknown > 0) {
            Command unknown = internal::command_of(CommandKind::read_unknown, read.unknown);
            unknown.mode = read.column;
            run.out.send(unknown);
            continue;
        }
        Command measured = internal::command_of(CommandKind::measure_position, 0, read.column);
        measured.value_2 = read.on_machine ? 1.0 : 0.0;
        measured.mode = read.axes;
        run.out.send(measured);
    }
}

/// O-words, M98 and M99 of subprograms; false for any other line.
bool Interpreter::Parts::execute_flow(Cursor& cursor) {
    const char c = cursor.peek();
    if (c == 'O') {
        // What is wrong in here makes all the rest of the program uncertain.
        try {
            flow.execute(cursor);
        } catch (Refusal& refusal) {
            stage = Stage::stopped;
            if (settings.read_on) { // where the first error is not the last
                refusal.hint += refusal.hint.empty() ? "" : "; ";
                refusal.hint += "the lines after it were not checked";
            }
            throw;
        }
        return true;
    }
    if (c != 'M') {
        return false;
    }
    Cursor ahead = cursor;
    ahead.advance();
    if (!internal::is_digit(ahead.peek())) {
        return false;
    }
    const double code = internal::read_number(ahead);
    if (code > 97.9 && code < 98.1) {
        line.clear();
        internal::parse_words(ahead, run.variables, line);
        flow.call_fanuc(line);
        return true;
    }
    return code > 98.9 && code < 99.1 && flow.return_fanuc(ahead);
}

void Interpreter::Parts::execute_words(Cursor& cursor) {
    line.clear();
    internal::parse_words(cursor, run.variables, line);
    send_reads();
    constexpr int m99 = 99;
    if (line.block.code(internal::MGroup::stopping) == m99 && flow.in_subroutine()) {
        flow.refuse_return();
        internal::refuse(line.block.column_of(internal::MGroup::stopping),
                         "M99 in a subprogram must be the only word in its line");
    }
    internal::execute_line(run, line);
}

/// A line of a loop or a subroutine is wrong once, however often it is come to.
void Interpreter::Parts::report(SourcePlace place, const Refusal& refusal) {
    if (!told.emplace(place.file, place.line, refusal.column).second) {
        return;
    }
    if (std::ssize(errors) >= settings.most_errors) {
        ++further_errors;
        return;
    }
    Diagnostic found;
    found.place = {files.name_of(place.file), std::max(place.line, 1), refusal.column, -1};
    found.message = refusal.rule;
    found.hint = refusal.hint;
    errors.push_back(std::move(found));
}

Interpreter::Interpreter(const std::filesystem::path& file, ReaderSettings settings, CanonSink& sink)
    : parts_(std::make_unique<Parts>(
          std::make_unique<LineSource>(file), folders_for(file, settings), std::move(settings), sink)) {}

Interpreter::Interpreter(std::string_view text,
                         std::filesystem::path name,
                         ReaderSettings settings,
                         CanonSink& sink)
    : parts_(std::make_unique<Parts>(std::make_unique<LineSource>(text, std::move(name)),
                                     std::vector(settings.subroutine_folders), // before they move away
                                     std::move(settings),
                                     sink)) {}

Interpreter::Interpreter(Interpreter&&) noexcept = default;
Interpreter& Interpreter::operator=(Interpreter&&) noexcept = default;
Interpreter::~Interpreter() = default;

bool Interpreter::step() {
    return parts_->step();
}

void Interpreter::run() {
    while (parts_->step()) {
    }
}

const ModalState& Interpreter::state() const {
    return parts_->run.state;
}

double Interpreter::parameter(int number) const {
    expects(internal::Variables::is_number(number), "a parameter exists");
    return parts_->run.variables.stored(number);
}

SourcePlace Interpreter::place() const {
    return parts_->run.out.place();
}

std::optional<Diagnostic> Interpreter::end_notice() const {
    if (!parts_->lacks_end) {
        return std::nullopt;
    }
    return Diagnostic{{parts_->files.name_of(0)},
                      fmt::format("the program does not end with {}; it was read to its last line",
                                  parts_->is_grbl() ? "M2 or M30" : "M2, M30 or %"),
                      parts_->is_grbl() ? "Grbl does not switch off the spindle and the coolant" : ""};
}

int Interpreter::line_count() const {
    return parts_->files.program_lines();
}

const std::vector<Diagnostic>& Interpreter::errors() const {
    return parts_->errors;
}

std::int64_t Interpreter::further_errors() const {
    return parts_->further_errors;
}

} // namespace millwright::gcode
