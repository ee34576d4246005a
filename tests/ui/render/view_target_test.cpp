#include "ui/render/view_target.h"

#include "core/base/error.h"
#include "ui/render/offscreen_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

namespace millwright::render {
namespace {

void clear(float red, float green, float blue) {
    glClearColor(red, green, blue, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
}

TEST(ViewTarget, GivesTheDrawingBackToWhatWasBound) {
    OffscreenContext context({10, 6});
    context.begin();
    ViewTarget target;
    target.begin({30, 20});
    clear(1.0F, 0.0F, 0.0F);
    target.end();
    clear(0.0F, 0.0F, 1.0F);
    EXPECT_EQ(target.read().at(29, 19), (Pixel{255, 0, 0, 255}));
    EXPECT_EQ(context.read_back().at(9, 5), (Pixel{0, 0, 255, 255}));
    GLint viewport[4] = {};
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(viewport[2], 10);
    EXPECT_EQ(viewport[3], 6);
}

TEST(ViewTarget, KeepsItsTextureUntilTheSizeChanges) {
    const OffscreenContext context({4, 4});
    ViewTarget target;
    EXPECT_EQ(target.texture(), 0U);
    target.begin({30, 20});
    target.end();
    const GlId first = target.texture();
    target.begin({30, 20});
    target.end();
    EXPECT_EQ(target.texture(), first);
    target.begin({31, 20});
    target.end();
    EXPECT_EQ(target.size(), (PixelSize{31, 20}));
}

TEST(ViewTarget, TakesASizeWithoutAreaAsOnePixel) {
    const OffscreenContext context({4, 4});
    ViewTarget target;
    target.begin({0, -5});
    target.end();
    EXPECT_EQ(target.size(), (PixelSize{1, 1}));
}

TEST(ViewTarget, CannotBeReadBeforeItWasDrawn) {
    const OffscreenContext context({4, 4});
    ViewTarget target;
    EXPECT_THROW(static_cast<void>(target.read()), Defect);
    EXPECT_THROW(target.end(), Defect);
}

} // namespace
} // namespace millwright::render
