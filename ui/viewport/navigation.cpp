#include "ui/viewport/navigation.h"

#include "core/base/numbers.h"

#include <cmath>

namespace millwright::viewport {

namespace {

constexpr double zoom_per_notch = 0.85;

} // namespace

bool navigates(const widgets::Pointer& pointer) {
    return pointer.held && (*pointer.held != widgets::MouseButton::left || pointer.alt);
}

render::Camera
navigated(const render::Camera& camera, const widgets::Pointer& pointer, const render::PixelSize& size) {
    render::Camera moved = camera;
    if (navigates(pointer) && !pointer.pressed) {
        const glm::dvec2 way = {static_cast<double>(pointer.moved.x), static_cast<double>(pointer.moved.y)};
        moved = pointer.shift ? moved.panned(way, size) : moved.orbited(way, size);
    }
    const auto notches = static_cast<double>(pointer.wheel);
    if (!exactly_equal(notches, 0.0)) {
        const glm::dvec2 at = {static_cast<double>(pointer.at.x), static_cast<double>(pointer.at.y)};
        moved = moved.zoomed(std::pow(zoom_per_notch, notches), at, size);
    }
    return moved;
}

} // namespace millwright::viewport
