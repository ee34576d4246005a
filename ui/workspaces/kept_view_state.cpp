#include "ui/workspaces/kept_view_state.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <functional>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

namespace millwright::actions {

namespace {

using project::WindowSettings;

/// One value: how it is written, and how it is read. False if the text cannot be right.
struct KeptValue {
    std::string name;
    std::function<std::string(const ViewState&)> text;
    std::function<bool(ViewState&, const std::string&)> take;
};

std::optional<double> number_of(std::string_view text, double least, double most) {
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = failure == std::errc{} && end == text.data() + text.size();
    return whole && lies_between(value, least, most) ? std::optional(value) : std::nullopt;
}

std::optional<bool> flag_of(std::string_view text) {
    return text == "on" ? std::optional(true) : text == "off" ? std::optional(false) : std::nullopt;
}

std::string flag_text(bool on) {
    return on ? "on" : "off";
}

/// Found by `member`, which gives a reference into a view state that is const or not.
template <typename Member>
KeptValue kept_number(std::string name, double least, double most, const Member& member) {
    return {
        std::move(name),
        [member](const ViewState& view_state) { return shortest(static_cast<double>(member(view_state))); },
        [member, least, most](ViewState& view_state, const std::string& text) {
            const auto value = number_of(text, least, most);
            if (value) {
                auto& kept = member(view_state);
                kept = static_cast<std::remove_reference_t<decltype(kept)>>(*value);
            }
            return value.has_value();
        }};
}

template <typename Member> KeptValue kept_flag(std::string name, const Member& member) {
    return {std::move(name),
            [member](const ViewState& view_state) { return flag_text(member(view_state)); },
            [member](ViewState& view_state, const std::string& text) {
                const auto on = flag_of(text);
                if (on) {
                    member(view_state) = *on;
                }
                return on.has_value();
            }};
}

template <typename Member> KeptValue kept_text(std::string name, const Member& member) {
    return {std::move(name),
            [member](const ViewState& view_state) { return std::string(member(view_state)); },
            [member](ViewState& view_state, const std::string& text) {
                member(view_state) = text;
                return true;
            }};
}

constexpr std::array<std::pair<std::string_view, float PaneSizes::*>, 10> pane_sizes{
    {{"outline", &PaneSizes::outline},
     {"inspector", &PaneSizes::inspector},
     {"lower", &PaneSizes::lower},
     {"processor", &PaneSizes::processor},
     {"code", &PaneSizes::code},
     {"layers", &PaneSizes::layers},
     {"bench", &PaneSizes::plot_lower},
     {"arm_jog", &PaneSizes::arm_jog},
     {"arm_lower", &PaneSizes::arm_lower},
     {"listing", &PaneSizes::listing}}};

constexpr std::array<std::pair<std::string_view, bool PaneSizes::*>, 3> panes_shown{
    {{"outline_shown", &PaneSizes::outline_shown},
     {"inspector_shown", &PaneSizes::inspector_shown},
     {"lower_shown", &PaneSizes::lower_shown}}};

void add_panes(std::vector<KeptValue>& values) {
    constexpr double smallest = 60.0, largest = 4000.0; // px at scale 1
    for (const auto& [name, size] : pane_sizes) {
        values.push_back(kept_number(
            fmt::format("panes.{}", name), smallest, largest, [size = size](auto& view_state) -> auto& {
                return view_state.panes.*size;
            }));
    }
    for (const auto& [name, shown] : panes_shown) {
        values.push_back(kept_flag(
            fmt::format("panes.{}", name), [shown = shown](auto& view_state) -> auto& {
                return view_state.panes.*shown;
            }));
    }
}

void add_window(std::vector<KeptValue>& values) {
    constexpr double least = 100.0, most = 32768.0; // px at scale 1
    values.push_back(kept_number(
        "window.width", least, most, [](auto& view_state) -> auto& { return view_state.window.size.width; }));
    values.push_back(kept_number(
        "window.height", least, most, [](auto& view_state) -> auto& {
            return view_state.window.size.height;
        }));
    values.push_back(kept_flag(
        "window.maximized", [](auto& view_state) -> auto& { return view_state.window.maximized; }));
    values.push_back({"theme",
                      [](const ViewState& view_state) {
                          return std::string(view_state.theme == widgets::Theme::dark ? "dark" : "light");
                      },
                      [](ViewState& view_state, const std::string& text) {
                          view_state.theme = text == "light" ? widgets::Theme::light : widgets::Theme::dark;
                          return text == "light" || text == "dark";
                      }});
}

KeptValue kept_address(std::string_view driver) {
    return {fmt::format("address.{}", driver),
            [driver](const ViewState& view_state) { return address_for(view_state.manual, driver); },
            [driver](ViewState& view_state, const std::string& text) {
                view_state.manual.addresses[std::string(driver)] = text;
                if (view_state.manual.choice.driver == driver) {
                    view_state.manual.choice.address = text;
                }
                return true;
            }};
}

/// A text of a person's own records; where there are none (record.own), it has nowhere to go.
KeptValue kept_record(std::string_view name, std::string drivers::RecordFormat::*member) {
    return {fmt::format("record.{}", name),
            [member](const ViewState& view_state) {
                return view_state.manual.choice.record.value_or(drivers::RecordFormat()).*member;
            },
            [member](ViewState& view_state, const std::string& text) {
                if (auto& record = view_state.manual.choice.record) {
                    (*record).*member = text;
                }
                return true;
            }};
}

void add_records(std::vector<KeptValue>& values) {
    using drivers::RecordFormat;
    values.push_back(
        {"record.own",
         [](const ViewState& view_state) { return flag_text(view_state.manual.choice.record.has_value()); },
         [](ViewState& view_state, const std::string& text) {
             view_state.manual.choice.record =
                 flag_of(text).value_or(false) ? std::optional(RecordFormat()) : std::nullopt;
             return flag_of(text).has_value();
         }});
    values.push_back(kept_record("pattern", &RecordFormat::pattern));
    values.push_back(kept_record("ending", &RecordFormat::ending));
    values.push_back(kept_record("answer", &RecordFormat::answer));
    values.push_back({"record.relative",
                      [](const ViewState& view_state) {
                          return flag_text(view_state.manual.choice.record.value_or(RecordFormat()).relative);
                      },
                      [](ViewState& view_state, const std::string& text) {
                          if (auto& record = view_state.manual.choice.record) {
                              record->relative = flag_of(text).value_or(record->relative);
                          }
                          return flag_of(text).has_value();
                      }});
}

void add_machine(std::vector<KeptValue>& values) {
    values.push_back({"driver",
                      [](const ViewState& view_state) { return view_state.manual.choice.driver; },
                      [](ViewState& view_state, const std::string& text) {
                          try {
                              view_state.manual.choice.driver = machine::driver_row(text).name;
                              return true;
                          } catch (const Error&) {
                              return false;
                          }
                      }});
    for (const machine::DriverRow& row : machine::driver_rows()) {
        values.push_back(kept_address(row.name));
    }
    values.push_back(kept_text(
        "machine.axes", [](auto& view_state) -> auto& { return view_state.manual.choice.axes; }));
    values.push_back(kept_flag(
        "machine.one_by_one", [](auto& view_state) -> auto& { return view_state.manual.choice.one_by_one; }));
    values.push_back(kept_number(
        "machine.period", 1e-4, 10.0, [](auto& view_state) -> auto& {
            return view_state.manual.choice.period;
        }));
}

void add_hand(std::vector<KeptValue>& values) {
    constexpr double most = 1e6;
    values.push_back(kept_number(
        "jog.step", 0.0, most, [](auto& view_state) -> auto& { return view_state.manual.step; }));
    values.push_back(kept_number(
        "jog.speed", 0.0, most, [](auto& view_state) -> auto& {
            return view_state.manual.speed_mm_per_min;
        }));
    values.push_back(kept_number(
        "jog.rotary_speed", 0.0, most, [](auto& view_state) -> auto& {
            return view_state.manual.turn_deg_per_min;
        }));
    values.push_back(kept_number(
        "probe.travel", 0.0, most, [](auto& view_state) -> auto& { return view_state.manual.probe_way_mm; }));
    values.push_back(kept_number(
        "probe.speed", 0.0, most, [](auto& view_state) -> auto& {
            return view_state.manual.probe_mm_per_min;
        }));
}

/// The driver before its address, which is that of the chosen one.
std::vector<KeptValue> kept_values() {
    std::vector<KeptValue> values;
    add_window(values);
    add_panes(values);
    add_machine(values);
    add_records(values);
    add_hand(values);
    return values;
}

constexpr std::string_view folder_prefix = "folder.";
constexpr std::string_view tool_change_prefix = "tool_change.";

} // namespace

WindowSettings kept_of(const ViewState& view_state, WindowSettings before) {
    for (const KeptValue& value : kept_values()) {
        before[value.name] = value.text(view_state);
    }
    for (const auto& [use, folder] : view_state.folders) {
        before[std::string(folder_prefix) + use] = folder.string();
    }
    for (const auto& [address, settings] : view_state.manual.tool_changes) {
        before[std::string(tool_change_prefix) + address] = to_text(settings);
    }
    return before;
}

std::vector<std::string> restore(ViewState& view_state, const WindowSettings& kept) {
    std::vector<std::string> refused;
    for (const KeptValue& value : kept_values()) {
        const auto found = kept.find(value.name);
        if (found != kept.end() && !value.take(view_state, found->second)) {
            refused.push_back(
                fmt::format("{} cannot be \u201c{}\u201d", value.name, printable(found->second)));
        }
    }
    for (const auto& [name, folder] : kept) {
        if (name.starts_with(folder_prefix)) {
            view_state.folders[name.substr(folder_prefix.size())] = folder;
        } else if (name.starts_with(tool_change_prefix)) {
            const auto settings = tool_changes_of(folder);
            if (settings) {
                view_state.manual.tool_changes[name.substr(tool_change_prefix.size())] = *settings;
            } else {
                refused.push_back(fmt::format("{} cannot be \u201c{}\u201d", name, printable(folder)));
            }
        }
    }
    return refused;
}

} // namespace millwright::actions
