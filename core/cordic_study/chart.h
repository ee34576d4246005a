// Charts of numbers as SVG pictures, for reports.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::cordic {

enum class Mark : std::uint8_t { line, dots };

struct Series {
    std::string label{};
    std::vector<double> x{}; ///< finite
    std::vector<double> y{}; ///< as many
    Mark mark = Mark::line;
};

struct Chart {
    std::string title{};
    std::string x_label{};
    std::string y_label{};
    std::vector<Series> series{};
    bool logarithmic = false; ///< y by powers of ten; values of 0 and less are left out
    bool same_scale = false;  ///< a length is as long along x as along y, for paths
};

/// The chart as an SVG document. Throws Defect if a number is not finite.
[[nodiscard]] std::string to_svg(const Chart& chart);

/// A value at each point of a grid, coloured by powers of ten.
struct HeatMap {
    std::string title{};
    std::string x_label{};
    std::string y_label{};
    std::string value_label{};
    std::vector<double> x{};      ///< of the columns, rising
    std::vector<double> y{};      ///< of the rows, rising
    std::vector<double> values{}; ///< row by row, from the lowest y
};

[[nodiscard]] std::string to_svg(const HeatMap& map);

} // namespace millwright::cordic
