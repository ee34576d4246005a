#include "ui/render/internal/display_loss.h"

#include <X11/Xlib.h>

namespace millwright::render {

void watch_display() {
    XSetIOErrorHandler([](Display* /*display*/) {
        display_lost();
        return 0;
    });
}

} // namespace millwright::render
