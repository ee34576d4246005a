#include "core/exchange/point_file.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/exchange/internal/file_kind.h"
#include "core/exchange/internal/word_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::exchange {

namespace {

using Fields = std::vector<std::string_view>;

/// From the first word to the end of the last one.
std::string_view whole_line(const Fields& words) {
    const char* begin = words.front().data();
    return {begin, static_cast<std::size_t>(words.back().data() + words.back().size() - begin)};
}

std::string_view trimmed_field(std::string_view field) {
    constexpr std::string_view white = " \t\r\f\v";
    const std::size_t from = field.find_first_not_of(white);
    return from == std::string_view::npos ? std::string_view()
                                          : field.substr(from, field.find_last_not_of(white) + 1 - from);
}

Fields split_at(std::string_view line, char separator) {
    Fields fields;
    while (true) {
        const std::size_t end = line.find(separator);
        fields.push_back(trimmed_field(line.substr(0, end)));
        if (end == std::string_view::npos) {
            return fields;
        }
        line.remove_prefix(end + 1);
    }
}

/// "1,5": a number whose decimal point is a comma.
bool has_decimal_comma(std::string_view field) {
    const std::size_t comma = field.find(',');
    if (comma == std::string_view::npos || comma + 1 == field.size()) {
        return false;
    }
    std::string with_point(field);
    with_point[comma] = '.';
    return number_from<double>(with_point).has_value();
}

class PointReader {
public:
    PointReader(std::string_view text, const std::filesystem::path& file) : file_(file), lines_(text) {}

    [[nodiscard]] MeasuredPoints read(const Progress& progress) {
        while (const Fields* words = lines_.next()) {
            if (lines_.number() % 4096 == 0) {
                progress.check();
            }
            take(*words);
        }
        if (read_.points.empty()) {
            throw Error("the file contains no points", file_, "write one point per line: x y z");
        }
        if (announced_ && std::cmp_not_equal(*announced_, read_.points.size())) {
            fail(announced_line_,
                 fmt::format("the file declares {}, but contains {}",
                             counted(*announced_, "point"),
                             read_.points.size()));
        }
        if (columns_ > 3) {
            read_.notes.push_back(fmt::format("only x, y and z of {} columns are used", columns_));
        }
        return std::move(read_);
    }

private:
    void take(const Fields& words) {
        if (words.empty()) {
            block_ended_ = true;
            return;
        }
        if (words.front().starts_with('#') || words.front().starts_with("//")) {
            return;
        }
        const Fields fields = fields_of(words);
        const bool first = std::exchange(first_line_, false);
        if (first && (is_count(fields) || is_header(fields))) {
            return;
        }
        add_point(fields);
    }

    [[nodiscard]] Fields fields_of(const Fields& words) {
        const std::string_view line = whole_line(words);
        const bool at_words = std::ranges::any_of(
            words, [](std::string_view word) { return word.starts_with(',') || word.ends_with(','); });
        const bool between = words.size() == 1 || at_words || std::ranges::none_of(words, has_decimal_comma);
        const bool commas = line.find(',') != std::string_view::npos && between;
        separator_ = line.find(';') != std::string_view::npos ? ';' : commas ? ',' : ' ';
        return separator_ == ' ' ? words : split_at(line, separator_);
    }

    /// As .pts files begin.
    [[nodiscard]] bool is_count(const Fields& fields) {
        const auto count = fields.size() == 1 ? number_from<int>(fields.front()) : std::nullopt;
        if (count && *count > 0) {
            announced_ = count;
            announced_line_ = lines_.number();
        }
        return announced_.has_value();
    }

    /// Names of columns: no field is a number.
    [[nodiscard]] bool is_header(const Fields& fields) {
        const bool names = std::ranges::none_of(fields, [](std::string_view field) {
            return number_from<double>(field).has_value() || has_decimal_comma(field);
        });
        if (!names || fields.size() < 3) {
            return false;
        }
        for (std::size_t axis = 0; axis < places_.size(); ++axis) {
            const auto named = [&](std::string_view field) {
                const bool letter =
                    !field.empty() && std::tolower(static_cast<unsigned char>(field[0])) == "xyz"[axis];
                return letter &&
                       (field.size() == 1 || std::isalnum(static_cast<unsigned char>(field[1])) == 0);
            };
            const auto found = std::ranges::find_if(fields, named);
            if (found == fields.end()) {
                fail(lines_.number(),
                     fmt::format("there is no column named {}", "xyz"[axis]),
                     "name the columns x, y and z, or leave out the names: then the first three columns are "
                     "used");
            }
            places_[axis] = static_cast<std::size_t>(found - fields.begin());
        }
        columns_ = fields.size();
        return true;
    }

    void add_point(const Fields& fields) {
        check_columns(fields);
        Vec3 point = Vec3::Zero();
        for (std::size_t axis = 0; axis < places_.size(); ++axis) {
            point[static_cast<Eigen::Index>(axis)] = coordinate(fields[places_[axis]]);
        }
        if (read_.points.size() == most_measured_points) {
            fail(lines_.number(),
                 fmt::format("there are more than {} points", most_measured_points),
                 "leave out points");
        }
        if (read_.points.empty() || block_ended_) {
            read_.begins.push_back(read_.points.size());
        }
        block_ended_ = false;
        read_.points.push_back(point);
        read_.lines.push_back(lines_.number());
    }

    void check_columns(const Fields& fields) {
        if (fields.size() < 3) {
            for (const std::string_view field : fields) {
                (void)coordinate(field); // a decimal comma or a word tells more
            }
            fail(lines_.number(),
                 fmt::format("this line has {}, but needs three: x, y and z",
                             counted(fields.size(), "number")));
        }
        if (columns_ == 0) {
            columns_ = fields.size();
            if (separator_ == ',' && columns_ > 3) {
                fail(
                    lines_.number(),
                    fmt::format("{} numbers are separated by commas, but only x, y and z are expected",
                                columns_),
                    "use decimal points instead of commas, or name the columns in the first line: x,y,z,...");
            }
        }
        if (fields.size() != columns_) {
            for (const std::string_view field : fields) {
                (void)coordinate(field);
            }
            fail(lines_.number(),
                 fmt::format("this line has {}, but the lines before have {}",
                             counted(fields.size(), "number"),
                             columns_));
        }
    }

    [[nodiscard]] double coordinate(std::string_view field) const {
        if (has_decimal_comma(field)) {
            fail(lines_.number(),
                 fmt::format("'{}' has a decimal comma", field.substr(0, 40)),
                 "use decimal points");
        }
        const auto number = number_from<double>(field);
        if (!number) {
            fail(lines_.number(), fmt::format("'{}' is not a number", field.substr(0, 40)));
        }
        if (!std::isfinite(*number)) {
            fail(lines_.number(), fmt::format("'{}' is not a finite number", field.substr(0, 40)));
        }
        return *number;
    }

    [[noreturn]] void fail(int line, std::string message, std::string hint = {}) const {
        throw Error(Diagnostic{
            .place = {.file = file_, .line = line}, .message = std::move(message), .hint = std::move(hint)});
    }

    const std::filesystem::path& file_;
    WordLines lines_;
    MeasuredPoints read_;
    char separator_ = ' '; ///< of the line at hand
    bool first_line_ = true;
    bool block_ended_ = false;
    std::size_t columns_ = 0;
    std::array<std::size_t, 3> places_{0, 1, 2}; ///< of x, y and z among the columns
    std::optional<int> announced_;
    int announced_line_ = 0;
};

} // namespace

bool has_common_point_name(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 3> kinds{"csv", "pts", "txt"};
    return std::ranges::find(kinds, kind_of(file)) != kinds.end();
}

bool is_measured_point_file(const std::filesystem::path& file) {
    return has_common_point_name(file) || kind_of(file) == "xyz" || kind_of(file) == "asc";
}

MeasuredPoints
parse_measured_points(std::string_view text, const std::filesystem::path& file, const Progress& progress) {
    progress.report(0.0, "reading the points");
    return PointReader(text, file).read(progress);
}

MeasuredPoints read_measured_points(const std::filesystem::path& file, const Progress& progress) {
    return parse_measured_points(read_file(file), file, progress);
}

} // namespace millwright::exchange
