// Letters compared without regard to case. ASCII only: the same in every locale.
#pragma once

namespace millwright::widgets {

[[nodiscard]] constexpr char lower_case(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

[[nodiscard]] constexpr bool same_letter(char a, char b) {
    return lower_case(a) == lower_case(b);
}

} // namespace millwright::widgets
