#include "core/base/error.h"
#include "tests/ui/render/clear_screen.h"
#include "ui/render/framebuffer.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/shader_program.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace millwright::render {
namespace {

TEST(ViewTarget, GivesTheDrawingBackToWhatWasBound) {
    OffscreenContext context({10, 6});
    context.begin();
    ViewTarget target;
    target.begin({30, 20});
    clear_screen(1.0F, 0.0F, 0.0F);
    target.end();
    clear_screen(0.0F, 0.0F, 1.0F);
    EXPECT_EQ(target.read().at(29, 19), (Pixel{255, 0, 0, 255}));
    EXPECT_EQ(context.read_back().at(9, 5), (Pixel{0, 0, 255, 255}));
    GLint viewport[4] = {};
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_EQ(viewport[2], 10);
    EXPECT_EQ(viewport[3], 6);
}

/// Left of the line through the corners white, right of it black: edges that are smooth have greys.
int greys(Edges edges) {
    const OffscreenContext context({4, 4});
    const ShaderProgram program("#version 330 core\n"
                                "void main() {\n"
                                "    vec2 corner[3] = vec2[](vec2(-1.0), vec2(-1.0, 1.0), vec2(0.9, 1.0));\n"
                                "    gl_Position = vec4(corner[gl_VertexID], 0.0, 1.0);\n"
                                "}\n",
                                "#version 330 core\n"
                                "out vec4 color;\n"
                                "void main() { color = vec4(1.0); }\n");
    const VertexArray nothing;
    ViewTarget target(4);
    target.begin({40, 30}, edges);
    clear_screen(0.0F, 0.0F, 0.0F);
    program.use();
    glBindVertexArray(nothing.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    target.end();
    const Picture picture = target.read();
    return static_cast<int>(
        std::ranges::count_if(picture.pixels, [](const Pixel& p) { return p[0] > 0 && p[0] < 255; }));
}

TEST(ViewTarget, HasSmoothEdgesUnlessRoughOnesWillDo) {
    EXPECT_GT(greys(Edges::smooth), 20);
    EXPECT_EQ(greys(Edges::rough), 0);
}

TEST(ViewTarget, ShowsWhatWasDrawnLastWhicheverEdgesItHad) {
    const OffscreenContext context({4, 4});
    ViewTarget target(4);
    const std::array<Edges, 3> order{Edges::smooth, Edges::rough, Edges::smooth};
    for (std::size_t k = 0; k < order.size(); ++k) {
        target.begin({6, 6}, order[k]);
        clear_screen(static_cast<float>(k) / 2.0F, 1.0F, 0.0F);
        target.end();
        EXPECT_NEAR(target.read().at(3, 3)[0], 127.5 * static_cast<double>(k), 1.0);
    }
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
