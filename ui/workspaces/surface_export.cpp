#include "ui/workspaces/surface_export.h"

#include "core/exchange/surface_file.h"

#include <utility>

namespace millwright::actions {

namespace {

WrittenSurface written(const SurfaceToWrite& what, const Progress& progress) {
    constexpr double tolerance_mm = 0.01;
    try {
        exchange::write_surface(*what.surface, what.file, tolerance_mm, progress);
    } catch (const Error& error) {
        return {what.file, {}, error.diagnostic()};
    }
    return {what.file, what.left_out, std::nullopt};
}

} // namespace

SurfaceExport::SurfaceExport(std::function<void()> wake)
    : work_([](const SurfaceToWrite& what, const Progress& progress) { return written(what, progress); },
            std::move(wake)) {}

std::shared_ptr<const WrittenSurface> SurfaceExport::take_news() {
    auto now = work_.answer();
    if (now == told_) {
        return nullptr;
    }
    told_ = now;
    return now;
}

} // namespace millwright::actions
