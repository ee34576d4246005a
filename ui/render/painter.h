// Draws the primitives of the 3D layers into the bound framebuffer. Owns the shader programs and the colour
// maps; made once per context, after it and gone before it. See-through things are drawn last, far ones
// first.
#pragma once

#include "ui/render/gl_objects.h"
#include "ui/render/line_drawer.h"
#include "ui/render/mesh_drawer.h"
#include "ui/render/path_drawer.h"
#include "ui/render/point_drawer.h"
#include "ui/render/shader_program.h"
#include "ui/render/view.h"
#include "ui/render/view_colors.h"

namespace millwright::render {

class Painter {
public:
    /// Needs a current context. Throws Defect if a shader does not compile.
    Painter();

    /// Clears depth and fills the framebuffer with the soft gradient of `colors`.
    void background(const ViewColors& colors) const;

    void mesh(const MeshBuffer& buffer, const MeshStyle& style, const View& view) const;
    void lines(const LineBuffer& buffer, const LineStyle& style, const View& view) const;
    void path(const PathBuffer& buffer,
              std::span<const std::uint16_t> indices,
              const PathStyle& style,
              const View& view) const;
    void points(const PointBuffer& buffer, const PointStyle& style, const View& view) const;

private:
    ShaderProgram background_;
    VertexArray nothing_;
    Texture maps_;
    MeshDrawer mesh_;
    LineDrawer line_;
    PathDrawer path_;
    PointDrawer point_;
};

} // namespace millwright::render
