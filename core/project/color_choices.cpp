#include "core/project/color_choices.h"

#include "core/project/internal/pair_file.h"

namespace millwright::project {

namespace {

constexpr PairNames names_of_colors{"layer", "color"};

} // namespace

ColorChoices read_colors(const std::filesystem::path& file) {
    return read_pairs(file, names_of_colors);
}

void write_colors(const ColorChoices& colors, const std::filesystem::path& file) {
    write_pairs(colors, file, names_of_colors);
}

} // namespace millwright::project
