#include "ui/actions/shortcut.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace millwright::actions {

namespace {

using render::Key;

constexpr std::array<std::pair<std::string_view, Key>, 24> named_keys{{
    {"Space", Key::space}, {"Esc", Key::escape}, {"Enter", Key::enter}, {"Tab", Key::tab},
    {"Del", Key::del},     {"Left", Key::left},  {"Right", Key::right}, {"Up", Key::up},
    {"Down", Key::down},   {"Home", Key::home},  {"End", Key::end},     {".", Key::period},
    {"F1", Key::f1},       {"F2", Key::f2},      {"F3", Key::f3},       {"F4", Key::f4},
    {"F5", Key::f5},       {"F6", Key::f6},      {"F7", Key::f7},       {"F8", Key::f8},
    {"F9", Key::f9},       {"F10", Key::f10},    {"F11", Key::f11},     {"F12", Key::f12},
}};

Key key_named(std::string_view name) {
    if (name.size() == 1 && name[0] >= 'A' && name[0] <= 'Z') {
        return static_cast<Key>(static_cast<int>(Key::a) + name[0] - 'A');
    }
    if (name.size() == 1 && name[0] >= '0' && name[0] <= '9') {
        return static_cast<Key>(static_cast<int>(Key::digit_0) + name[0] - '0');
    }
    const auto* found = std::find_if(
        named_keys.begin(), named_keys.end(), [name](const auto& entry) { return entry.first == name; });
    expects(found != named_keys.end(), fmt::format("'{}' is a key", name));
    return found->second;
}

bool take(std::string_view& text, std::string_view prefix) {
    const bool starts = text.substr(0, prefix.size()) == prefix && text.size() > prefix.size();
    text.remove_prefix(starts ? prefix.size() : 0);
    return starts;
}

} // namespace

Shortcut shortcut(std::string_view text) {
    Shortcut result;
    result.ctrl = take(text, "Ctrl+");
    result.shift = take(text, "Shift+");
    result.alt = take(text, "Alt+");
    result.key = key_named(text);
    return result;
}

} // namespace millwright::actions
