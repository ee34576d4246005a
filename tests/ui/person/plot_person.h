// A person at the Plot & Picture workspace who has dropped a file on the window.
#pragma once

#include "tests/support/scratch_folder.h"
#include "tests/ui/person/person.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>

namespace millwright::test {

struct PlotPerson {
    explicit PlotPerson(const std::filesystem::path& file, const render::PixelSize& screen = {1280, 800})
        : person(screen) {
        std::filesystem::copy_file(file, folder / file.filename());
        drop(folder / file.filename());
    }
    void drop(const std::filesystem::path& file) {
        person.app().receive({file}); // as the window does it for what is dropped on it
        settle();
    }
    /// Until everything is derived and looked at: the program of a plot is read when the plot is finished,
    /// and a view that changes is drawn rough.
    void settle() {
        person.wait_idle();
        person.wait_idle();
        person.frames(3);
    }
    [[nodiscard]] actions::PlotWorkspace& plot() { return person.app().plot(); }
    [[nodiscard]] const plan::PlotResult& made() {
        result = plot().latest();
        return *result;
    }
    /// Pixels of the window that are like it.
    [[nodiscard]] int pixels_like(const std::function<bool(int r, int g, int b)>& wanted) {
        const render::Picture picture = person.picture();
        return static_cast<int>(std::ranges::count_if(
            picture.pixels, [&](const render::Pixel& at) { return wanted(at[0], at[1], at[2]); }));
    }

    ScratchFolder folder;
    Person person;
    std::shared_ptr<const plan::PlotResult> result;
};

} // namespace millwright::test
