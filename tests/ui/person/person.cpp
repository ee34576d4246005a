#include "tests/ui/person/person.h"

#include "core/base/error.h"
#include "ui/workspaces/hold_to_run_jog.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

namespace millwright::test {

namespace {

/// Removed when the program ends: the workshop's threads write to them up to their end.
struct MadeFolders {
    std::vector<std::filesystem::path> made{};
    MadeFolders() = default;
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    ~MadeFolders() {
        for (const auto& folder : made) {
            std::error_code ignored;
            std::filesystem::remove_all(folder, ignored);
        }
    }
};

std::filesystem::path fresh_folder() {
    static int count = 0;
    static MadeFolders folders;
    const auto folder = std::filesystem::temp_directory_path() /
                        ("millwright_person_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    folders.made.push_back(folder);
    return folder;
}

} // namespace

project::Project small_sample() {
    project::Project project = project::project_from_preset("dome");
    project.grid.nu = 6;
    project.grid.nv = 6;
    return project;
}

Person::Person(const render::PixelSize& screen,
               const std::filesystem::path& recovery,
               const std::filesystem::path& jobs,
               const std::filesystem::path& settings)
    : Person(screen, 1.0, Folders{recovery, jobs, settings}) {}

Person::Person(const render::PixelSize& screen, double scale) : Person(screen, scale, Folders{}) {}

Person::Person(const render::PixelSize& screen, double scale, const Folders& folders)
    : scale_(static_cast<float>(scale)), folder_(fresh_folder()), context_(screen, scale),
      app_({.assets = "assets",
            .log_folder = folders.jobs.empty() ? folder_ / "jobs" : folders.jobs,
            .settings = (folders.settings.empty() ? folder_ : folders.settings) / "recent.json",
            .recovery = folders.recovery,
            .wake = [] {},
            .start = small_sample()}) {
    desktop_ = std::make_unique<panels::Desktop>(context_, app_);
    wait_idle();
}

Person::~Person() {
    desktop_.reset();
}

void Person::open(const std::filesystem::path& project_file) {
    app_.open(project_file);
    wait_idle();
}

void Person::frame() {
    (void)app_.advance(static_cast<double>(input_.seconds));
    desktop_->frame_unseen(input_);
    input_.text.clear();
    input_.wheel = 0.0F;
}

void Person::frames(int count) {
    for (int n = 0; n < count; ++n) {
        frame();
    }
}

void Person::wait_idle() {
    frames(2);
    app_.wait_idle();
    frames(3);
}

bool Person::live_until(const std::function<bool()>& done, double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    while (std::chrono::duration<double>(Clock::now() - start).count() < seconds) {
        frame_of_a_screen();
        if (done()) {
            frame(); // a controller's state may be younger than the frame: now the panels show it too
            return true;
        }
    }
    return done();
}

bool Person::hold_until(const std::function<bool()>& done, double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    auto last = start;
    auto pressed = start;
    const auto between = [](Clock::time_point from, Clock::time_point to) {
        return std::chrono::duration<double>(to - from).count();
    };
    while (between(start, last) < seconds) {
        frame_of_a_screen();
        if (done()) {
            return true;
        }
        const auto now = Clock::now();
        const bool stood_still =
            between(std::exchange(last, now), now) > 0.5 * actions::HoldToRunJog::longest_frame;
        constexpr double without_effect = 3.0; // s
        if (stood_still || between(pressed, now) > without_effect) {
            press_anew();
            pressed = now;
        }
    }
    return done();
}

void Person::frame_of_a_screen() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(input_.seconds);
    frame();
    std::this_thread::sleep_until(end);
}

void Person::press_anew() {
    const render::InputState held = input_;
    input_.buttons[0] = false;
    input_.keys.clear();
    if (input_.gamepad) {
        input_.gamepad = render::Gamepad{};
    }
    frame();
    input_ = held;
}

std::string Person::refusal(std::string_view path) {
    (void)place(path);
    return desktop_->ui().places().all().find(path)->second.reason;
}

widgets::Rect Person::place(std::string_view path) {
    const auto found = desktop_->ui().place(path);
    if (!found) {
        std::string near;
        for (const auto& [known, seen] : desktop_->ui().places().all()) {
            near += known + " ";
        }
        throw Error("no widget '" + std::string(path) + "' among: " + near);
    }
    return *found;
}

bool Person::sees(std::string_view path) {
    return desktop_->ui().place(path).has_value();
}

void Person::hover(widgets::Point at) {
    input_.mouse_x = at.x;
    input_.mouse_y = at.y;
    frames(2);
}

void Person::bring_into_sight(std::string_view path) {
    const std::string_view root = path.substr(0, path.find('/'));
    const auto visible = [&] { return desktop_->ui().places().find(path)->visible; };
    // The splitter at the lower edge of a pane takes the mouse.
    const auto is_at_splitter = [&] {
        const auto* const pane = desktop_->ui().places().find(root);
        const float below = pane == nullptr ? -1.0F : pane->rect.bottom() - place(path).centre().y;
        return below >= 0.0F && below < 12.0F * scale_;
    };
    constexpr int most_notches = 200;
    for (int n = 0; n < most_notches; ++n) {
        const widgets::Rect before = place(path);
        if (visible() && !is_at_splitter()) {
            return;
        }
        const widgets::Rect pane = place(root);
        // Beside its widgets, some of which keep the wheel, and off the splitter at its edge.
        hover({pane.x + 3.0F * scale_, pane.centre().y});
        input_.wheel = before.centre().y < pane.centre().y ? 1.0F : -1.0F;
        frames(3);
        if (place(path) == before) {
            break;
        }
    }
    if (!visible()) {
        throw Error("widget '" + std::string(path) + "' cannot be scrolled into sight");
    }
}

void Person::choose(const std::string& path, const std::string& option) {
    const std::string chosen = path + "/" + option;
    if (!sees(chosen)) {
        click(path);
    }
    click(chosen);
    wait_idle();
}

void Person::click(std::string_view path) {
    constexpr int tries = 5;
    for (int n = 0; !press_on(path); ++n) {
        hover({-1.0F, -1.0F}); // lets go beside the window, where that has no effect
        input_.buttons[0] = false;
        frames(2);
        if (n == tries) {
            throw Error("widget '" + std::string(path) + "' does not stay where it is clicked");
        }
    }
    frame();
    input_.buttons[0] = false;
    frames(2);
}

bool Person::press_on(std::string_view path) {
    constexpr int looks = 10;
    bring_into_sight(path);
    widgets::Rect there{};
    for (int n = 0; n < looks && !(there == place(path)); ++n) { // what is worked out meanwhile may move it
        there = place(path);
        hover(there.centre());
    }
    input_.buttons[0] = true;
    frame();
    const auto found = desktop_->ui().place(path);
    return !found || *found == there;
}

bool Person::click_when_offered(std::string_view path, double seconds) {
    const bool offered = live_until([&] { return sees(path) && refusal(path).empty(); }, seconds);
    if (offered) {
        click(path);
    }
    return offered;
}

void Person::click_at(widgets::Point at) {
    hover(at);
    press();
}

void Person::press() {
    input_.buttons[0] = true;
    frames(2);
    input_.buttons[0] = false;
    frames(2);
}

void Person::drag(widgets::Point from, widgets::Point to, int steps) {
    hover(from);
    input_.buttons[0] = true;
    frames(2);
    for (int n = 1; n <= steps; ++n) {
        const float t = static_cast<float>(n) / static_cast<float>(steps);
        hover({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
    input_.buttons[0] = false;
    frames(2);
}

void Person::press_key(render::Key key, bool ctrl, bool shift) {
    input_.ctrl = ctrl;
    input_.shift = shift;
    input_.keys = {key};
    frames(2);
    input_.keys.clear();
    input_.ctrl = input_.shift = false;
    frames(2);
}

void Person::type(std::string_view text) {
    input_.text = text;
    frames(2);
}

void Person::fill_in(std::string_view path, std::string_view text) {
    click(path);
    press_key(render::Key::a, true);
    type(text);
    press_key(render::Key::enter);
}

render::Picture Person::picture() {
    desktop_->frame(input_);
    render::Picture picture = context_.read_back();
    context_.present();
    return picture;
}

render::Picture Person::picture_of(std::string_view path) {
    const render::Picture whole = picture();
    const widgets::Rect rect = place(path);
    const int left = std::max(0, static_cast<int>(std::ceil(rect.x)));
    const int top = std::max(0, static_cast<int>(std::ceil(rect.y)));
    const int right = std::min(whole.size.width, static_cast<int>(rect.right()));
    const int bottom = std::min(whole.size.height, static_cast<int>(rect.bottom()));
    render::Picture part{{right - left, bottom - top}, {}};
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
            part.pixels.push_back(whole.at(x, y));
        }
    }
    return part;
}

void Person::keep(const std::string& name) {
    if (const char* folder = std::getenv("MILLWRIGHT_PICTURES")) {
        render::write_png(picture(), std::filesystem::path(folder) / (name + ".png"));
    }
}

} // namespace millwright::test
