// The bodies of an arm on the graphics processor.
#pragma once

#include "ui/viewport/arm_scene.h"
#include "ui/viewport/internal/layer.h"
#include "ui/viewport/internal/solid_buffers.h"

#include <memory>
#include <optional>
#include <vector>

namespace millwright::viewport {

/// How a body is coloured.
struct ArmTint {
    std::optional<glm::vec3> color = std::nullopt; ///< in place of its own
    float opacity = 1.0F;
    render::Depth depth = render::Depth::tested;
    int bright_joint = -1;    ///< whose bodies are lighter; -1: none
    bool moving_only = false; ///< without the bodies that no joint moves
};

class ArmBuffers {
public:
    /// Makes them anew for another arm.
    void follow(const std::shared_ptr<const ArmLook>& look);
    void draw(const Canvas& canvas, const arm::JointPositions& joints, const ArmTint& tint) const;

private:
    struct Part {
        std::vector<ColoredMesh> meshes;
        int joint = -1;
        bool moves = true;
    };

    std::shared_ptr<const ArmLook> look_;
    std::vector<Part> parts_;
};

} // namespace millwright::viewport
