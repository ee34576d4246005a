#include "ui/viewport/internal/tool_mark.h"

#include "ui/viewport/internal/boxes.h"

#include <glm/ext/matrix_transform.hpp>

namespace millwright::viewport {

namespace {

constexpr double share = 0.025; // radius of the mark to that of what is shown

} // namespace

void ToolMark::prepare() {
    if (!solid_) {
        solid_.emplace(tool_solid());
    }
}

void ToolMark::draw(const Canvas& canvas, const Vec3& tip, const Vec3& axis) const {
    Frame placed = Frame::Identity();
    placed.linear() = frame_along(axis);
    placed.translation() = tip;
    const auto size = static_cast<float>(share * radius(canvas.content));
    const glm::mat4 model = canvas.s_T_w * glm::mat4(render::to_glm(placed));
    solid_->draw(canvas, glm::scale(model, glm::vec3(size)), canvas.colors.tool);
}

} // namespace millwright::viewport
