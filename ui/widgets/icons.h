// The icons we use, by meaning: strings of one character of Font Awesome 4.7 (package fonts-font-awesome).
#pragma once

#include <array>

namespace millwright::widgets::icons {

inline constexpr const char* add = "\uf067";
inline constexpr const char* arm = "\uf1b2";
inline constexpr const char* back = "\uf060";
inline constexpr const char* cancel = "\uf00d";
inline constexpr const char* check = "\uf00c";
inline constexpr const char* chevron_down = "\uf078";
inline constexpr const char* chevron_right = "\uf054";
inline constexpr const char* chevron_up = "\uf077";
inline constexpr const char* copy = "\uf0c5";
inline constexpr const char* danger = "\uf06a";
inline constexpr const char* design = "\uf040";
inline constexpr const char* download = "\uf019";
inline constexpr const char* error_map = "\uf043";
inline constexpr const char* eye = "\uf06e";
inline constexpr const char* eye_off = "\uf070";
inline constexpr const char* file = "\uf016";
inline constexpr const char* fit_view = "\uf065";
inline constexpr const char* folder = "\uf115";
inline constexpr const char* forward = "\uf061";
inline constexpr const char* grid = "\uf00a";
inline constexpr const char* help = "\uf059";
inline constexpr const char* hold = "\uf256";
inline constexpr const char* home = "\uf015";
inline constexpr const char* info = "\uf05a";
inline constexpr const char* keyboard = "\uf11c";
inline constexpr const char* layers = "\uf0db";
inline constexpr const char* lock = "\uf023";
inline constexpr const char* machine = "\uf085";
inline constexpr const char* menu = "\uf0c9";
inline constexpr const char* minus = "\uf068";
inline constexpr const char* moon = "\uf186";
inline constexpr const char* pause = "\uf04c";
inline constexpr const char* play = "\uf04b";
inline constexpr const char* plot = "\uf201";
inline constexpr const char* plug = "\uf1e6";
inline constexpr const char* processor = "\uf2db";
inline constexpr const char* program = "\uf0f6";
inline constexpr const char* projection = "\uf1b2";
inline constexpr const char* redo = "\uf01e";
inline constexpr const char* remove = "\uf014";
inline constexpr const char* reset = "\uf0e2";
inline constexpr const char* save = "\uf0c7";
inline constexpr const char* search = "\uf002";
inline constexpr const char* settings = "\uf013";
inline constexpr const char* skip_first = "\uf049";
inline constexpr const char* skip_last = "\uf050";
inline constexpr const char* step_back = "\uf048";
inline constexpr const char* step_forward = "\uf051";
inline constexpr const char* stop = "\uf04d";
inline constexpr const char* sun = "\uf185";
inline constexpr const char* surface = "\uf279";
inline constexpr const char* table = "\uf0ce";
inline constexpr const char* timer = "\uf017";
inline constexpr const char* toolpath = "\uf1de";
inline constexpr const char* undo = "\uf0e2";
inline constexpr const char* unlock = "\uf09c";
inline constexpr const char* warning = "\uf071";

/// What load_fonts takes from the icon font; an icon that is not here is drawn as a question mark.
inline constexpr std::array all{
    add,      arm,     back,     cancel,     check,     chevron_down, chevron_right, chevron_up,
    copy,     danger,  design,   download,   error_map, eye,          eye_off,       file,
    fit_view, folder,  forward,  grid,       help,      hold,         home,          info,
    keyboard, layers,  lock,     machine,    menu,      minus,        moon,          pause,
    play,     plot,    plug,     processor,  program,   redo,         remove,        reset,
    save,     search,  settings, skip_first, skip_last, step_back,    step_forward,  stop,
    sun,      surface, table,    timer,      toolpath,  undo,         unlock,        warning};

} // namespace millwright::widgets::icons
