// Writes the design for another program in the background: fine triangles and many patches take their time.
#pragma once

#include "core/geometry/surface.h"
#include "ui/workspaces/latest_work.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace millwright::actions {

struct SurfaceToWrite {
    std::shared_ptr<const geometry::Surface> surface;
    std::filesystem::path file;
    std::string left_out = {}; ///< what of the design the file does not have, for people
};

struct WrittenSurface {
    std::filesystem::path file;
    std::string left_out;
    std::optional<Diagnostic> failure;
};

class SurfaceExport {
public:
    explicit SurfaceExport(std::function<void()> wake);

    /// By the end of the file's name (exchange/surface_file.h), triangles within 0.01 mm.
    void write(const SurfaceToWrite& what) { work_.want(what); }
    /// Gives up what is being written: the file stays as it was.
    void cancel() { work_.forget(); }
    [[nodiscard]] bool busy() const { return work_.busy(); }
    [[nodiscard]] Progress::Report progress() const { return work_.report(); }
    /// What has been written since it was last asked; null: nothing.
    [[nodiscard]] std::shared_ptr<const WrittenSurface> take_news();
    void wait_idle() const { work_.wait_idle(); }

private:
    LatestWork<SurfaceToWrite, WrittenSurface> work_;
    std::shared_ptr<const WrittenSurface> told_;
};

} // namespace millwright::actions
