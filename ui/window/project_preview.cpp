#include "ui/window/project_preview.h"

#include "core/base/error.h"
#include "core/geometry/presets.h"
#include "core/project/project_file.h"
#include "core/project/setting_tables.h"
#include "core/project/surface.h"
#include "ui/panels/numbers_text.h"
#include "ui/render/camera.h"
#include "ui/render/view_colors.h"
#include "ui/widgets/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace millwright::panels {

namespace {

namespace fs = std::filesystem;

constexpr render::PixelSize picture_size{240, 150}; // at scale 1

std::string surface_text(const project::SurfaceInput& surface) {
    const auto presets = geometry::surface_presets();
    const auto preset = std::find_if(
        presets.begin(), presets.end(), [&](const auto& known) { return known.id == surface.preset; });
    if (surface.joined) {
        return fmt::format("{} exact faces, joined", surface.joined->faces.size());
    }
    if (surface.face) {
        return fmt::format(
            "Exact face, degree {}, {}", surface.face->net.degree_u, surface.face->net.degree_v);
    }
    const auto& net = surface.patches.front();
    return fmt::format("{}, degree {}, {}",
                       preset == presets.end() ? "Custom shape" : preset->title,
                       net.rows - 1,
                       net.columns - 1);
}

std::string saved_text(const fs::path& file) {
    std::error_code failure;
    const fs::file_time_type time = fs::last_write_time(file, failure);
    if (failure) {
        return "-";
    }
    const auto wall = std::chrono::file_clock::to_sys(time).time_since_epoch();
    return date_time_text(std::chrono::duration_cast<std::chrono::seconds>(wall).count());
}

std::string facts(const project::Project& project, const fs::path& file) {
    return fmt::format("{}\nSurface: {}\nGrid: {} x {}, {}\nMachine: {}\nSaved: {}",
                       project.name,
                       surface_text(project.surface),
                       project.grid.nu,
                       project.grid.nv,
                       project::row_of(project::grid_methods(), project.grid.method).label,
                       project.machine.file,
                       saved_text(file));
}

render::Theme of_pictures(widgets::Theme theme) {
    return theme == widgets::Theme::dark ? render::Theme::dark : render::Theme::light;
}

} // namespace

void ProjectPreview::read(const fs::path& file) {
    file_ = file;
    surface_.reset();
    words_.clear();
    if (file.empty()) {
        return;
    }
    try {
        const project::Project project = project::read_project(file);
        words_ = facts(project, file);
        surface_ = std::make_shared<const geometry::Surface>(project::surface_of(project.surface));
    } catch (const Error& error) {
        words_ = error.diagnostic().message;
    }
}

void ProjectPreview::draw_picture(const Ui& ui) {
    const Drawn wanted{surface_, ui.look().theme};
    if (!surface_ || drawn_ == wanted) {
        return;
    }
    if (!view_) {
        view_ = std::make_unique<viewport::SceneView>();
    }
    viewport::Scene scene;
    scene.surface = surface_;
    scene.layers.design.lines = true;
    scene.layers.origin = false;
    view_->update(scene);
    const auto scale = static_cast<double>(ui.look().scale);
    const render::PixelSize size{static_cast<int>(ui.px(picture_size.width)),
                                 static_cast<int>(ui.px(picture_size.height))};
    const double aspect = static_cast<double>(size.width) / size.height;
    const render::Camera camera = render::Camera().fitted(view_->outline(), aspect);
    target_.begin(size);
    view_->draw(camera.view(size, view_->depth_range(), scale),
                render::view_colors(of_pictures(ui.look().theme)),
                {});
    target_.end();
    drawn_ = wanted;
}

void ProjectPreview::draw(Ui& ui, const fs::path& file) {
    if (file != file_) {
        read(file);
    }
    draw_picture(ui);
    show(ui, surface_ ? target_.texture() : 0, file_.empty() ? "Select a project to preview it." : words_);
}

void ProjectPreview::show(Ui& ui, std::uintptr_t texture, std::string_view words) {
    const widgets::Rect left = ui.rest();
    const widgets::Rect place{left.x, left.y, ui.px(picture_size.width), ui.px(picture_size.height)};
    (void)widgets::canvas(ui, "picture", place, texture);
    ui.beside();
    ui.move_by(ui.px(8.0F), 0.0F);
    ui.text(words);
}

void ProjectPreview::draw_words(Ui& ui, std::string_view words) {
    show(ui, 0, words);
}

} // namespace millwright::panels
