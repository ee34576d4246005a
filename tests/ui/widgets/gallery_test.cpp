// Looks at every widget at once: nothing is cut off, and the pictures are left for people in the build
// folder.
#include "tests/ui/widgets/gallery.h"

#include "core/base/files.h"
#include "tests/ui/stage/stage.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::widgets {
namespace {

struct Case {
    std::string name;
    test::Screen screen;
    enum { calm, searching, refused, choosing, asking } state = calm;
};

class GalleryPicture : public testing::TestWithParam<Case> {};

TEST_P(GalleryPicture, CutsNoTextOff) {
    const Case& now = GetParam();
    test::Gallery gallery;
    test::Stage stage([&](Ui& ui) { gallery.draw(ui); }, now.screen);
    if (now.state == Case::searching) {
        gallery.search.open();
    }
    stage.frames(3);
    if (now.state == Case::refused) {
        stage.fill_in("inspector/radius", "1/0");
    } else if (now.state == Case::choosing) {
        stage.click("inspector/method");
        stage.frames(2);
        stage.move(stage.place("inspector/method/elliptic").centre());
    } else if (now.state == Case::asking) {
        stage.click("bar/File");
        stage.frames(2);
        stage.move(stage.place("time/timeline/track").centre());
    }
    for (const std::string& text : stage.ui().cut_texts()) {
        ADD_FAILURE() << "cut off: " << text;
    }
    const std::filesystem::path folder = MILLWRIGHT_PICTURES;
    make_folder(folder);
    stage.save_picture(folder / (now.name + ".png"));
}

INSTANTIATE_TEST_SUITE_P(
    Look,
    GalleryPicture,
    testing::Values(
        Case{"gallery_dark", {.width = 1280, .height = 800}},
        Case{"gallery_light", {.width = 1280, .height = 800, .theme = Theme::light}},
        Case{"gallery_search", {.width = 1280, .height = 800}, Case::searching},
        Case{"gallery_refused", {.width = 1280, .height = 800, .theme = Theme::light}, Case::refused},
        Case{"gallery_choice", {.width = 1280, .height = 800}, Case::choosing},
        Case{"gallery_menu", {.width = 1280, .height = 800, .theme = Theme::light}, Case::asking},
        Case{"gallery_scaled", {.width = 1920, .height = 1200, .scale = 1.5F, .theme = Theme::light}}),
    [](const auto& one) { return one.param.name; });

} // namespace
} // namespace millwright::widgets
