// Draws a scene through a camera: all layers, without any words. Owns their buffers; made once per context,
// after it and gone before it.
#pragma once

#include "ui/render/framebuffer.h"
#include "ui/render/painter.h"
#include "ui/viewport/arm_grip.h"
#include "ui/viewport/scene.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::viewport {

class Layer;

/// What the mouse is on.
struct Highlight {
    std::optional<ControlPointId> point;
    std::optional<int> move;
    std::optional<std::int64_t> path_point =
        std::nullopt; ///< of an opened program: the piece that ends there
    std::optional<ArmGrip> arm = std::nullopt;

    friend bool operator==(const Highlight&, const Highlight&) = default;
};

/// A word at a place of the scene, to be drawn over the picture.
struct Label {
    glm::dvec3 position{};
    std::string text;
    glm::vec3 color{1.0F};
    bool mark = false; ///< a letter at the very place, without a ground; else words above it
};

class SceneView {
public:
    /// Needs a current context. Throws Defect if a shader does not compile.
    SceneView();
    ~SceneView();
    SceneView(const SceneView&) = delete;
    SceneView& operator=(const SceneView&) = delete;

    /// Makes buffers anew for results other than those of the last scene.
    void update(const Scene& scene);

    /// What a camera has to see, in scene coordinates: of the scene last updated.
    [[nodiscard]] const render::Bounds& content() const { return content_; }
    /// The same as points that lie on the content's outline, for a close fit.
    [[nodiscard]] const std::vector<glm::dvec3>& outline() const { return outline_; }

    /// Background and layers of the scene last updated, into the bound framebuffer. With rough edges quick
    /// rather than complete where there is very much to draw.
    void draw(const render::View& view,
              const render::ViewColors& colors,
              const Highlight& highlight,
              render::Edges edges = render::Edges::smooth) const;

    /// There was more to bring to the graphics processor than one frame has time for: update() again.
    [[nodiscard]] bool unfinished() const;

    [[nodiscard]] std::vector<Label> labels(const render::View& view, const render::ViewColors& colors) const;

    /// Bounds that a view has to take into its depth range: the content and what stands around it.
    [[nodiscard]] render::Bounds depth_range() const;

private:
    void add_origin(const Scene& scene);

    render::Painter painter_;
    std::vector<std::unique_ptr<Layer>> layers_;
    Scene scene_;
    std::vector<glm::dvec3> outline_;
    render::Bounds content_;
};

} // namespace millwright::viewport
