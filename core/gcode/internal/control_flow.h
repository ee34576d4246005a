// O-words: subroutines, conditions and loops, and Fanuc's M98 and M99. The text is not kept: what is left out
// is read over, what is repeated is read again.
#pragma once

#include "core/gcode/internal/cursor.h"
#include "core/gcode/internal/line_parser.h"
#include "core/gcode/internal/run.h"
#include "core/gcode/internal/source_files.h"

#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace millwright::gcode::internal {

enum class OWord : std::uint8_t {
    sub,
    endsub,
    call,
    do_,
    while_,
    repeat,
    if_,
    elseif,
    else_,
    endif,
    break_,
    continue_,
    endwhile,
    endrepeat,
    return_,
    bare, ///< O1000: a subprogram of Fanuc's manner
    unknown
};

class ControlFlow {
public:
    ControlFlow(Run& run, SourceFiles& files) : run_(run), files_(files) {}

    /// The line whose O is at the cursor. Throws Refusal.
    void execute(Cursor& cursor);
    /// M98 with its words read.
    void call_fanuc(const ParsedLine& line);
    /// M99, with the cursor behind it; false in the main program.
    [[nodiscard]] bool return_fanuc(Cursor& cursor);
    /// The M99 at hand is wrong: where the program goes on from here is not known.
    void refuse_return() { return_refused_ = true; }
    [[nodiscard]] bool return_refused() const { return return_refused_; }

    [[nodiscard]] bool in_subroutine() const { return !frames_.empty(); }
    /// Where the innermost subroutine was called; line 0 outside of any.
    [[nodiscard]] SourcePlace called_from() const;

    /// The outermost loop that has gone round since forget_turns(): where it begins. Without one, where the
    /// outermost subroutine was called that is being executed.
    [[nodiscard]] std::optional<SourcePlace> turned() const;
    void forget_turns() { turned_.reset(); }

private:
    /// An if, a loop or a definition that is open.
    struct Open {
        OWord kind = OWord::if_;
        std::string label;
        Bookmark begin; ///< of a while: before its line; of do and repeat: behind it
        SourcePlace place;
        int repeats = 0;
    };
    struct Turn {
        std::size_t depth = 0; ///< of blocks that are open round it
        SourcePlace place;
    };
    struct Frame {
        std::string name;
        Bookmark return_to;
        SourcePlace called_from;
        std::array<double, argument_count> caller_arguments{};
        NamedValues caller_names;
        std::optional<SavedModes> caller_saved;
        std::vector<Open> caller_open;
        bool fanuc = false;
        int repeats = 0;
        Bookmark begin;
    };
    struct Label {
        OWord kind = OWord::if_;
        SourcePlace place;
    };
    struct Line {
        std::string label;
        OWord word = OWord::unknown;
        int column = 1;
    };

    [[nodiscard]] Line read_head(Cursor& cursor) const;
    void open_block(const Line& line, Cursor& cursor, OWord kind);
    void note_label(const Line& line);
    [[nodiscard]] bool condition(Cursor& cursor) const;

    void begin_if(const Line& line, Cursor& cursor);
    void skip_branches(const Line& line);
    void leave_branch(const Line& line, Cursor& cursor);
    void while_or_end_of_do(const Line& line, Cursor& cursor);
    void begin_repeat(const Line& line, Cursor& cursor);
    void end_loop(const Line& line, Cursor& cursor, OWord kind);
    void break_or_continue(const Line& line, Cursor& line_end);

    void define(const Line& line, Cursor& cursor);
    void call(const Line& line, Cursor& cursor);
    void leave_subroutine(const Line& line, Cursor& cursor);
    void enter(const std::string& name, bool fanuc, int repeats);
    void pop_frame();
    void go_to_subroutine(const std::string& name, OWord head);

    /// Reads on to the line of `label` that has one of `words`, and past it. Throws Refusal at the end of the
    /// text, and for a subroutine in one that is skipped. If it is asked for, `cursor` is behind the word.
    OWord
    skip_to(const std::string& label, std::initializer_list<OWord> words, Cursor* cursor, SourcePlace opened);
    void go_round(const Open& open);
    void note_turn(std::size_t depth, SourcePlace place);
    /// Blocks that are open in the subroutines that wait.
    [[nodiscard]] std::size_t outer_depth() const;
    /// The % that closes the program: what stands behind it is not of it.
    [[nodiscard]] bool closes_program(std::string_view text) const;
    [[nodiscard]] Open* find_open(const std::string& label);
    void close(const std::string& label);
    [[nodiscard]] std::string scope() const { return frames_.empty() ? std::string() : frames_.back().name; }

    Run& run_;
    SourceFiles& files_;
    std::vector<Frame> frames_;
    bool return_refused_ = false;
    std::vector<Open> open_;
    std::map<std::string, Bookmark, std::less<>> subroutines_; ///< behind their first line
    std::map<std::string, SourcePlace, std::less<>> defined_at_;
    std::map<std::string, Label, std::less<>> labels_;
    std::string skipped_line_;
    std::optional<Turn> turned_;
};

// The head of a line with an O-word: its label and its keyword.

/// The keyword at the cursor, which goes past it.
[[nodiscard]] OWord read_o_keyword(Cursor& cursor);

struct OHead {
    std::string label;
    OWord word = OWord::unknown;
};

/// The head of a line that is read over: nothing where it has no O-word, or one with a computed label.
[[nodiscard]] std::optional<OHead> read_plain_o_head(Cursor& cursor);

/// Nothing but comments stands behind the cursor. `what` is for the message. Throws Refusal.
void expect_end_of_line(Cursor& cursor, std::string_view what = "an O-word");

/// A line of nothing but %.
[[nodiscard]] bool is_percent(std::string_view line);

} // namespace millwright::gcode::internal
