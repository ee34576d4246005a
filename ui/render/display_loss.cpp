#include "ui/render/internal/display_loss.h"

#include <X11/Xlib.h>

namespace millwright::render {

void watch_display() {
    // As when a window goes away from which something is being dropped: nothing that ends this program.
    XSetErrorHandler([](Display* /*display*/, XErrorEvent* /*error*/) { return 0; });
    XSetIOErrorHandler([](Display* /*display*/) {
        display_lost();
        return 0;
    });
}

} // namespace millwright::render
