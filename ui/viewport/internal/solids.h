// Simple solids with their edges: boxes and bodies of revolution.
#pragma once

#include "core/toolpath/tool.h"
#include "ui/viewport/internal/layer.h"

#include <glm/vec2.hpp>

#include <span>

namespace millwright::viewport {

/// A solid in its own coordinates.
struct Solid {
    std::vector<render::MeshVertex> vertices;
    std::vector<std::uint32_t> triangles;
    std::vector<render::LineVertex> edges; ///< segments
};

/// From `min` to `max`.
[[nodiscard]] Solid box_solid(const glm::vec3& min, const glm::vec3& max);

/// The profile (radius, z), from one end to the other with the outside at its right when z rises, turned
/// about z. Stretches
/// that meet in a corner meet in an edge, those of a curve do not.
[[nodiscard]] Solid turned_solid(std::span<const glm::vec2> profile);

[[nodiscard]] Solid cylinder_solid(float diameter, float height);

/// A tool of radius 1 along z, its tip at the origin, with a holder. Tapered, since the tool is taken for a
/// point.
[[nodiscard]] Solid tool_solid();

/// Cutter and holder in their true shape and size along z, the tip at the origin. Throws Defect without a
/// cutter.
[[nodiscard]] Solid tool_solid(const toolpath::Tool& tool);

/// A flat polygon of four corners, counter-clockwise seen from outside.
void add_quad(Solid& solid, const std::array<glm::vec3, 4>& corners);

class SolidBuffers {
public:
    SolidBuffers() = default;
    explicit SolidBuffers(const Solid& solid);

    void draw(const Canvas& canvas, const glm::mat4& model, const glm::vec3& color) const;

private:
    render::MeshBuffer mesh_;
    render::LineBuffer edges_;
};

} // namespace millwright::viewport
