// The typefaces: Inter for text with figures of equal width, a mono font for listings, Font Awesome for
// icons. A missing file is replaced by the next of its list, at worst by the font built into ImGui, and
// reported.
#pragma once

#include "core/base/error.h"

#include <filesystem>
#include <vector>

struct ImFont;
struct ImFontAtlas;

namespace millwright::widgets {

/// Where to look, best first. The defaults are the fonts in share/millwright/fonts where the program brings
/// its own, else Debian's packages fonts-inter, fonts-dejavu-core, fonts-font-awesome.
struct FontFiles {
    std::vector<std::filesystem::path> text;
    std::vector<std::filesystem::path> strong;
    std::vector<std::filesystem::path> mono;
    std::vector<std::filesystem::path> icons;
};

[[nodiscard]] FontFiles system_fonts();

/// Owned by the atlas; none is null, several may be the same font.
struct Fonts {
    ImFont* text = nullptr;   ///< labels, fields; with icons
    ImFont* strong = nullptr; ///< headers, primary buttons; with icons
    ImFont* small = nullptr;  ///< ticks, captions; with icons
    ImFont* mono = nullptr;   ///< listings
    ImFont* digits = nullptr; ///< big read-outs: figures, signs and units only
};

struct LoadedFonts {
    Fonts fonts;
    std::vector<Diagnostic> diagnostics; ///< one per file that is missing or is not a font
};

/// Clears `atlas` and builds it on the CPU for a monitor of that scale (1 is 96 dpi). The first font is the
/// default one. The caller uploads the picture. Throws Defect if `scale` is not from 0.25 to 8.
[[nodiscard]] LoadedFonts
load_fonts(ImFontAtlas& atlas, float scale, const FontFiles& files = system_fonts());

} // namespace millwright::widgets
