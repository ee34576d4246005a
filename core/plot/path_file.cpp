#include "core/plot/path_file.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

namespace millwright::plot {
namespace {

constexpr std::string_view title =
    "# millwright path 1: absolute; x mm, y mm, z mm, speed mm/s (0: rapid), move, tool";

struct MoveName {
    CutMove move;
    std::string_view name;
};
constexpr std::array names = {
    MoveName{CutMove::rapid, "rapid"},
    MoveName{CutMove::plunge, "plunge"},
    MoveName{CutMove::cut, "cut"},
    MoveName{CutMove::retract, "retract"},
    MoveName{CutMove::tool_change, "tool-change"},
};

/// One line of a file that is read; everything wrong about it ends the reading.
class Record {
public:
    Record(std::string_view line, const std::filesystem::path& file, int number)
        : file_(file), number_(number) {
        while (true) {
            const auto comma = line.find(',');
            fields_.push_back(line.substr(0, comma));
            if (comma == std::string_view::npos) {
                break;
            }
            line.remove_prefix(comma + 1);
        }
        constexpr std::size_t columns = 6;
        if (fields_.size() != columns) {
            fail(fmt::format("there are {} fields, but 6 are expected", fields_.size()));
        }
    }

    [[nodiscard]] CutPoint point() const {
        CutPoint point;
        point.at = {number(0), number(1), number(2)};
        point.speed = number(3);
        if (point.speed < 0.0) {
            fail(fmt::format("{} is not a valid speed", fields_[3]));
        }
        const auto name = std::ranges::find(names, fields_[4], &MoveName::name);
        if (name == names.end()) {
            fail(fmt::format("'{}' is not a move", fields_[4]));
        }
        point.move = name->move;
        const bool in_the_work = point.move == CutMove::plunge || point.move == CutMove::cut;
        if (in_the_work && !(point.speed > 0.0)) {
            fail(fmt::format("a {} has speed 0, which only a rapid may have", fields_[4]));
        }
        const double tool = number(5);
        constexpr double most_tools = 1e6;
        if (!(tool >= 0.0 && tool <= most_tools) || std::floor(tool) < tool) {
            fail(fmt::format("'{}' is not a tool", fields_[5]));
        }
        point.tool = static_cast<int>(tool);
        return point;
    }

private:
    [[nodiscard]] double number(std::size_t n) const {
        const std::string_view text = fields_[n];
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
            fail(fmt::format("'{}' is not a number", text));
        }
        return value;
    }

    [[noreturn]] void fail(std::string message) const {
        throw Error({.place = {.file = file_, .line = number_}, .message = std::move(message), .hint = {}});
    }

    const std::filesystem::path& file_;
    int number_;
    std::vector<std::string_view> fields_;
};

} // namespace

std::string path_file_text(const CutPath& path) {
    std::string text = std::string(title) + "\n";
    for (const CutPoint& point : path) {
        const auto* name = std::ranges::find(names, point.move, &MoveName::move);
        text += fmt::format("{},{},{},{},{},{}\n",
                            shortest(point.at.x()),
                            shortest(point.at.y()),
                            shortest(point.at.z()),
                            shortest(point.speed),
                            name->name,
                            point.tool);
    }
    return text;
}

bool is_path_file(std::string_view text) {
    return without_byte_order_mark(text).starts_with("# millwright path");
}

CutPath read_path(std::string_view text, const std::filesystem::path& file, std::vector<int>* lines) {
    CutPath path;
    refuse_wide_text(text, file);
    text = without_byte_order_mark(text);
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        if (number == 1 && line != title) {
            throw Error({.place = {.file = file, .line = 1},
                         .message = "this is not a path file",
                         .hint = fmt::format("the first line must be '{}'", title)});
        }
        if (number > 1 && !line.empty()) {
            path.push_back(Record(line, file, number).point());
            if (lines != nullptr) {
                lines->push_back(number);
            }
        }
    }
    return path;
}

} // namespace millwright::plot
