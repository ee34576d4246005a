#include "ui/render/ink.h"

#include "ui/render/color_map.h"

#include <algorithm>

namespace millwright::render {

namespace {

/// On the part of the background where it is seen worst.
double least_contrast(const ViewColors& colors, const glm::vec3& ink) {
    return std::min(contrast(ink, colors.background_top), contrast(ink, colors.background_bottom));
}

bool takes_strong_end(const ViewColors& colors) {
    return least_contrast(colors, colors.neutral.back()) >= least_contrast(colors, colors.neutral.front());
}

} // namespace

glm::vec3 ink(const ViewColors& colors) {
    return takes_strong_end(colors) ? colors.neutral.back() : colors.neutral.front();
}

glm::vec3 faint_ink(const ViewColors& colors) {
    return takes_strong_end(colors) ? colors.neutral[6] : colors.neutral[1];
}

} // namespace millwright::render
