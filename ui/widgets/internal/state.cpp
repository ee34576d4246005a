#include "ui/widgets/internal/state.h"

#include <algorithm>

namespace millwright::widgets {

namespace {

constexpr std::size_t longest_typed = 16; // bytes that keys give within one slow frame

bool inside_letter(std::string_view text, std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
}

bool is_blank_or_newline(char c) {
    return c == ' ' || c == '\t' || c == '\n';
}

} // namespace

TextDifference difference(std::string_view before, std::string_view after) {
    const std::size_t shorter = std::min(before.size(), after.size());
    std::size_t at = 0;
    while (at < shorter && before[at] == after[at]) {
        ++at;
    }
    while (at > 0 && (inside_letter(before, at) || inside_letter(after, at))) {
        --at;
    }
    std::size_t same = 0; // at the end
    while (same < shorter - at && before[before.size() - 1 - same] == after[after.size() - 1 - same]) {
        ++same;
    }
    while (same > 0 &&
           (inside_letter(before, before.size() - same) || inside_letter(after, after.size() - same))) {
        --same;
    }
    return {at, before.size() - same - at, after.size() - same - at};
}

TextSteps::Kind TextSteps::kind_of(std::string_view before, std::string_view after) {
    const TextDifference what = difference(before, after);
    const std::string_view inserted = after.substr(what.at, what.inserted);
    if (what.inserted == 0 && what.removed <= longest_typed) {
        return Kind::erased;
    }
    const bool typed = what.removed == 0 && what.inserted <= longest_typed;
    return typed && inserted.find('\n') == std::string_view::npos ? Kind::typed : Kind::piece;
}

bool TextSteps::begins(std::string_view before, std::string_view after, int caret_before, int caret_after) {
    const Kind last = kind_;
    const bool moved = caret_before != caret_;
    kind_ = kind_of(before, after);
    caret_ = caret_after;
    if (kind_ != last || kind_ == Kind::piece || moved) {
        return true;
    }
    const auto first =
        static_cast<std::size_t>(std::clamp<long>(caret_before, 0, static_cast<long>(after.size())));
    return kind_ == Kind::typed && first > 0 && first < after.size() &&
           is_blank_or_newline(after[first - 1]) && !is_blank_or_newline(after[first]);
}

} // namespace millwright::widgets
