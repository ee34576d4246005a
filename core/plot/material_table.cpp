#include "core/plot/material_table.h"

#include "core/base/error.h"
#include "core/base/json.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace millwright::plot {

namespace {

constexpr double mm_per_inch = 25.4;
constexpr double minute = 60.0;
constexpr double edges = 2.0;
constexpr double plunge_part = 1.0 / 3.0; // of the feed

} // namespace

CuttingValues Material::values(double tool_diameter) const {
    if (!(tool_diameter > 0.0)) {
        throw Error(fmt::format("a tool diameter of {} mm cannot cut", tool_diameter));
    }
    CuttingValues values = given_;
    if (chip_loads_.empty()) {
        return values;
    }
    const auto above = std::ranges::lower_bound(chip_loads_, tool_diameter, {}, &ChipLoad::diameter);
    double load = chip_loads_.back().load;
    if (above != chip_loads_.end()) {
        const ChipLoad below = above == chip_loads_.begin() ? ChipLoad{} : *(above - 1);
        const double part = (tool_diameter - below.diameter) / (above->diameter - below.diameter);
        load = below.load + part * (above->load - below.load);
    }
    values.feed.value = edges * load * values.spindle_rpm.value / minute;
    values.plunge.value = plunge_part * values.feed.value;
    values.depth_per_pass.value = depth_part_ * tool_diameter;
    return values;
}

class MaterialReader {
public:
    explicit MaterialReader(const JsonValue& root) : root_(root) {
        root.expect_only(
            {"format", "version", "spindle_rpm", "diameters_in", "sources", "materials", "fixed"});
        if (root.at("format").text() != "millwright-materials") {
            root.at("format").fail("this is not a materials table");
        }
        (void)root.at("version").integer(1, 1);
        const JsonValue sources = root.at("sources");
        sources.expect_only({"chip_load", "depth", "plunge", "spindle"});
        usual_.feed.source = sources.at("chip_load").text();
        usual_.plunge.source = sources.at("plunge").text();
        usual_.depth_per_pass.source = sources.at("depth").text();
        constexpr double fastest = 1e5;
        usual_.spindle_rpm = {root.at("spindle_rpm").number(1.0, fastest), sources.at("spindle").text()};
    }

    [[nodiscard]] std::vector<Material> read() const {
        std::vector<Material> found;
        for (const JsonValue& value : root_.at("materials").items()) {
            found.push_back(charted(value));
        }
        for (const JsonValue& value : root_.at("fixed").items()) {
            found.push_back(fixed(value));
        }
        return found;
    }

private:
    const JsonValue& root_;
    CuttingValues usual_;

    [[nodiscard]] Material named(const JsonValue& value) const {
        Material material;
        material.name_ = value.at("name").text();
        material.kind_ = value.at("kind").text();
        constexpr std::array<std::string_view, 4> kinds{"wood", "plastic", "metal", "rubber"};
        if (std::ranges::find(kinds, material.kind_) == kinds.end()) {
            value.at("kind").fail("must be wood, plastic, metal or rubber");
        }
        material.given_ = usual_;
        return material;
    }

    [[nodiscard]] Material charted(const JsonValue& value) const {
        value.expect_only({"name", "kind", "chip_load_in", "chip_load_source", "depth"});
        Material material = named(value);
        if (const auto source = value.find("chip_load_source")) {
            material.given_.feed.source = source->text();
        }
        if (const auto depth = value.find("depth")) {
            const Sourced part = sourced(*depth, 1.0);
            material.depth_part_ = part.value;
            material.given_.depth_per_pass.source = part.source;
        }
        const auto diameters = root_.at("diameters_in").items();
        const auto loads = value.at("chip_load_in").items(diameters.size());
        double last = 0.0;
        for (std::size_t n = 0; n < loads.size(); ++n) {
            const double diameter = diameters[n].number(0.0, 10.0) * mm_per_inch;
            if (!(diameter > last)) {
                diameters[n].fail("the diameters must increase");
            }
            last = diameter;
            material.chip_loads_.push_back({diameter, loads[n].number(1e-6, 1.0) * mm_per_inch});
        }
        return material;
    }

    static Sourced sourced(const JsonValue& value, double unit) {
        const auto pair = value.items(2);
        return {pair[0].number(1e-6, 1e6) * unit, pair[1].text()};
    }

    [[nodiscard]] Material fixed(const JsonValue& value) const {
        value.expect_only({"name", "kind", "feed_mm_per_min", "plunge_mm_per_min", "depth_per_pass_mm"});
        Material material = named(value);
        material.given_.feed = sourced(value.at("feed_mm_per_min"), from_mm_per_min(1.0));
        material.given_.plunge = sourced(value.at("plunge_mm_per_min"), from_mm_per_min(1.0));
        material.given_.depth_per_pass = sourced(value.at("depth_per_pass_mm"), 1.0);
        return material;
    }
};

std::vector<Material> read_materials(std::string_view text, const std::filesystem::path& file) {
    const JsonValue root = JsonValue::parse(text, file);
    return MaterialReader(root).read();
}

} // namespace millwright::plot
