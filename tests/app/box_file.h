// Boxes as STL files. Lengths mm.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>

namespace millwright::test {

/// A box as an STL file.
inline std::filesystem::path box_file(const std::filesystem::path& file,
                                      const std::array<double, 3>& low,
                                      const std::array<double, 3>& high) {
    constexpr std::array<std::array<unsigned, 3>, 12> triangles{{{0, 2, 3},
                                                                 {0, 3, 1},
                                                                 {4, 5, 7},
                                                                 {4, 7, 6},
                                                                 {0, 1, 5},
                                                                 {0, 5, 4},
                                                                 {2, 6, 7},
                                                                 {2, 7, 3},
                                                                 {0, 4, 6},
                                                                 {0, 6, 2},
                                                                 {1, 3, 7},
                                                                 {1, 7, 5}}};
    std::ofstream out(file);
    out << "solid box\n";
    for (const auto& triangle : triangles) {
        out << "facet normal 0 0 0\nouter loop\n";
        for (const unsigned corner : triangle) {
            out << "vertex";
            for (std::size_t axis = 0; axis < 3; ++axis) {
                out << ' ' << ((corner >> axis & 1U) != 0 ? high : low)[axis];
            }
            out << '\n';
        }
        out << "endloop\nendfacet\n";
    }
    out << "endsolid box\n";
    return file;
}

} // namespace millwright::test
