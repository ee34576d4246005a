#include "core/plot/level_text.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

namespace millwright::plot {
namespace {

class LevelText {
public:
    LevelText(std::string_view text, const Level& like) : text_(text), level_(like) {}

    Level read() {
        const auto colon = text_.find(':');
        level_.pen = whole(text_.substr(0, colon), -1'000'000);
        std::string_view rest =
            colon == std::string_view::npos ? std::string_view() : text_.substr(colon + 1);
        while (colon != std::string_view::npos) {
            const auto comma = rest.find(',');
            take(rest.substr(0, comma));
            if (comma == std::string_view::npos) {
                break;
            }
            rest.remove_prefix(comma + 1);
        }
        return level_;
    }

private:
    void take(std::string_view part) {
        const auto equals = part.find('=');
        const std::string_view name = part.substr(0, equals);
        if (!seen_.insert(name).second) {
            throw Error(fmt::format("level '{}': '{}' is given twice", text_, name));
        }
        const std::string_view value =
            equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
        if (part == "off") {
            level_.enabled = false;
        } else if (name == "depth") {
            level_.depth = number(value);
        } else if (name == "passes") {
            level_.passes = whole(value, 1);
        } else if (name == "feed") {
            level_.cutting = from_mm_per_min(number(value));
        } else if (name == "plunge") {
            level_.plunging = from_mm_per_min(number(value));
        } else if (name == "order") {
            level_.order = whole(value, 1) - 1; // as the window counts
        } else if (name == "tool") {
            level_.tool = whole(value, 0);
        } else if (name == "side") {
            level_.side = side(value);
        } else if (name == "cutter") {
            level_.tool_diameter = above_zero(value);
        } else if (name == "tabs") {
            level_.tabs.count = whole(value, 0);
        } else {
            throw Error(fmt::format("level '{}': '{}' is not a setting of a level", text_, part),
                        {},
                        "use depth=, passes=, feed=, plunge=, order=, tool=, side=, cutter=, tabs= or off");
        }
    }

    [[nodiscard]] CutterSide side(std::string_view value) const {
        constexpr std::array<std::pair<std::string_view, CutterSide>, 3> sides{
            {{"on-line", CutterSide::on_line},
             {"outside", CutterSide::outside},
             {"inside", CutterSide::inside}}};
        const auto* const found =
            std::ranges::find(sides, value, &std::pair<std::string_view, CutterSide>::first);
        if (found == sides.end()) {
            throw Error(fmt::format("level '{}': '{}' is not a cutter side", text_, value),
                        {},
                        "use on-line, outside or inside");
        }
        return found->second;
    }

    [[nodiscard]] double above_zero(std::string_view value) const {
        const double found = number(value);
        if (!(found > 0.0)) {
            throw Error(fmt::format("level '{}': '{}' is not above 0", text_, value));
        }
        return found;
    }

    [[nodiscard]] double number(std::string_view value) const {
        double found = 0.0;
        const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), found);
        if (fault != std::errc() || end != value.data() + value.size() || !std::isfinite(found)) {
            throw Error(fmt::format("level '{}': '{}' is not a number", text_, value));
        }
        return found;
    }

    [[nodiscard]] int whole(std::string_view value, int least) const {
        int found = 0;
        const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), found);
        if (fault != std::errc() || end != value.data() + value.size() || found < least) {
            throw Error(
                fmt::format("level '{}': '{}' is not a whole number of at least {}", text_, value, least));
        }
        return found;
    }

    std::string_view text_;
    std::set<std::string_view> seen_; ///< names that were given
    Level level_;
};

} // namespace

Level parse_level(std::string_view text, const Level& like) {
    return LevelText(text, like).read();
}

} // namespace millwright::plot
