#include "ui/render/offscreen_context.h"

#include "core/base/error.h"
#include "tests/ui/render/clear_screen.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace millwright::render {
namespace {

bool is_plain(const Picture& picture, const Pixel& pixel) {
    return std::ranges::all_of(picture.pixels, [&](const Pixel& p) { return p == pixel; });
}

TEST(OffscreenContext, ReadsBackTheColourItWasClearedTo) {
    OffscreenContext context({33, 17});
    context.begin();
    clear_screen(1.0F, 0.2F, 0.0F);
    const Picture picture = context.read_back();
    EXPECT_EQ(picture.size, (PixelSize{33, 17}));
    EXPECT_TRUE(is_plain(picture, {255, 51, 0, 255}));
}

TEST(OffscreenContext, NeedsNoDisplay) {
    const char* before = std::getenv("DISPLAY");
    const std::string kept = before != nullptr ? before : "";
    ::unsetenv("DISPLAY");
    EXPECT_NO_THROW(OffscreenContext({8, 8}));
    if (before != nullptr) {
        ::setenv("DISPLAY", kept.c_str(), 1);
    }
}

TEST(OffscreenContext, HasItsTopRowFirst) {
    OffscreenContext context({4, 4});
    context.begin();
    clear_screen(0.0F, 0.0F, 0.0F);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 3, 4, 1); // OpenGL counts rows from below
    clear_screen(1.0F, 1.0F, 1.0F);
    const Picture picture = context.read_back();
    EXPECT_EQ(picture.at(0, 0), (Pixel{255, 255, 255, 255}));
    EXPECT_EQ(picture.at(0, 1), (Pixel{0, 0, 0, 255}));
}

TEST(OffscreenContext, TakesTheSizeItIsGivenLater) {
    OffscreenContext context({8, 8}, 1.5);
    context.resize({20, 10});
    EXPECT_EQ(context.framebuffer_size(), (PixelSize{20, 10}));
    EXPECT_EQ(context.read_back().pixels.size(), 200U);
    EXPECT_DOUBLE_EQ(context.content_scale(), 1.5);
    EXPECT_THROW(context.resize({0, 10}), Defect);
}

TEST(OffscreenContext, LivesBesideAnother) {
    OffscreenContext first({4, 4});
    {
        OffscreenContext second({4, 4});
        second.begin();
        clear_screen(0.0F, 1.0F, 0.0F);
        first.begin();
        clear_screen(1.0F, 0.0F, 0.0F);
        EXPECT_TRUE(is_plain(second.read_back(), {0, 255, 0, 255}));
    }
    EXPECT_TRUE(is_plain(first.read_back(), {255, 0, 0, 255}));
}

/// Says what goes wrong on standard error and ends with 1, as a program would.
[[noreturn]] void open_or_say_why(const char* variable, const char* value) {
    ::setenv(variable, value, 1);
    try {
        const OffscreenContext context({8, 8});
    } catch (const Error& error) {
        std::cerr << to_text(error.diagnostic());
        std::exit(1);
    }
    std::exit(0);
}

// The variables are read once a process, so each of these runs in a new one.
class WithoutOpenGl : public ::testing::Test {
protected:
    WithoutOpenGl() { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(WithoutOpenGl, SaysThatThereIsNoEgl) {
    EXPECT_EXIT(open_or_say_why("__EGL_VENDOR_LIBRARY_FILENAMES", "/none.json"),
                ::testing::ExitedWithCode(1),
                "cannot draw without a display: .*EGL.*install the graphics driver");
}

TEST_F(WithoutOpenGl, SaysThatOpenGlIsTooOld) {
    EXPECT_EXIT(open_or_say_why("MESA_GL_VERSION_OVERRIDE", "2.1"),
                ::testing::ExitedWithCode(1),
                "cannot draw without a display: .*OpenGL 3.3");
}

} // namespace
} // namespace millwright::render
