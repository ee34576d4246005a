// A person at the workbench in memory, so no display is needed; where no graphics card is, Mesa's llvmpipe
// draws on the processor.
#pragma once

#include "core/project/assets.h"
#include "ui/window/desktop.h"

#include <epoxy/gl.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

namespace millwright::bench {

using Clock = std::chrono::steady_clock;

inline constexpr render::PixelSize window{1280, 800};

inline double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Processor time of this thread, or of the whole program, s: what a frame costs however many others use the
/// machine.
inline double processor_time(clockid_t whose) {
    timespec now{};
    clock_gettime(whose, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A person who opens a file and keeps on turning the view.
class Visitor {
public:
    Visitor()
        : context_(window), app_({.assets = project::assets_folder(),
                                  .log_folder = {},
                                  .settings = {},
                                  .recovery = {},
                                  .wake = [] {}}),
          desktop_(context_, app_) {
        app_.wait_idle();
        for (int n = 0; n < 3; ++n) {
            turn();
        }
        forget_longest();
    }

    void open(const std::filesystem::path& file) { app_.open(file); }

    /// One frame with the camera a little further.
    void turn() {
        viewport::Viewport& view = desktop_.window().view().viewport();
        draw(view.camera().orbited(0.01, 0.0));
    }

    /// One frame of this camera.
    void draw(const render::Camera& camera) {
        const Clock::time_point start = Clock::now();
        const double cpu = processor_time(CLOCK_THREAD_CPUTIME_ID);
        desktop_.window().view().viewport().set_camera(camera);
        (void)app_.advance(1.0 / 60.0);
        desktop_.frame(render::InputState{});
        context_.present();
        glFinish();
        longest_ = std::max(longest_, seconds_since(start));
        longest_cpu_ = std::max(longest_cpu_, processor_time(CLOCK_THREAD_CPUTIME_ID) - cpu);
    }

    [[nodiscard]] std::shared_ptr<const plan::OpenedProgram> opened() { return app_.look().opened; }
    [[nodiscard]] actions::AppController& app() { return app_; }
    [[nodiscard]] const render::Camera& camera() { return desktop_.window().view().viewport().camera(); }
    void forget_longest() { longest_ = longest_cpu_ = 0.0; }
    [[nodiscard]] double longest() const { return longest_; }
    [[nodiscard]] double longest_cpu() const { return longest_cpu_; }

private:
    render::OffscreenContext context_;
    actions::AppController app_;
    panels::Desktop desktop_;
    double longest_ = 0.0, longest_cpu_ = 0.0; ///< s
};

} // namespace millwright::bench
