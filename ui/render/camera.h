// An orbit camera: it looks at a target from a distance, z is up. Angles rad, lengths mm.
// Yaw: direction of the eye seen from the target, in the xy plane, counterclockwise from +x seen from above.
// Pitch: height of the eye over that plane, pi/2 straight from above (with yaw -pi/2, y is to the top).
#pragma once

#include "ui/render/bounds.h"
#include "ui/render/pixel_size.h"
#include "ui/render/view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>

namespace millwright::render {

/// Oblique: parallel, and what lies behind the target plane appears shifted by cos 30 deg of its depth to the
/// right and sin 30 deg upwards: from the front x = X + Y cos 30, y = Z + Y sin 30 as in the listing of
/// (Parasilmongkol 1997, KMITL).
enum class Projection { perspective, orthographic, oblique };
enum class StandardView { top, bottom, front, back, left, right, iso, oblique };

struct CameraPose {
    glm::dvec3 target{0.0};
    double distance = 300.0; ///< eye to target, also for the size of an orthographic view
    double yaw = -0.7853981633974483;
    double pitch = 0.6154797086703873;
    Projection projection = Projection::perspective;

    /// Exactly the same place.
    friend bool operator==(const CameraPose& a, const CameraPose& b);
};

/// A value: moving it gives another camera. All projections show the target plane at the same size.
class Camera {
public:
    static constexpr double field_of_view = 0.6108652381980153; ///< top to bottom: 35 degrees

    Camera() = default;
    /// Throws Defect unless everything is finite and the distance positive. Pitch is held to its range.
    explicit Camera(const CameraPose& pose);

    [[nodiscard]] const CameraPose& pose() const { return pose_; }
    [[nodiscard]] glm::dvec3 eye() const;
    [[nodiscard]] glm::dvec3 right() const;
    [[nodiscard]] glm::dvec3 up() const;
    /// From the target to the eye.
    [[nodiscard]] glm::dvec3 backward() const;

    /// What the camera sees in a picture of this size; near and far planes enclose `scene`.
    [[nodiscard]] View view(const PixelSize& size, const Bounds& scene, double content_scale = 1.0) const;

    /// Turned about the target.
    [[nodiscard]] Camera orbited(double yaw, double pitch) const;
    /// Turned by a drag: one picture height is half a turn; the scene follows the hand.
    [[nodiscard]] Camera orbited(const glm::dvec2& drag_px, const PixelSize& size) const;
    /// The target plane follows the hand.
    [[nodiscard]] Camera panned(const glm::dvec2& drag_px, const PixelSize& size) const;
    /// Distance times `factor` (below 1: closer); what the target plane shows at `pixel` stays there.
    [[nodiscard]] Camera zoomed(double factor, const glm::dvec2& pixel, const PixelSize& size) const;
    /// As close as a small margin allows with all points in the picture and centred, seen from the same side.
    /// The target moves to their middle. No points, or an empty box, change nothing.
    [[nodiscard]] Camera fitted(std::span<const glm::dvec3> points, double aspect) const;
    [[nodiscard]] Camera fitted(const Bounds& box, double aspect) const;
    /// Oblique brings its projection along; the other sides turn an oblique projection into an orthographic
    /// one.
    [[nodiscard]] Camera seen_from(StandardView side) const;
    [[nodiscard]] Camera with(Projection projection) const;

private:
    CameraPose pose_;
};

/// Half of the height that the target plane shows, mm.
[[nodiscard]] double half_height(const Camera& camera);

} // namespace millwright::render
