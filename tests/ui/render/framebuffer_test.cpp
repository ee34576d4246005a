#include "ui/render/framebuffer.h"

#include "core/base/error.h"
#include "ui/render/offscreen_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::render {
namespace {

TEST(Framebuffer, ReadsBackWhatWasDrawnWithAnyNumberOfSamples) {
    const OffscreenContext context({4, 4});
    for (const int samples : {1, 4}) {
        const Framebuffer framebuffer({5, 3}, samples);
        framebuffer.bind();
        glClearColor(0.0F, 1.0F, 0.2F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        framebuffer.resolve();
        const Picture picture = framebuffer.read();
        EXPECT_EQ(picture.size, (PixelSize{5, 3}));
        EXPECT_TRUE(std::ranges::all_of(picture.pixels, [](const Pixel& p) {
            return p == Pixel{0, 255, 51, 255};
        }));
    }
}

TEST(Framebuffer, TakesAsManySamplesAsTheDriverHas) {
    const OffscreenContext context({4, 4});
    EXPECT_GT(Framebuffer({4, 4}, 4).samples(), 1);
    EXPECT_LT(Framebuffer({4, 4}, 1000).samples(), 1000);
    EXPECT_EQ(Framebuffer({4, 4}, 0).samples(), 1);
}

TEST(Framebuffer, LeavesTheBoundOneWhenItIsMadeAndRead) {
    const OffscreenContext context({4, 4});
    const Framebuffer bound({4, 4});
    bound.bind();
    GLint before = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
    const Framebuffer other({4, 4}, 4);
    other.resolve();
    static_cast<void>(other.read());
    GLint after = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &after);
    EXPECT_EQ(after, before);
}

TEST(Framebuffer, RefusesASizeWithoutArea) {
    const OffscreenContext context({4, 4});
    EXPECT_THROW(Framebuffer({0, 4}), Defect);
}

} // namespace
} // namespace millwright::render
