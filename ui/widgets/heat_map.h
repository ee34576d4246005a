// A quantity over two others as a rectangle of colours: the cost of a set-up over where the part stands.
#pragma once

#include "ui/widgets/legend.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace millwright::widgets {

struct MapPlace {
    double x = 0.0;
    double y = 0.0;
};

/// Two opposite corners.
struct MapFrame {
    MapPlace a{};
    MapPlace b{};
};

struct HeatMapView {
    std::string_view title = {};
    std::string_view x_label = {};
    std::string_view x_unit = {};
    std::string_view y_label = {};
    std::string_view y_unit = {};
    std::string_view unit = {};          ///< of the values
    std::span<const double> x = {};      ///< ascending, one per column
    std::span<const double> y = {};      ///< ascending, one per row
    std::span<const double> values = {}; ///< row by row; one that is not finite is hatched
    ColourMap colours = {};              ///< of the least value at 0, of the greatest at 1
    std::optional<MapPlace> chosen = {}; ///< a ring
    std::optional<MapPlace> best = {};   ///< a cross
    std::optional<MapFrame> frame = {};  ///< a rectangle, recorded as `frame` under the map's id
    /// What stands at the mouse, of the nearest value; empty: its place and itself.
    std::function<std::string(std::size_t column, std::size_t row)> readout = {};
    bool same_scale = false; ///< x and y have one unit and are as long: the map is as wide as that makes it
    float height = 0.0F;     ///< 0: all that is left, at least 80 px at scale 1
    std::string_view when_empty = "No data yet.";
};

/// The place that was just clicked, on the map. The mouse over it reads out the nearest value. Throws Defect
/// unless there are as many values as columns times rows.
std::optional<MapPlace> heat_map(Ui& ui, std::string_view id, const HeatMapView& view);

} // namespace millwright::widgets
