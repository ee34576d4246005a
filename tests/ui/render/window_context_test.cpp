#include "ui/render/window_context.h"

#include "core/base/error.h"
#include "tests/ui/render/file_manager.h"
#include "tests/ui/render/task_manager.h"
#include "ui/render/camera.h"
#include "ui/render/framebuffer.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/painter.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace millwright::render {
namespace {

/// Sets a variable of the environment, or removes it, until the end of the scope.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) {
            old_ = old;
        }
        value != nullptr ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }

private:
    const char* name_;
    std::optional<std::string> old_;
};

std::string reason_without(const char* display) {
    const Environment none("DISPLAY", display);
    try {
        const WindowContext window(WindowOptions{});
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return {};
}

TEST(WindowContext, SaysThatThereIsNoDisplay) {
    EXPECT_EQ(
        reason_without(nullptr),
        "cannot open a window: no display is available (DISPLAY is not set) (start the program in a desktop "
        "session, or use the commands that do not open a window)");
}

TEST(WindowContext, NamesTheDisplayThatDoesNotAnswer) {
    EXPECT_NE(reason_without(":987").find("the display :987 cannot be used"), std::string::npos);
}

class WithDisplay : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::getenv("DISPLAY") == nullptr) {
            GTEST_SKIP() << "NOT TESTED: there is no DISPLAY; run the tests under xvfb-run";
        }
    }
};

void draw_scene(const PixelSize& size) {
    const Painter painter;
    const View view = Camera().view(size, Bounds{});
    const std::array<MeshVertex, 3> corners = {{{.position = {-80.0F, 0.0F, -30.0F}},
                                                {.position = {80.0F, 0.0F, -30.0F}},
                                                {.position = {0.0F, 20.0F, 70.0F}}}};
    const std::array<LineVertex, 3> line = {{{.position = {-90.0F, 10.0F, 0.0F}},
                                             {.position = {0.0F, -40.0F, 30.0F}},
                                             {.position = {90.0F, 0.0F, 9.0F}}}};
    painter.background(view_colors(Theme::dark));
    painter.mesh(MeshBuffer(corners, std::array<std::uint32_t, 3>{0, 1, 2}), {}, view);
    painter.lines(LineBuffer(line, LineTopology::strip), {.width_px = 5.0F}, view);
}

struct Drawn {
    Picture by_context;
    Picture by_target;
};

Drawn scene_in(Context& context) {
    const PixelSize size = context.framebuffer_size();
    context.begin();
    draw_scene(size);
    ViewTarget target;
    target.begin(size);
    draw_scene(size);
    target.end();
    return {.by_context = context.read_back(), .by_target = target.read()};
}

/// Until the display has said all that it has to say about a new window: asking for its size waits for an
/// answer, and whatever was caused before comes before it.
void settle(WindowContext& window) {
    do {
        static_cast<void>(window.framebuffer_size());
    } while (window.wait(0.05));
}

TEST_F(WithDisplay, DrawsTheSamePixelsAsWithoutAWindow) {
    const Drawn in_window = [] {
        WindowContext window({.place = {.size = {320, 240}}, .smallest = {100, 100}});
        return scene_in(window);
    }();
    OffscreenContext memory(in_window.by_context.size);
    const Drawn in_memory = scene_in(memory);
    EXPECT_TRUE(in_window.by_target == in_memory.by_target);
    // A window's rows count from above, so a pixel exactly on an edge may fall to the other side.
    EXPECT_LT(difference(in_window.by_context, in_memory.by_context).fraction, 1e-4);
}

TEST_F(WithDisplay, IsDrawnOnceWhenItOpensAndThenOnRequestOnly) {
    WindowContext window({.place = {.size = {200, 150}}, .smallest = {100, 100}});
    EXPECT_TRUE(window.wait(0.0));
    settle(window);
    EXPECT_FALSE(window.wait(0.05));
    window.request_redraw();
    EXPECT_TRUE(window.wait(10.0));
    EXPECT_FALSE(window.wait(0.05));
}

TEST_F(WithDisplay, IsWokenByARequestFromAnotherThread) {
    WindowContext window({.place = {.size = {200, 150}}, .smallest = {100, 100}});
    settle(window);
    const std::jthread other([&window] { window.request_redraw(); });
    EXPECT_TRUE(window.wait(-1.0));
}

TEST_F(WithDisplay, OpensAgainAfterItWasClosed) {
    for (int i = 0; i < 2; ++i) {
        WindowContext window({.place = {.size = {200, 150}}, .smallest = {100, 100}});
        EXPECT_EQ(window.framebuffer_size(), (PixelSize{200, 150}));
        EXPECT_FALSE(window.close_requested());
        EXPECT_GE(window.content_scale(), 0.5);
    }
}

TEST_F(WithDisplay, FilesOfAnotherProgramAreDroppedOnIt) {
    WindowContext window(
        {.title = "where files fall", .place = {.size = {200, 150}}, .smallest = {100, 100}});
    std::vector<std::filesystem::path> dropped;
    window.on_drop([&dropped](const std::vector<std::filesystem::path>& files) { dropped = files; });
    settle(window);
    test::FileManager other;
    other.drop("where files fall", "file:///tmp/a%20plot.plt\r\nfile:///tmp/%E0%B8%AB.png\r\n");
    bool drawn = false;
    while (!other.answers_until_taken()) {
        drawn = window.wait(0.01) || drawn;
    }
    EXPECT_EQ(dropped, (std::vector<std::filesystem::path>{"/tmp/a plot.plt", "/tmp/\xE0\xB8\xAB.png"}));
    EXPECT_TRUE(drawn); // what they are is seen
}

/// As a task manager does it, or the display that ends.
[[noreturn]] void lose_display_and_wait() {
    WindowContext window({.title = "to be killed"});
    bool told = false;
    window.on_display_lost([&told] {
        told = true;
        constexpr int as_wanted = 7;
        std::_Exit(as_wanted);
    });
    test::end_program_of(window.handle());
    for (int frame = 0; frame < 200 && !told; ++frame) {
        window.begin();
        window.present();
        (void)window.wait(0.02);
    }
    std::_Exit(1);
}

TEST(WindowContext, TellsThatItsDisplayIsLost) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(lose_display_and_wait(), testing::ExitedWithCode(7), "");
}

} // namespace
} // namespace millwright::render
