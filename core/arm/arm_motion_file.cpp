#include "core/arm/arm_motion_file.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/machine_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace millwright::arm {

namespace {

constexpr std::string_view arm_word_letters = "GXYZIJKABCRFMS";

struct Word {
    char letter = 0;
    double value = 0.0;
    Place place;
};

class Reader {
public:
    Reader(std::string_view text, const std::filesystem::path& file) : text_(without_byte_order_mark(text)) {
        refuse_wide_text(text, file);
        place_.file = file;
    }

    /// The words up to the next ';'; nothing at the end of the text.
    [[nodiscard]] std::optional<std::vector<Word>> next_block() {
        std::vector<Word> words;
        for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
            if (text_[at_] == ';') {
                advance(1);
                return words;
            }
            words.push_back(next_word());
        }
        if (!words.empty()) {
            fail(place_, "the ';' after the last block is missing");
        }
        return std::nullopt;
    }
    [[nodiscard]] Place place() {
        skip_blanks();
        return place_;
    }

    [[noreturn]] static void fail(const Place& place, std::string message) {
        throw Error(Diagnostic{.place = place, .message = std::move(message), .hint = {}});
    }

private:
    void advance(std::size_t count) {
        for (; count > 0; --count, ++at_) {
            const bool ends = text_[at_] == '\n';
            place_.line += ends ? 1 : 0;
            place_.column = ends ? 1 : place_.column + 1;
        }
    }
    void skip_blanks() {
        if (place_.line == 0) {
            place_.line = place_.column = 1;
        }
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) {
            advance(1);
        }
    }
    [[nodiscard]] Word next_word() {
        Word word;
        word.place = place_;
        const char found = text_[at_];
        word.letter = found >= 'a' && found <= 'z' ? static_cast<char>(found - 'a' + 'A') : found;
        if (arm_word_letters.find(word.letter) == std::string_view::npos) {
            const bool printable = found > ' ' && found < 127;
            fail(place_,
                 printable ? fmt::format("'{}' is not a word of a motion file", found)
                           : fmt::format("byte {} is not text", static_cast<unsigned char>(found)));
        }
        advance(1);
        skip_blanks();
        const std::size_t plus = at_ < text_.size() && text_[at_] == '+' ? 1 : 0;
        const char* begin = text_.data() + at_ + plus;
        const auto [end, failure] = std::from_chars(begin, text_.data() + text_.size(), word.value);
        if (failure != std::errc() || !std::isfinite(word.value) ||
            std::abs(word.value) > kinematics::farthest_mm) {
            const bool line_is_over = place_.line != word.place.line;
            fail(line_is_over ? word.place : place_,
                 fmt::format("{} needs a number from -{:g} to {:g}",
                             word.letter,
                             kinematics::farthest_mm,
                             kinematics::farthest_mm));
        }
        advance(plus + static_cast<std::size_t>(end - begin));
        return word;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    Place place_;
};

int whole(const Word& word, int low, int high) {
    const double value = word.value;
    if (value < low || value > high || std::floor(value) < value) {
        Reader::fail(word.place,
                     fmt::format("{} needs a whole number from {} to {}", word.letter, low, high));
    }
    return static_cast<int>(value);
}

/// The words of one block by letter.
class Words {
public:
    explicit Words(const std::vector<Word>& words) {
        for (const Word& word : words) {
            const Word*& seat = by_letter_[arm_word_letters.find(word.letter)];
            if (seat != nullptr) {
                Reader::fail(word.place, fmt::format("{} occurs twice in this block", word.letter));
            }
            seat = &word;
        }
    }
    [[nodiscard]] const Word* find(char letter) const { return by_letter_[arm_word_letters.find(letter)]; }
    [[nodiscard]] std::optional<double> value(char letter) const {
        const Word* word = find(letter);
        return word != nullptr ? std::optional(word->value) : std::nullopt;
    }
    /// Three words as a vector, those that are not there 0; nothing if none is there.
    [[nodiscard]] std::optional<Vec3> vector(const char (&names)[4]) const {
        Vec3 found = Vec3::Zero();
        bool any = false;
        for (int n = 0; n < 3; ++n) {
            const auto component = value(names[n]);
            found[n] = component.value_or(0.0);
            any = any || component;
        }
        return any ? std::optional(found) : std::nullopt;
    }

private:
    std::array<const Word*, arm_word_letters.size()> by_letter_{};
};

ArmBlock block_of(const Words& words, const Place& place, ArmMotion modal) {
    ArmBlock block;
    block.line = place.line;
    const Word* g = words.find('G');
    block.motion = g != nullptr ? static_cast<ArmMotion>(whole(*g, 1, 3)) : modal;
    block.way = words.vector("XYZ").value_or(Vec3::Zero());
    block.center = words.vector("IJK");
    block.radius = words.value('R');
    block.tool_axis = words.vector("ABC");
    block.feed = words.value('F');
    block.spindle = words.value('S');
    if (const Word* m = words.find('M')) {
        block.auxiliary = whole(*m, 0, 999);
    }
    if (block.tool_axis) {
        if (!(block.tool_axis->norm() > 1e-9)) {
            Reader::fail(place, "the tool axis A B C has no direction");
        }
        block.tool_axis->normalize();
    }
    if (block.motion != ArmMotion::line && block.center.has_value() == block.radius.has_value()) {
        Reader::fail(place, "an arc needs either its centre (I J K) or its radius (R)");
    }
    return block;
}

} // namespace

std::vector<ArmBlock> parse_arm_motion(std::string_view text, const std::filesystem::path& file) {
    Reader reader(text, file);
    std::vector<ArmBlock> blocks;
    ArmMotion modal = ArmMotion::line;
    for (Place place = reader.place();; place = reader.place()) {
        const auto words = reader.next_block();
        if (!words) {
            return blocks;
        }
        if (words->empty()) {
            continue;
        }
        blocks.push_back(block_of(Words(*words), place, modal));
        modal = blocks.back().motion;
    }
}

namespace {

constexpr double radius_tolerance = 0.01; // mm between the radii at both ends of an arc

[[noreturn]] void fail_in_motion(const std::filesystem::path& file, int line, std::string message) {
    throw Error(Diagnostic{.place = {.file = file, .line = line}, .message = std::move(message), .hint = {}});
}

/// A way with its length: the point at u in 0 ... 1, counted from its start.
struct Way {
    double length = 0.0;
    std::function<Vec3(double)> at;
};

/// From the start to the center, for an arc given by its radius in the XY plane.
Vec3 center_by_radius(const ArmBlock& block, const std::filesystem::path& file) {
    const Vec3& way = block.way;
    const double chord = way.head<2>().norm();
    const double radius = std::abs(*block.radius);
    if (!(chord > 0.0) || std::abs(way.z()) > 0.0) {
        fail_in_motion(
            file, block.line, "an arc given by its radius needs a different end point in the XY plane");
    }
    if (radius < 0.5 * chord - radius_tolerance) {
        fail_in_motion(file,
                       block.line,
                       fmt::format("the radius {} is less than half the distance, {:.4f}",
                                   shortest(radius),
                                   0.5 * chord));
    }
    const double height = std::sqrt(std::max(radius * radius - 0.25 * chord * chord, 0.0));
    const Vec3 left(-way.y() / chord, way.x() / chord, 0.0);
    const bool is_left = (block.motion == ArmMotion::counter_clockwise) == (*block.radius > 0.0);
    return 0.5 * way + (is_left ? height : -height) * left;
}

Way arc(const ArmBlock& block, const std::filesystem::path& file) {
    const Vec3 center = block.center ? *block.center : center_by_radius(block, file);
    const Vec3 from = -center, to = block.way - center;
    const double radius = from.norm();
    if (!(radius > 0.0) || std::abs(to.norm() - radius) > radius_tolerance) {
        fail_in_motion(file,
                       block.line,
                       fmt::format("the end is {:.4f} mm from the centre, but the start is {:.4f} mm",
                                   to.norm(),
                                   radius));
    }
    // Counter-clockwise as seen from above; of a plane on edge, from its positive side.
    Vec3 normal = from.cross(to);
    const bool in_line = !(normal.norm() > 1e-9 * radius * radius);
    if (in_line && std::abs(from.z()) > radius_tolerance) {
        fail_in_motion(file,
                       block.line,
                       "start, end and centre lie on a line that leaves the XY plane, so the plane of the "
                       "arc is undefined");
    }
    normal = in_line ? Vec3(Vec3::UnitZ()) : normal.normalized();
    const double above = std::abs(normal.z()) > 1e-9 ? normal.z() : normal.x() + normal.y();
    normal = above < 0.0 ? Vec3(-normal) : normal;
    normal = block.motion == ArmMotion::clockwise ? Vec3(-normal) : normal;
    const double turned = std::atan2(normal.dot(from.cross(to)), from.dot(to));
    constexpr double nothing = 1e-12; // the end at the start: a full circle
    const double angle = turned > nothing ? turned : turned + 2.0 * pi;
    return {radius * angle,
            [=](double u) { return Vec3(center + Eigen::AngleAxisd(u * angle, normal) * from); }};
}

Way way_of(const ArmBlock& block, const std::filesystem::path& file) {
    if (block.motion != ArmMotion::line) {
        return arc(block, file);
    }
    return {block.way.norm(), [way = block.way](double u) { return Vec3(u * way); }};
}

void expect_feed(const ArmBlock& block, const std::filesystem::path& file) {
    if (block.feed && !(*block.feed > 0.0)) {
        fail_in_motion(file, block.line, "the feed F must be above 0");
    }
}

/// The smallest turn that takes the tool axis from `from` to `to`, part of it.
Mat3 turned(const Mat3& tool, const Vec3& to, double share) {
    const Vec3 from = tool.col(2);
    const double angle = angle_between(from, to);
    const Vec3 across = from.cross(to);
    constexpr double straight = 1e-12; // rad
    const Vec3 about = across.norm() > straight ? across.normalized() : Vec3(tool.col(0));
    return Eigen::AngleAxisd(share * angle, about).toRotationMatrix() * tool;
}

} // namespace

void expect_arcs(const std::vector<ArmBlock>& blocks, const std::filesystem::path& file) {
    for (const ArmBlock& block : blocks) {
        (void)way_of(block, file);
        expect_feed(block, file);
    }
}

std::vector<ArmWay> ways_of(const ArmModel& arm,
                            const std::vector<ArmBlock>& blocks,
                            const JointPositions& start,
                            const std::filesystem::path& file) {
    std::vector<ArmWay> ways;
    Frame tool = base_T_tool(arm, start);
    tool.translation() =
        1e-9 * (1e9 * tool.translation()).array().round(); // the home of the thesis is 800 0 650
    double feed = default_arm_feed;
    for (const ArmBlock& block : blocks) {
        const Way way = way_of(block, file);
        const Vec3 axis = block.tool_axis.value_or(Vec3(tool.linear().col(2)));
        feed = block.feed.value_or(feed);
        expect_feed(block, file);
        const auto at = [tool, axis, from = way.at, end = block.way](double share) {
            Frame there = tool;
            there.translation() += share < 1.0 ? from(share) : end;
            there.linear() = turned(tool.linear(), axis, share);
            return there;
        };
        ways.push_back({at, way.length, way.length / feed, block.line});
        tool = at(1.0);
    }
    return ways;
}

bool sets_feed(const std::vector<ArmBlock>& blocks) {
    return std::ranges::any_of(blocks, [](const ArmBlock& block) { return block.feed.has_value(); });
}

} // namespace millwright::arm
