// The dome in the Grid workspace, from above: for what a person does on the surface.
#pragma once

#include "tests/ui/person/person.h"

#include <gtest/gtest.h>

namespace millwright::test {

class DomeFromAbove : public testing::Test {
protected:
    DomeFromAbove() {
        person_.open("assets/projects/dome.json");
        person_.app().edit("Change the grid",
                           [](project::Project& p) {
                               p.grid.nu = 9;
                               p.grid.nv = 9;
                           },
                           {});
        person_.press_key(render::Key::f3);
        person_.wait_idle();
        person_.press_key(render::Key::digit_2); // from the top
        person_.wait_idle();
    }

    /// Shares of the view.
    [[nodiscard]] widgets::Point at(float x, float y) {
        const widgets::Rect view = person_.place("view");
        return {view.x + x * view.w, view.y + y * view.h};
    }

    Person person_{{1600, 1400}};
};

} // namespace millwright::test
