#include "ui/render/internal/display_loss.h"

#include <X11/Xlib.h>

#include <cstdio>

namespace millwright::render {

void watch_display() {
    // As when a window goes away from which something is being dropped: nothing that ends this program.
    XSetErrorHandler([](Display* /*display*/, XErrorEvent* error) {
        const bool gone = error->error_code == BadWindow || error->error_code == BadDrawable;
        if (!gone) {
            std::fprintf(
                stderr, "millwright: X error %d of request %d\n", error->error_code, error->request_code);
        }
        return 0;
    });
    XSetIOErrorHandler([](Display* /*display*/) {
        display_lost();
        return 0;
    });
}

} // namespace millwright::render
