// A person at the workbench without a screen: the whole window in real OpenGL in memory, real mouse and keys.
// Widgets are found by their path.
#pragma once

#include "ui/render/offscreen_context.h"
#include "ui/window/desktop.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::test {

inline constexpr const char* dome_project = "assets/projects/dome.json";

/// The sample with few nodes, with which a Person begins: most of what is looked at does not depend on their
/// number, and all of them are planned again for every test.
[[nodiscard]] project::Project small_sample();

class Person {
public:
    /// `recovery`: folder of the copies of unsaved work; none are kept if it is empty. `jobs`: folder of the
    /// job logs, and `settings`: of what the window keeps; each one of their own if it is empty.
    explicit Person(const render::PixelSize& screen = {1280, 800},
                    const std::filesystem::path& recovery = {},
                    const std::filesystem::path& jobs = {},
                    const std::filesystem::path& settings = {});
    /// `scale`: that of the monitor.
    Person(const render::PixelSize& screen, double scale);
    Person(const Person&) = delete;
    Person& operator=(const Person&) = delete;
    ~Person();

    [[nodiscard]] actions::AppController& app() { return app_; }
    [[nodiscard]] panels::Desktop& desktop() { return *desktop_; }
    [[nodiscard]] const project::Project& project() { return app_.look().project; }

    void open(const std::filesystem::path& project_file);
    /// Draws `count` frames of 1/60 s, without anything being done.
    void frames(int count = 2);
    /// Waits until nothing runs in the background, then looks twice.
    void wait_idle();

    /// Frames at the pace of a screen, until `done` has become true and been drawn, or the time is over.
    bool live_until(const std::function<bool()>& done, double seconds = 20.0);
    /// The same with what is held down now. After a frame in which the computer stood still, the window wants
    /// another press (actions::HoldToRunJog::longest_frame): it gets one. So it does where a press has had no
    /// effect for a while, as where the machine was just braking.
    bool hold_until(const std::function<bool()>& done, double seconds = 60.0);

    /// Where a widget was in the last frame. Throws Error if it was not drawn.
    [[nodiscard]] widgets::Rect place(std::string_view path);
    [[nodiscard]] bool sees(std::string_view path);
    /// Why a widget is greyed out; empty if it is not. Throws Error if it was not drawn.
    [[nodiscard]] std::string refusal(std::string_view path);

    /// Scrolls the pane of a widget until the widget's middle is in sight. Throws Error if it does not come.
    void bring_into_sight(std::string_view path);
    /// Of a choice at `path`, whose options come up or stand there; waits until it has had its effect.
    void choose(const std::string& path, const std::string& option);
    /// In the middle of a widget that is brought into sight first. Where the widget moves away in the frame
    /// of the press, it is pressed again.
    void click(std::string_view path);
    /// As soon as it is drawn and not greyed out: what a panel offers follows the machine's state by some
    /// frames, and that of a job by some more. False if it was not offered within the time, s.
    [[nodiscard]] bool click_when_offered(std::string_view path, double seconds = 60.0);
    void click_at(widgets::Point at);
    void drag(widgets::Point from, widgets::Point to, int steps = 5);
    void hover(widgets::Point at);
    void press_key(render::Key key, bool ctrl = false, bool shift = false);
    void type(std::string_view text);
    /// From now on; no frame is drawn.
    void hold_button(bool down) { input_.buttons[0] = down; }
    void hold_keys(std::vector<render::Key> keys) { input_.keys = std::move(keys); }
    void hold_gamepad(const std::optional<render::Gamepad>& gamepad) { input_.gamepad = gamepad; }
    void set_focused(bool focused) { input_.focused = focused; }
    /// Clicks a field, replaces its text and commits with Enter.
    void fill_in(std::string_view path, std::string_view text);

    [[nodiscard]] render::Picture picture();
    /// What a widget shows: its rectangle of the picture. A change elsewhere in the window does not change
    /// it. Throws Error if the widget was not drawn.
    [[nodiscard]] render::Picture picture_of(std::string_view path);
    /// For people: the picture as NAME.png in $MILLWRIGHT_PICTURES where it is set.
    void keep(const std::string& name);
    [[nodiscard]] std::filesystem::path folder() const { return folder_; }

private:
    struct Folders {
        std::filesystem::path recovery, jobs, settings;
    };
    Person(const render::PixelSize& screen, double scale, const Folders& folders);
    void frame();
    void frame_of_a_screen(); ///< takes as long as it says in input_, as beside a controller that runs in
                              ///< real time
    void press_anew();        ///< what is held down
    void press();             ///< and lets go, where the mouse is
    bool press_on(std::string_view path); ///< whether the widget was where the button went down

    float scale_; ///< of the monitor
    std::filesystem::path folder_;
    render::OffscreenContext context_;
    actions::AppController app_;
    std::unique_ptr<panels::Desktop> desktop_;
    render::InputState input_;
};

} // namespace millwright::test
