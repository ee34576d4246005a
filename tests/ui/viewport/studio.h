// A place without display in which scenes are drawn and looked at. A test that leaves an error in OpenGL
// fails.
#pragma once

#include "ui/render/camera.h"
#include "ui/render/framebuffer.h"
#include "ui/render/offscreen_context.h"
#include "ui/viewport/scene_view.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace millwright::test {

/// For people: written to $MILLWRIGHT_PICTURES where it is set.
inline void keep(const render::Picture& picture, const std::string& name) {
    if (const char* folder = std::getenv("MILLWRIGHT_PICTURES")) {
        render::write_png(picture, std::filesystem::path(folder) / (name + ".png"));
    }
}

class Studio : public ::testing::Test {
protected:
    explicit Studio(const render::PixelSize& size = {320, 240}) : size_(size), context_(size) {}

    void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

    /// Through a camera that holds all of the scene.
    [[nodiscard]] render::View look_at(const viewport::Scene& scene,
                                       render::StandardView side = render::StandardView::iso) {
        view_.update(scene);
        const render::Camera camera =
            render::Camera().seen_from(side).fitted(view_.outline(), render::aspect(size_));
        return camera.view(size_, view_.depth_range());
    }

    [[nodiscard]] render::Picture picture(const viewport::Scene& scene,
                                          const render::View& view,
                                          const viewport::Highlight& highlight = {}) {
        view_.update(scene);
        target_.begin(size_);
        view_.draw(view, render::view_colors(render::Theme::dark), highlight);
        target_.end();
        return target_.read();
    }

    [[nodiscard]] const viewport::SceneView& view() const { return view_; }
    [[nodiscard]] const render::PixelSize& size() const { return size_; }

private:
    render::PixelSize size_;
    render::OffscreenContext context_;
    viewport::SceneView view_;
    render::ViewTarget target_;
};

} // namespace millwright::test
