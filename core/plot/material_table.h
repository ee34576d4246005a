// What woods and plastics are cut with: feed, plunge, depth per pass, spindle, each with its source. Lengths
// mm, speeds mm/s.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::plot {

/// A number, and who says so.
struct Sourced {
    double value = 0.0;
    std::string source;

    friend bool operator==(const Sourced&, const Sourced&) = default;
};

struct CuttingValues {
    Sourced feed;
    Sourced plunge;
    Sourced depth_per_pass;
    Sourced spindle_rpm;
};

class Material {
public:
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::string& kind() const { return kind_; } ///< "wood", "plastic", "metal", "rubber"

    /// For an end mill of two edges: the feed is edges x turns x chip load. The chip load of a diameter
    /// between those of the chart is taken straight between them, of a thinner tool in proportion, of a
    /// thicker one as of the thickest. Throws Error for a diameter that is not above 0.
    [[nodiscard]] CuttingValues values(double tool_diameter) const;

private:
    friend class MaterialReader;

    struct ChipLoad {
        double diameter = 0.0;
        double load = 0.0;
    };

    std::string name_, kind_;
    std::vector<ChipLoad> chip_loads_; ///< by ascending diameter; empty: the values are fixed
    double depth_part_ = 0.5;          ///< of the tool's diameter, in one pass
    CuttingValues given_;              ///< with every source; feed, plunge and depth where they are fixed
};

/// Throws Error with file and line for what is no table of materials.
[[nodiscard]] std::vector<Material> read_materials(std::string_view text, const std::filesystem::path& file);

} // namespace millwright::plot
