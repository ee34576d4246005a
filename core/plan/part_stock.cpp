#include "core/plan/part_stock.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/exchange/mesh_file.h"
#include "core/geometry/mesh.h"
#include "core/simulation/spec_text.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

namespace millwright::plan {

namespace {

std::shared_ptr<const simulation::MeshStock>
mesh_from(const std::filesystem::path& file, const Vec3& shift, const Progress& progress) {
    exchange::MeshFile read = exchange::read_mesh(file, 1.0, progress);
    auto mesh = std::make_shared<simulation::MeshStock>();
    mesh->points = std::move(read.mesh.points);
    mesh->triangles = std::move(read.mesh.triangles);
    for (Vec3& point : mesh->points) {
        point += shift;
    }
    if (const std::string fault = simulation::fault_of(simulation::Stock(mesh)); !fault.empty()) {
        throw Error(fault, file, "repair it in the program that it comes from");
    }
    mesh->is_checked = true;
    return mesh;
}

} // namespace

NamedStock stock_around(const geometry::Surface& surface, double allowance) {
    Box3 box;
    constexpr int steps = 60;
    for (const geometry::ParametricSurface* part : surface.parts()) {
        for (const Vec3& point : geometry::tessellate(*part, steps, steps).positions) {
            box.extend(point);
        }
    }
    const Vec3 more = Vec3::Constant(allowance);
    const simulation::Stock stock = simulation::BoxStock{box.min() - more, box.max() + more};
    return {stock,
            fmt::format("{}: the box of the surface and {:g} mm on every side",
                        simulation::to_text(stock),
                        allowance)};
}

std::string stock_text(const project::StockInput& input) {
    const Vec3& at = input.position;
    return input.file.empty() ? input.shape
                              : fmt::format("{}@{},{},{}",
                                            input.file.string(),
                                            shortest(at.x()),
                                            shortest(at.y()),
                                            shortest(at.z()));
}

project::StockInput with_stock(project::StockInput input, std::string_view text) {
    const simulation::StockText parsed = simulation::parse_stock(text);
    input.around_part = false;
    input.file = parsed.mesh_file;
    input.position = parsed.shift;
    if (parsed.stock) {
        input.shape = text;
    }
    return input;
}

std::string with_whole_path(std::string_view text, const std::filesystem::path& folder) {
    const simulation::StockText parsed = simulation::parse_stock(text);
    if (parsed.stock) {
        return std::string(text);
    }
    const std::string written = parsed.mesh_file.string();
    if (parsed.mesh_file.is_relative() && folder.empty()) {
        throw Error("the project is not saved, so its folder is not known",
                    written,
                    "save it first, or write the whole path of the file");
    }
    const auto whole = std::filesystem::absolute(folder / parsed.mesh_file).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(whole, ignored)) {
        throw Error(fmt::format("there is no file {}", printable(whole.string())),
                    {},
                    "write its path from the project's folder, or the whole path");
    }
    std::string changed(text);
    return changed.replace(changed.find(written), written.size(), whole.string());
}

NamedStock stock_from(std::string_view text, const Progress& progress) {
    const simulation::StockText parsed = simulation::parse_stock(text);
    if (parsed.stock) {
        return {*parsed.stock, simulation::to_text(*parsed.stock)};
    }
    const simulation::Stock stock = mesh_from(parsed.mesh_file, parsed.shift, progress);
    return {
        stock,
        fmt::format("{} of {}", simulation::to_text(stock), printable(parsed.mesh_file.filename().string()))};
}

} // namespace millwright::plan
