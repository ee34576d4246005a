#include "core/hpgl/internal/line_end_evidence.h"

#include <algorithm>

namespace millwright::hpgl::internal {

namespace {

constexpr std::string_view line_end_bytes = "\r\n";

bool is_of_a_number(char c) {
    return (c >= '0' && c <= '9') || c == '.';
}

bool is_sign(char c) {
    return c == '+' || c == '-';
}

bool separates(char c) {
    return c == ',' || c == ' ' || c == '\t';
}

/// Behind the line end, or the line ends, that begin at `from`.
std::size_t behind_line_end(std::string_view bytes, std::size_t from) {
    return std::min(bytes.find_first_not_of(line_end_bytes, from), bytes.size());
}

std::size_t longest_line_of(std::string_view bytes) {
    std::size_t longest = 0;
    for (std::size_t from = 0; from < bytes.size();) {
        const std::size_t end = std::min(bytes.find_first_of(line_end_bytes, from), bytes.size());
        longest = std::max(longest, end - from);
        from = end + 1;
    }
    return longest;
}

/// With the line ends as separators; those of pairs alone are asked for.
std::size_t numbers_before(std::string_view text) {
    std::size_t count = 0;
    bool inside = false;
    for (const char c : text) {
        const bool belongs = is_of_a_number(c);
        count += belongs && !inside ? 1 : 0;
        inside = belongs;
    }
    return count;
}

} // namespace

bool has_line_end_in_digits(std::string_view bytes) {
    for (std::size_t at = 1; at < bytes.size(); ++at) {
        const bool after_number = is_of_a_number(bytes[at - 1]) || is_sign(bytes[at - 1]);
        if ((bytes[at] == '\n' || bytes[at] == '\r') && after_number) {
            const std::size_t behind = behind_line_end(bytes, at);
            if (behind < bytes.size() && is_of_a_number(bytes[behind])) {
                return true;
            }
        }
    }
    return false;
}

LineEndEvidence::LineEndEvidence(std::string_view bytes)
    : bytes_(bytes), longest_line_(longest_line_of(bytes)), shortest_open_line_(longest_line_) {}

void LineEndEvidence::look_at(const Command& command, const Count& count) {
    const std::string_view text = command.arguments;
    const auto offset = static_cast<std::size_t>(command.arguments_byte);
    const bool pairs = count.least % 2 == 0 && (count.step == 2 || count.most == count.least);
    const std::int64_t before = open_;
    std::size_t counted_to = 0;
    std::size_t numbers = 0;
    for (std::size_t at = text.find_first_of(line_end_bytes); at < text.size();
         at = text.find_first_of(line_end_bytes, behind_line_end(text, at))) {
        const std::size_t behind = behind_line_end(text, at);
        if (at == 0 || behind == text.size()) {
            continue;
        }
        numbers += numbers_before(text.substr(counted_to, at - counted_to));
        counted_to = at;
        const bool after_sign = is_sign(text[at - 1]);
        if ((after_sign || is_of_a_number(text[at - 1])) && is_of_a_number(text[behind])) {
            look_at_end(offset + at, pairs && !after_sign && numbers % 2 == 1);
            after_signs_ += after_sign ? 1 : 0;
        } else if (separates(text[at - 1]) || separates(text[behind])) {
            ++beside_separator_;
        }
    }
    if (open_ == before) {
        return;
    }
    const std::size_t most = text.size() + 1;
    const auto misfits = [&](bool join) {
        const bool read = !read_numbers(command, join, most, numbers_);
        return read && count.allows(numbers_.size()) ? 0 : 1;
    };
    separate_misfits_ += misfits(false);
    join_misfits_ += misfits(true);
}

void LineEndEvidence::look_at_end(std::size_t at, bool within_pair) {
    first_ = open_ == 0 ? static_cast<std::int64_t>(at) : first_;
    ++open_;
    in_pairs_ += within_pair ? 1 : 0;
    const std::size_t line = bytes_.find_last_of(line_end_bytes, at - 1);
    const std::size_t begin = line == std::string_view::npos ? 0 : line + 1;
    shortest_open_line_ = std::min(shortest_open_line_, at - begin);
}

/// A program that wraps does so where a line is full.
bool LineEndEvidence::of_one_width() const {
    return shortest_open_line_ + 1 >= longest_line_;
}

std::optional<LineEnds> LineEndEvidence::meaning() const {
    constexpr std::size_t narrowest_wrap = 60;
    constexpr std::int64_t many = 8; // so often a wrap falls between two pairs once in 256 files
    const bool looks_wrapped = of_one_width() && (beside_separator_ > 0 || in_pairs_ > 0);
    const bool looks_separated = in_pairs_ == 0 && beside_separator_ == 0;
    const bool may_be_chance = of_one_width() && longest_line_ >= narrowest_wrap && open_ < many;
    if (separate_misfits_ == 0 && join_misfits_ > 0) {
        const bool doubtful = looks_wrapped && longest_line_ >= narrowest_wrap;
        return doubtful ? std::nullopt : std::optional(LineEnds::separate);
    }
    if (join_misfits_ == 0 && separate_misfits_ > 0) {
        return looks_separated && after_signs_ == 0 && !of_one_width() ? std::nullopt
                                                                       : std::optional(LineEnds::join);
    }
    if (looks_wrapped != looks_separated) {
        return looks_wrapped   ? std::optional(LineEnds::join)
               : may_be_chance ? std::nullopt
                               : std::optional(LineEnds::separate);
    }
    // Damaged, or nothing to go by: what fewer commands speak against, if there is such.
    if (separate_misfits_ != join_misfits_) {
        return separate_misfits_ < join_misfits_ ? LineEnds::separate : LineEnds::join;
    }
    return std::nullopt;
}

} // namespace millwright::hpgl::internal
