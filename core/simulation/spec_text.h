// Stock and tools as a person writes them on the command line. Lengths mm, angles degrees.
//     box:LX,LY,LZ[@X,Y,Z]              from its lowest corner; without @ its top is Z 0, its corner X 0, Y 0
//     cylinder:D,L[,x|y|z][@X,Y,Z]      from the middle of its lower end; without @ along Z under Z 0
//     tube:D,BORE,L[,x|y|z][@X,Y,Z]
//     FILE.stl|.obj|.ply[@X,Y,Z]        a closed mesh, moved by X,Y,Z
//
//     flat:D  ball:D  bull:D:R  v:ANGLE:D[:TIP|:rR]  drill:D[:ANGLE]   each with :lLENGTH; or a tool file
#pragma once

#include "core/simulation/stock.h"
#include "core/toolpath/profile.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace millwright::simulation {

struct StockText {
    std::optional<Stock> stock;      ///< nullopt: it is a mesh, which is still to be read
    std::filesystem::path mesh_file; ///< empty if it is no mesh
    Vec3 shift = Vec3::Zero();       ///< of the mesh
};

/// Throws Error, with the column and what can be written, for anything else.
[[nodiscard]] StockText parse_stock(std::string_view text);

struct ToolText {
    std::optional<int> number;             ///< of T, where the text begins with N=
    std::optional<toolpath::Profile> body; ///< nullopt: it is a file, which is still to be read
    std::filesystem::path file;            ///< of a tool; empty if it is no file
};

/// Throws Error as parse_stock(). Without a length a tool is as long as five diameters, 50 mm at least.
[[nodiscard]] ToolText parse_tool(std::string_view text);

} // namespace millwright::simulation
