#include "core/posts/post_file.h"

#include "core/base/error.h"
#include "core/base/file_format.h"
#include "core/base/json.h"
#include "core/posts/internal/post_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace millwright::posts {

namespace {

using internal::choice;
using internal::lines;
using internal::lines_with;
using internal::pattern;
using internal::text_of;

constexpr int most_decimals = 6;

LineFormat line_format(const JsonValue& value) {
    value.expect_only({"separator", "longest"});
    LineFormat result;
    result.separator = text_of(value.at("separator"));
    if (!result.separator.empty() && result.separator != " ") {
        value.at("separator").fail("the separator must be one space or empty");
    }
    result.longest = value.at("longest").integer(20, 10'000);
    return result;
}

LineNumbers line_numbers(const JsonValue& value) {
    value.expect_only({"lines", "prefix", "first", "step"});
    LineNumbers result;
    result.lines = choice<NumberedLines>(value.at("lines"),
                                         {{"on-request", NumberedLines::on_request},
                                          {"always", NumberedLines::always},
                                          {"every-line", NumberedLines::every_line}});
    result.prefix = text_of(value.at("prefix"));
    result.first = value.at("first").integer(0, 100'000);
    result.step = value.at("step").integer(1, 1'000);
    return result;
}

CommentFormat comment_format(const JsonValue& value) {
    value.expect_only({"open", "close", "longest", "upper_case", "forbidden"});
    CommentFormat result;
    result.open = text_of(value.at("open"));
    result.close = text_of(value.at("close"));
    if (result.open.empty()) {
        value.at("open").fail("the start of a comment must not be empty");
    }
    result.longest = value.at("longest").integer(20, 10'000);
    if (const auto upper = value.find("upper_case")) {
        result.upper_case = upper->flag();
    }
    if (const auto forbidden = value.find("forbidden")) {
        result.forbidden = text_of(*forbidden);
    }
    if (result.forbidden.find('.') != std::string::npos) {
        value.at("forbidden").fail("the dot cannot be forbidden, because it replaces forbidden characters");
    }
    return result;
}

program::NumberFormat number_format(const JsonValue& value) {
    value.expect_only({"decimals", "plus", "leading_zero", "trailing_zeros", "point"});
    program::NumberFormat result;
    result.decimals = value.at("decimals").integer(0, most_decimals);
    const auto flag = [&](std::string_view key, bool& target) {
        if (const auto found = value.find(key)) {
            target = found->flag();
        }
    };
    flag("plus", result.plus);
    flag("leading_zero", result.leading_zero);
    flag("trailing_zeros", result.trailing_zeros);
    flag("point", result.point);
    if (!result.point && result.trailing_zeros && result.decimals > 0) {
        value.fail("numbers with decimals and trailing zeros need a decimal point");
    }
    return result;
}

NumberFormats number_formats(const JsonValue& value) {
    value.expect_only({"length", "angle", "feed", "speed", "time", "tolerance"});
    NumberFormats result;
    result.length = number_format(value.at("length"));
    result.angle = number_format(value.at("angle"));
    result.feed = number_format(value.at("feed"));
    result.speed = number_format(value.at("speed"));
    result.time = number_format(value.at("time"));
    result.tolerance = number_format(value.at("tolerance"));
    return result;
}

BlockLines block_lines(const JsonValue& value) {
    value.expect_only({"top",
                       "head",
                       "path_blended",
                       "path_exact",
                       "tool",
                       "spindle_clockwise",
                       "spindle_counterclockwise",
                       "spindle_off",
                       "coolant_on",
                       "coolant_off",
                       "dwell",
                       "pause",
                       "end",
                       "bottom"});
    BlockLines result;
    result.top = lines(value.at("top"), {"name"});
    result.head = lines(value.at("head"), {"path"});
    result.path_blended = pattern(value.at("path_blended"), {"tolerance"});
    result.path_exact = pattern(value.at("path_exact"), {});
    result.tool.clear();
    if (const auto tool = value.find("tool")) {
        result.tool = lines(*tool, {"tool"});
    }
    result.spindle_clockwise = lines_with(value.at("spindle_clockwise"), "speed", "tool");
    result.spindle_counterclockwise = lines_with(value.at("spindle_counterclockwise"), "speed", "tool");
    result.spindle_off = lines(value.at("spindle_off"));
    result.coolant_on = lines(value.at("coolant_on"));
    result.coolant_off = lines(value.at("coolant_off"));
    result.dwell = lines_with(value.at("dwell"), "time");
    result.pause = lines(value.at("pause"));
    result.end = lines(value.at("end"));
    result.bottom = lines(value.at("bottom"), {"name"});
    if (result.end.empty()) {
        value.at("end").fail("the end of a program must have at least one line");
    }
    return result;
}

MoveFormat move_format(const JsonValue& value) {
    value.expect_only({"code", "behind"});
    MoveFormat result;
    result.code = text_of(value.at("code"));
    if (const auto behind = value.find("behind")) {
        result.behind = text_of(*behind);
    }
    if (result.code.empty()) {
        value.at("code").fail("the code of a move must not be empty");
    }
    return result;
}

MoveFormats move_formats(const JsonValue& value) {
    value.expect_only({"rapid", "feed", "modal_codes", "modal_axes"});
    MoveFormats result;
    result.rapid = move_format(value.at("rapid"));
    result.feed = move_format(value.at("feed"));
    result.modal_codes = value.at("modal_codes").flag();
    result.modal_axes = value.at("modal_axes").flag();
    if (result.rapid == result.feed) {
        value.at("feed").fail("rapids and feeds must differ");
    }
    return result;
}

FeedFormat feed_format(const JsonValue& value) {
    value.expect_only({"mode", "word", "modal", "rapid_code", "feed_code", "first_code"});
    FeedFormat result;
    result.mode = choice<FeedWriting>(
        value.at("mode"),
        {{"inverse-time", FeedWriting::inverse_time}, {"per-minute", FeedWriting::per_minute}});
    result.word = text_of(value.at("word"));
    result.modal = value.at("modal").flag();
    result.rapid_code = text_of(value.at("rapid_code"));
    result.feed_code = text_of(value.at("feed_code"));
    result.first_code = text_of(value.at("first_code"));
    if (result.word.empty()) {
        value.at("word").fail("the feed word must not be empty");
    }
    if (result.modal && result.mode == FeedWriting::inverse_time) {
        value.at("modal").fail("an inverse-time feed belongs to its line and cannot be modal");
    }
    return result;
}

TipFormat tip_format(const JsonValue& value) {
    value.expect_only({"on", "off", "machine_rapid", "rapid_tolerance", "read_m_on", "read_m_off"});
    TipFormat result;
    result.on = lines(value.at("on"), {"tool"});
    result.off = lines(value.at("off"));
    result.machine_rapid = move_format(value.at("machine_rapid"));
    constexpr double nearest = 0.001;
    constexpr double farthest = 10.0;
    result.rapid_tolerance = value.at("rapid_tolerance").number(nearest, farthest);
    if (const auto on = value.find("read_m_on")) {
        result.read_m_on = on->integer(100, 999);
        result.read_m_off = value.at("read_m_off").integer(100, 999);
    }
    if (result.on.empty() || result.off.empty()) {
        value.fail("tip control needs at least one line for on and one for off");
    }
    return result;
}

ArcFormat arc_format(const JsonValue& value) {
    value.expect_only({"clockwise", "counterclockwise", "centre", "planes", "helical"});
    ArcFormat result;
    result.clockwise = text_of(value.at("clockwise"));
    result.counterclockwise = text_of(value.at("counterclockwise"));
    result.centre = choice<ArcCentre>(value.at("centre"),
                                      {{"relative", ArcCentre::relative},
                                       {"absolute", ArcCentre::absolute},
                                       {"radius", ArcCentre::radius}});
    result.xy = result.zx = result.yz = false;
    for (const JsonValue& plane : value.at("planes").items()) {
        bool ArcFormat::*allowed = choice<bool ArcFormat::*>(
            plane, {{"XY", &ArcFormat::xy}, {"ZX", &ArcFormat::zx}, {"YZ", &ArcFormat::yz}});
        result.*allowed = true;
    }
    result.helical = value.at("helical").flag();
    if (result.clockwise.empty() || result.clockwise == result.counterclockwise) {
        value.fail("each arc direction needs its own code");
    }
    return result;
}

std::string axes(const JsonValue& value) {
    const std::string text = value.text();
    std::string seen;
    for (const char c : text) {
        if (std::string_view("XYZABCUVW").find(c) == std::string_view::npos ||
            seen.find(c) != std::string::npos) {
            value.fail(fmt::format("'{}' must be a list of different letters from XYZABCUVW", text));
        }
        seen += c;
    }
    if (text.empty()) {
        value.fail("at least one axis is required");
    }
    return text;
}

/// What the parts have to do with each other.
void check_parts(const JsonValue& root, const PostFormat& post) {
    if ((post.positions == PositionsOf::tip) != post.tip.has_value()) {
        root.at("positions").fail("\"tip\" is required for tip positions and not allowed for axis positions");
    }
    if (post.tip && post.arcs) {
        root.at("arcs").fail("arcs can be fitted to axis positions only");
    }
    const bool remapped = post.tip && post.tip->read_m_on != 0;
    if (post.tip && post.reader == TextReader::linuxcnc && !remapped) {
        root.at("tip").fail("LinuxCNC needs the M codes of its configuration: read_m_on and read_m_off");
    }
    if (remapped && post.reader != TextReader::linuxcnc) {
        root.at("tip").at("read_m_on").fail("read_m_on is for LinuxCNC text only");
    }
    if (post.reader == TextReader::klartext && post.arcs) {
        root.at("arcs").fail("arcs cannot be written in Klartext");
    }
    if (post.reader == TextReader::grbl && post.tip) {
        root.at("tip").fail("Grbl has no tip control");
    }
    if (says_path_mode(post) && (post.blocks.path_blended.empty() || post.blocks.path_exact.empty())) {
        root.at("blocks").at("head").fail("{path} requires path_blended and path_exact");
    }
}

std::string extension_of(const JsonValue& value) {
    std::string extension = text_of(value);
    if (extension.empty() || extension.find_first_of("./ ") != std::string::npos) {
        value.fail("the extension must be a word without a dot");
    }
    return extension;
}

PostFormat post_of(const JsonValue& root) {
    expect_format(root, "millwright-post", "a post file");
    root.expect_only({"format",
                      "version",
                      "name",
                      "source",
                      "extension",
                      "reader",
                      "positions",
                      "axes",
                      "unit",
                      "time_unit",
                      "lines",
                      "line_numbers",
                      "comment",
                      "numbers",
                      "blocks",
                      "moves",
                      "feed",
                      "tip",
                      "arcs"});
    (void)root.at("version").integer(1, 1);
    PostFormat post;
    post.name = text_of(root.at("name"));
    post.source = root.at("source").text();
    post.extension = extension_of(root.at("extension"));
    post.reader = choice<TextReader>(root.at("reader"),
                                     {{"linuxcnc", TextReader::linuxcnc},
                                      {"grbl", TextReader::grbl},
                                      {"fanuc", TextReader::fanuc},
                                      {"klartext", TextReader::klartext}});
    post.positions =
        choice<PositionsOf>(root.at("positions"), {{"axes", PositionsOf::axes}, {"tip", PositionsOf::tip}});
    post.axes = axes(root.at("axes"));
    post.inches = choice<bool>(root.at("unit"), {{"mm", false}, {"inch", true}});
    post.milliseconds = choice<bool>(root.at("time_unit"), {{"s", false}, {"ms", true}});
    post.lines = line_format(root.at("lines"));
    post.line_numbers = line_numbers(root.at("line_numbers"));
    post.comment = comment_format(root.at("comment"));
    post.numbers = number_formats(root.at("numbers"));
    if (constexpr int least = 4; post.inches && post.numbers.length.decimals < least) {
        root.at("numbers")
            .at("length")
            .at("decimals")
            .fail("a length in inches needs at least 4 decimals: 0.001 inch is 0.0254 mm");
    }
    post.blocks = block_lines(root.at("blocks"));
    post.moves = move_formats(root.at("moves"));
    post.feed = feed_format(root.at("feed"));
    post.arcs.reset();
    if (const auto tip = root.find("tip")) {
        post.tip = tip_format(*tip);
    }
    if (const auto arcs = root.find("arcs")) {
        post.arcs = arc_format(*arcs);
    }
    check_parts(root, post);
    return post;
}

} // namespace

PostFormat read_post(const std::filesystem::path& file) {
    return post_of(JsonValue::read(file));
}

PostFormat parse_post(std::string_view text, const std::filesystem::path& file) {
    return post_of(JsonValue::parse(text, file));
}

bool says_path_mode(const PostFormat& post) {
    return std::any_of(post.blocks.head.begin(), post.blocks.head.end(), [](const std::string& line) {
        return line.find("{path}") != std::string::npos;
    });
}

} // namespace millwright::posts
