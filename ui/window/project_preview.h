// What a project file holds, before it is opened: its surface as a small picture, grid, machine, when it was
// saved.
#pragma once

#include "ui/panels/panel.h"
#include "ui/render/framebuffer.h"
#include "ui/viewport/scene_view.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::panels {

class ProjectPreview {
public:
    /// Reads `file` when it is another than before. What is wrong with it stands in place of the facts.
    void draw(Ui& ui, const std::filesystem::path& file);
    /// Words in place of the facts, in as much room.
    static void draw_words(Ui& ui, std::string_view words);

private:
    struct Drawn {
        std::shared_ptr<const geometry::Surface> surface;
        widgets::Theme theme = widgets::Theme::dark;
        friend bool operator==(const Drawn&, const Drawn&) = default;
    };

    void read(const std::filesystem::path& file);
    void draw_picture(const Ui& ui);
    static void show(Ui& ui, std::uintptr_t texture, std::string_view words);

    std::filesystem::path file_;
    std::string words_;
    std::shared_ptr<const geometry::Surface> surface_; ///< null if the file cannot be read
    std::unique_ptr<viewport::SceneView> view_;        ///< made when there is something to show
    render::ViewTarget target_;
    std::optional<Drawn> drawn_;
};

} // namespace millwright::panels
