// How one kind of control wants its programs written: what a post file says (docs/reference/post-file.md).
// The defaults are LinuxCNC with axis coordinates, assets/posts/linuxcnc.json.
#pragma once

#include "core/program/number_format.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::posts {

/// Who reads a text back before it is released.
enum class TextReader {
    linuxcnc, ///< RS-274/NGC as LinuxCNC reads it
    grbl,     ///< Grbl 1.1
    fanuc,    ///< RS-274 with G43.4 and dwells in ms
    klartext  ///< Heidenhain's conversational blocks
};

/// What X Y Z of a program are.
enum class PositionsOf {
    axes, ///< positions of the machine's axes
    tip   ///< the tool's tip on the part; the control turns them into axes
};

enum class FeedWriting {
    inverse_time, ///< moves per minute
    per_minute    ///< mm per minute along X Y Z, else degrees per minute
};

/// Lines of text with {placeholders}.
using Lines = std::vector<std::string>;

struct LineFormat {
    std::string separator = " "; ///< between words
    int longest = 255;           ///< characters

    friend bool operator==(const LineFormat&, const LineFormat&) = default;
};

enum class NumberedLines { on_request, always, every_line };

struct LineNumbers {
    NumberedLines lines = NumberedLines::on_request; ///< every_line: also comments, top and bottom
    std::string prefix = "N";
    int first = 10;
    int step = 10; ///< leaves room for lines that a person adds

    friend bool operator==(const LineNumbers&, const LineNumbers&) = default;
};

struct CommentFormat {
    std::string open = "(";
    std::string close = ")";
    int longest = 100; ///< characters of a line
    bool upper_case = false;
    std::string forbidden; ///< characters that become dots

    friend bool operator==(const CommentFormat&, const CommentFormat&) = default;
};

struct NumberFormats {
    program::NumberFormat length;
    program::NumberFormat angle; ///< degrees
    program::NumberFormat feed;
    program::NumberFormat speed{.decimals = 3, .trailing_zeros = false, .point = false}; ///< rpm
    program::NumberFormat time;
    program::NumberFormat tolerance; ///< of the path

    friend bool operator==(const NumberFormats&, const NumberFormats&) = default;
};

/// The lines of everything that is not a move. Those that are empty cannot be expressed.
struct BlockLines {
    Lines top;                                                  ///< first of all; {name}
    Lines head = {"G21 G90 G17 G40 G49 G80", "G54 G94 {path}"}; ///< before the first that is no comment
    std::string path_blended = "G64 P{tolerance}";              ///< {path}: corners may be rounded
    std::string path_exact = "G61";                             ///< {path}: they may not
    Lines tool = {"T{tool} M6", "G43 H{tool}"};                 ///< behind the head, where a tool is called
    Lines spindle_clockwise = {"S{speed} M3"};
    Lines spindle_counterclockwise = {"S{speed} M4"};
    Lines spindle_off = {"M5"};
    Lines coolant_on = {"M8"};
    Lines coolant_off = {"M9"};
    Lines dwell = {"G4 P{time}"};
    Lines pause = {"M0"};
    Lines end = {"M2"};
    Lines bottom; ///< last of all; {name}

    friend bool operator==(const BlockLines&, const BlockLines&) = default;
};

/// What surrounds the axis words of a move.
struct MoveFormat {
    std::string code;
    std::string behind; ///< the axis words

    friend bool operator==(const MoveFormat&, const MoveFormat&) = default;
};

struct MoveFormats {
    MoveFormat rapid{"G0", ""};
    MoveFormat feed{"G1", ""};
    bool modal_codes = true; ///< a code that is in force is left out
    bool modal_axes = true;  ///< so are axes that stay

    friend bool operator==(const MoveFormats&, const MoveFormats&) = default;
};

struct FeedFormat {
    FeedWriting mode = FeedWriting::inverse_time;
    std::string word = "F";
    bool modal = false;             ///< left out while it stays; never in inverse time
    std::string rapid_code = "G94"; ///< in force for rapids; none: empty
    std::string feed_code = "G93";  ///< in force for feeds
    std::string first_code = "G94"; ///< in force behind the head

    friend bool operator==(const FeedFormat&, const FeedFormat&) = default;
};

/// Tool centre point control.
struct TipFormat {
    Lines on;
    Lines off;
    MoveFormat machine_rapid;     ///< to machine positions, while it is off
    double rapid_tolerance = 0.5; ///< mm: a rapid is cut until its tip stays this near to the axes' own way
    int read_m_on = 0;            ///< M code that stands for on when LinuxCNC's text is read back; 0: none
    int read_m_off = 0;

    friend bool operator==(const TipFormat&, const TipFormat&) = default;
};

enum class ArcCentre { relative, absolute, radius };

struct ArcFormat {
    std::string clockwise = "G2";
    std::string counterclockwise = "G3";
    ArcCentre centre = ArcCentre::relative;
    bool xy = true, zx = true, yz = true; ///< planes that are allowed: G17, G18, G19
    bool helical = true;

    friend bool operator==(const ArcFormat&, const ArcFormat&) = default;
};

/// Everything. Read from a file it is consistent (post_file.h).
struct PostFormat {
    std::string name = "LinuxCNC";
    std::string source = "LinuxCNC 2.9, G-code reference";
    std::string extension = "ngc";
    TextReader reader = TextReader::linuxcnc;
    PositionsOf positions = PositionsOf::axes;
    std::string axes = "XYZABCUVW"; ///< letters that the control has
    bool inches = false;            ///< lengths and feeds
    bool milliseconds = false;      ///< dwells
    LineFormat lines;
    LineNumbers line_numbers;
    CommentFormat comment;
    NumberFormats numbers;
    BlockLines blocks;
    MoveFormats moves;
    FeedFormat feed;
    std::optional<TipFormat> tip; ///< there if and only if `positions` are of the tip
    std::optional<ArcFormat> arcs = ArcFormat{};

    /// mm of the unit that lengths are written in.
    [[nodiscard]] double length_unit() const { return inches ? 25.4 : 1.0; }

    friend bool operator==(const PostFormat&, const PostFormat&) = default;
};

} // namespace millwright::posts
