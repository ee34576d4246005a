// From where the part on a machine can be seen: columns, plates and arms stand in the way from most sides.
#pragma once

#include "ui/render/camera.h"
#include "ui/viewport/scene.h"

namespace millwright::viewport {

/// How much of the surface is seen from a direction: the part of its places that face the eye and have no
/// body of the machine before them, 0 to 1. `to_eye`: unit, scene coordinates.
[[nodiscard]] double part_seen(const Scene& scene, const Vec3& to_eye);

/// The camera turned about the vertical, as little as possible, to where nearly as much of the part is seen
/// as from anywhere.
[[nodiscard]] render::Camera part_in_sight(const Scene& scene, const render::Camera& camera);

} // namespace millwright::viewport
