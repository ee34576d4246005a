#include "tests/ui/viewport/scenes.h"
#include "tests/ui/viewport/studio.h"

namespace millwright::viewport {
namespace {

using render::Picture;

class Look : public test::Studio {
protected:
    Look() : Studio({1280, 800}) {}
};

TEST_F(Look, AtEverything) {
    for (const auto& part :
         {test::Part{"dome", "rotary-tilt-listing", 20}, test::Part{"two-bell", "ac-table", 20}}) {
        for (int k = 0; k < view_kind_count; ++k) {
            const auto kind = static_cast<ViewKind>(k);
            Scene scene = test::scene_of(part, kind);
            if (kind == ViewKind::machine || kind == ViewKind::toolpath) {
                scene.now = test::half_way(scene);
            }
            keep(picture(scene, look_at(scene)), part.preset + "-" + std::string(id(kind)));
        }
    }
}

} // namespace
} // namespace millwright::viewport
