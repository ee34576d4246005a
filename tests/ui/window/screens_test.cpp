// Every workspace with all its tabs on small, usual and very fine screens: nothing is cut, nothing lies over
// another thing.
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/at_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using test::Person;
using widgets::Rect;

struct Monitor {
    render::PixelSize size;
    double scale;
    const char* name;
};

/// The last one is 1024 x 700 at the size in which it is read.
constexpr std::array monitors{Monitor{{1280, 800}, 1.0, "1280x800"},
                              Monitor{{1024, 700}, 1.0, "1024x700"},
                              Monitor{{1280, 875}, 1.25, "1280x875_at_125"},
                              Monitor{{3840, 2160}, 2.0, "3840x2160_at_200"}};

constexpr std::array every_workspace{
    "design", "grid", "toolpath", "program", "machine", "processor", "plot", "arm"};

float shared(float a0, float a1, float b0, float b1) {
    return std::min(a1, b1) - std::max(a0, b0);
}

bool overlap(const Rect& a, const Rect& b) {
    return shared(a.x, a.right(), b.x, b.right()) > 1.0F && shared(a.y, a.bottom(), b.y, b.bottom()) > 1.0F;
}

bool inside(const Rect& a, const Rect& b) {
    constexpr float edge = 0.5F;
    return a.x >= b.x - edge && a.right() <= b.right() + edge && a.y >= b.y - edge &&
           a.bottom() <= b.bottom() + edge;
}

std::string pane_of(std::string_view path) {
    return std::string(path.substr(0, path.find('/')));
}

/// Signs at places of the scene may lie over each other, as the places do.
bool is_sign(std::string_view path) {
    constexpr std::array<std::string_view, 6> signs{
        "control_point(", "/link_", "view/tip", "view/part", "/corner(", "/iso"};
    return path.starts_with("view") &&
           std::ranges::any_of(signs, [&](std::string_view sign) { return path.find(sign) != path.npos; });
}

/// What is wrong with the last frame; empty if nothing is.
std::string faults_of_frame(Person& person, const render::PixelSize& window) {
    std::string found;
    for (const std::string& text : person.desktop().ui().cut_texts()) {
        found += "cut: '" + text + "'\n";
    }
    std::vector<std::pair<std::string, Rect>> shown;
    for (const auto& [path, seen] : person.desktop().ui().places().all()) {
        const bool is_pane = path.find('/') == path.npos;
        if (seen.visible && !is_pane && !is_sign(path) && pane_of(path) != "splitters") {
            shown.emplace_back(path, seen.rect);
        }
        const bool scrolls = pane_of(path) != "dialogs"; // down, in its pane
        const bool beyond = seen.rect.right() > static_cast<float>(window.width) + 1.0F ||
                            (!scrolls && seen.rect.bottom() > static_cast<float>(window.height) + 1.0F);
        if (seen.visible && beyond && !is_sign(path)) {
            found += "beyond the window: " + path + "\n";
        }
    }
    for (std::size_t i = 0; i < shown.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const auto& [a, of_a] = shown[i];
            const auto& [b, of_b] = shown[k];
            const bool apart = pane_of(a) != pane_of(b) || !overlap(of_a, of_b);
            if (!apart && !inside(of_a, of_b) && !inside(of_b, of_a)) {
                found += "over each other: " + a + ", " + b + "\n";
            }
        }
    }
    return found;
}

class Monitors : public ::testing::TestWithParam<Monitor> {
protected:
    Person person{GetParam().size, GetParam().scale};

    void look(const std::string& where) {
        person.frames(3);
        EXPECT_EQ(faults_of_frame(person, GetParam().size), "") << where;
        person.keep(std::string(GetParam().name) + "-" + where);
    }

    /// Those that are closed at first.
    void open_sections() {
        constexpr std::array<std::string_view, 6> closed{
            "/reading", "/size", "/roughing", "/frame", "/serial", "/set_up_search"};
        std::vector<std::string> found;
        for (const auto& [path, seen] : person.desktop().ui().places().all()) {
            if (std::ranges::any_of(closed, [&](std::string_view end) { return path.ends_with(end); }) &&
                path.starts_with("inspector/")) {
                found.push_back(path);
            }
        }
        for (const std::string& section : found) {
            person.click(section);
        }
    }

    /// By their buttons, or from the list of those that have no room.
    void look_at_lower_tabs(const std::string& where) {
        std::vector<std::string> tabs;
        const std::string own = "lower/tabs/";
        const bool more = person.sees(own + "more");
        if (more) {
            person.click(own + "more");
            person.frames(2);
        }
        for (const auto& [path, seen] : person.desktop().ui().places().all()) {
            if (path.starts_with(own) && path != own + "more") {
                tabs.push_back(path);
            }
        }
        if (more) {
            person.press_key(render::Key::escape);
        }
        for (const std::string& tab : tabs) {
            if (!person.sees(tab)) {
                person.click(own + "more");
                person.frames(2);
            }
            person.click(tab);
            look(where + "-" + tab.substr(own.size()));
        }
    }

    void look_everywhere() {
        for (const std::string_view workspace : every_workspace) {
            person.app().run("view." + std::string(workspace));
            person.frames(3);
            open_sections();
            look(std::string(workspace));
            look_at_lower_tabs(std::string(workspace));
        }
    }
};

TEST_P(Monitors, ShowEveryWorkspaceAndAllItsTabs) {
    look_everywhere();
}

TEST_P(Monitors, ShowTwoResultsSideBySide) {
    person.app().run("view.toolpath");
    person.frames(3);
    person.choose("inspector/error/beside", "uniform");
    look("beside");
}

TEST_P(Monitors, ShowAProgramAPlotAndAMachine) {
    person.app().receive({"assets/samples/plot/hatched-sign.plt"});
    person.wait_idle();
    person.wait_idle();
    open_sections();
    look("plot-opened");
    person.app().run("view.program");
    person.open("assets/samples/thesis-path.ngc");
    look("program-opened");
    test::GrblBench grbl;
    test::connect(person, grbl);
    look("machine-connected");
    look_at_lower_tabs("machine-connected");
}

TEST_P(Monitors, ShowEveryMenuWhole) {
    for (const char* workspace : {"design", "machine", "processor", "plot", "arm"}) {
        person.app().run(std::string("view.") + workspace);
        person.frames(3);
        const std::vector<std::string> behind(person.desktop().ui().cut_texts().begin(),
                                              person.desktop().ui().cut_texts().end());
        for (const char* menu :
             {"file", "edit", "view", "grid", "machine", "processor", "plot", "arm", "help"}) {
            const std::string path = std::string("menu/") + menu;
            if (!person.sees(path)) {
                continue;
            }
            person.click(path);
            person.frames(3);
            float lowest = 0.0F;
            for (const auto& [item, seen] : person.desktop().ui().places().all()) {
                if (item.starts_with(path + "/")) {
                    EXPECT_TRUE(seen.visible) << item;
                    lowest = std::max(lowest, seen.rect.bottom());
                }
            }
            EXPECT_LE(lowest, static_cast<float>(GetParam().size.height)) << workspace << " " << menu;
            const auto cut = person.desktop().ui().cut_texts();
            EXPECT_TRUE(std::ranges::equal(cut, behind))
                << workspace << " " << menu << ": " << (cut.empty() ? std::string() : cut.back());
            person.keep(std::string(GetParam().name) + "-menu-" + workspace + "-" + menu);
            person.press_key(render::Key::escape);
            person.frames(2);
        }
    }
}

TEST_P(Monitors, ShowTheDialogs) {
    person.press_key(render::Key::o, true);
    look("dialog-open");
    person.press_key(render::Key::escape);
    for (const char* action : {"file.save_as", "view.colors", "help.keys", "help.about", "view.search"}) {
        person.app().run(action);
        look(std::string("dialog-") + action);
        person.press_key(render::Key::escape);
        person.frames(2);
    }
}

/// Names of places in the view lie under no button of it, from wherever it is seen.
TEST_P(Monitors, KeepLabelsOffTheButtonsOfTheView) {
    using render::Key;
    person.app().run("view.toolpath");
    person.frames(3);
    for (const Key side : {Key::digit_0, Key::digit_1, Key::digit_2, Key::digit_3, Key::digit_7}) {
        person.hover(person.place("view").centre());
        person.press_key(side);
        person.frames(3);
        for (const auto& [path, seen] : person.desktop().ui().places().all()) {
            if (!path.starts_with("view/label_")) {
                continue;
            }
            for (const char* fixed : {"view/axes", "view/fit", "view/parallel", "view/four", "view/layers"}) {
                EXPECT_FALSE(overlap(seen.rect, person.place(fixed))) << path << " " << fixed;
            }
        }
    }
    person.keep(std::string(GetParam().name) + "-labels");
}

/// What was fitted has its corners beside the buttons, not below them.
TEST_P(Monitors, FitThePartBesideTheButtonsOfTheView) {
    person.frames(3);
    int seen_points = 0;
    for (const auto& [path, seen] : person.desktop().ui().places().all()) {
        if (path.starts_with("view/control_point(")) {
            ++seen_points;
            EXPECT_LE(seen.rect.centre().x, person.place("view/fit").x) << path;
        }
    }
    EXPECT_GT(seen_points, 0);
}

INSTANTIATE_TEST_SUITE_P(All, Monitors, ::testing::ValuesIn(monitors), [](const auto& monitor) {
    return "of_" + std::string(monitor.param.name);
});

} // namespace
} // namespace millwright::panels
