// The end of the connection to an X display, which Xlib tells by one function of the program.
#pragma once

namespace millwright::render {

/// From here on Xlib calls display_lost() when it finds the connection broken.
void watch_display();

/// Called in the middle of whatever talked to the display; the process ends when it returns. Defined beside
/// the window.
void display_lost();

} // namespace millwright::render
