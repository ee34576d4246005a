#include "ui/widgets/fonts.h"

#include "core/base/files.h"
#include "core/base/program_files.h"
#include "ui/widgets/icons.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include <imgui.h>
#include <imgui_freetype.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace millwright::widgets {

namespace fs = std::filesystem;

namespace {

// From the highest ascender to the lowest descender, as ImGui counts: 17 gives letters of a 14 px font.
constexpr float text_px = 17.0F;
constexpr float small_px = 14.0F;
constexpr float mono_px = 16.0F;
constexpr float digits_px = 30.0F;

// Latin, Greek, Cyrillic, Vietnamese; dashes, quotes, powers, arrows, signs of mathematics. Pairs, ended by
// 0.
constexpr ImWchar text_ranges[] = {0x0020,
                                   0x024F,
                                   0x0370,
                                   0x052F,
                                   0x1E00,
                                   0x1EFF,
                                   0x2010,
                                   0x203A,
                                   0x2070,
                                   0x209C,
                                   0x20AC,
                                   0x20AC,
                                   0x2190,
                                   0x21BA,
                                   0x2200,
                                   0x226F,
                                   0x25A0,
                                   0x25FF,
                                   0};
constexpr ImWchar latin_ranges[] = {
    0x0020, 0x017F, 0x0391, 0x03C9, 0x2013, 0x2026, 0x2190, 0x2193, 0x2212, 0x2212, 0x2264, 0x2265, 0};
constexpr ImWchar digit_ranges[] = {0x0020, 0x007E, 0x00B0, 0x00B0, 0x2212, 0x2212, 0};

bool is_font(const std::string& bytes) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) {
        return false;
    }
    FT_Face face = nullptr;
    const auto size = static_cast<FT_Long>(bytes.size());
    const bool opened =
        FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(bytes.data()), size, 0, &face) == 0;
    FT_Done_FreeType(library); // closes the face too
    return opened;
}

/// Adds the first usable file of a list to the atlas and remembers what was wrong with the ones before it.
/// ImGui keeps the pointers to its ranges, so this lives until the atlas is built.
class Loader {
public:
    Loader(ImFontAtlas& atlas, float scale) : atlas_(atlas), scale_(scale) {
        ImFontGlyphRangesBuilder used;
        for (const char* icon : icons::all) {
            used.AddText(icon);
        }
        used.BuildRanges(&icon_ranges_);
    }

    /// Null when no file of the list is a font.
    ImFont* first_of(const std::vector<fs::path>& files,
                     float px,
                     const ImWchar* ranges,
                     const ImFontConfig& like = {}) {
        for (const fs::path& file : files) {
            if (readable(file)) {
                ImFontConfig config = like;
                config.OversampleH = config.OversampleV = 1;
                config.PixelSnapH = true;
                return atlas_.AddFontFromFileTTF(file.c_str(), std::round(px * scale_), &config, ranges);
            }
        }
        return nullptr;
    }

    /// The same; ImGui's own font when there is none.
    ImFont* font(const std::vector<fs::path>& files, float px, const ImWchar* ranges) {
        ImFont* found = first_of(files, px, ranges);
        if (found == nullptr) {
            ImFontConfig config;
            config.SizePixels = std::round(px * scale_);
            found = atlas_.AddFontDefault(&config);
        }
        return found;
    }

    void merge_icons(const std::vector<fs::path>& files, float px) {
        ImFontConfig config;
        config.MergeMode = true;
        config.GlyphMinAdvanceX = std::round(1.15F * px * scale_); // icons of one width keep labels aligned
        config.GlyphOffset.y = std::round(0.04F * px * scale_);
        first_of(files, 0.95F * px, icon_ranges_.Data, config);
    }

    [[nodiscard]] std::vector<Diagnostic> diagnostics() { return std::move(diagnostics_); }

private:
    /// ImGui gives up the whole atlas on a file that is not a font, so each is tried before.
    bool readable(const fs::path& file) {
        const auto is_reported = [&](const Diagnostic& d) { return d.place.file == file; };
        if (std::any_of(diagnostics_.begin(), diagnostics_.end(), is_reported)) {
            return false;
        }
        try {
            if (is_font(read_file(file))) {
                return true;
            }
            report(file, "not a font");
        } catch (const Error& error) {
            report(file, error.diagnostic().message);
        }
        return false;
    }

    void report(const fs::path& file, std::string_view what) {
        diagnostics_.push_back(
            {.place = {.file = file},
             .message = "font: " + std::string(what),
             .hint =
                 "a substitute font is used; install fonts-inter, fonts-dejavu-core and fonts-font-awesome"});
    }

    ImFontAtlas& atlas_;
    float scale_;
    ImVector<ImWchar> icon_ranges_;
    std::vector<Diagnostic> diagnostics_;
};

/// Gives 0 to 9 the advance of the widest of them, each figure in the middle of it, so that numbers do not
/// wobble and columns line up. (Inter has such figures as an OpenType feature, which ImGui cannot ask for.)
void make_figures_tabular(ImFont& font) {
    float widest = 0.0F;
    for (ImWchar c = '0'; c <= '9'; ++c) {
        widest = std::max(widest, font.GetCharAdvance(c));
    }
    for (ImFontGlyph& glyph : font.Glyphs) {
        if (glyph.Codepoint >= '0' && glyph.Codepoint <= '9') {
            const float shift = std::round(0.5F * (widest - glyph.AdvanceX));
            glyph.X0 += shift;
            glyph.X1 += shift;
            glyph.AdvanceX = widest;
        }
    }
    font.BuildLookupTable();
}

/// What is left when the atlas fails although each file was a font.
Fonts built_in_font(ImFontAtlas& atlas) {
    atlas.Clear();
    atlas.FontBuilderIO = nullptr;
    ImFont* font = atlas.AddFontDefault();
    atlas.Build();
    return {font, font, font, font, font};
}

} // namespace

FontFiles system_fonts() {
    const fs::path fonts = find_above(executable(), {"share/millwright/fonts"}).value_or("/usr/share/fonts");
    const fs::path inter = fonts / "opentype/inter";
    const fs::path dejavu = fonts / "truetype/dejavu";
    return {.text = {inter / "Inter-Regular.otf", dejavu / "DejaVuSans.ttf"},
            .strong = {inter / "Inter-SemiBold.otf", dejavu / "DejaVuSans-Bold.ttf"},
            .mono = {dejavu / "DejaVuSansMono.ttf"},
            .icons = {fonts / "truetype/font-awesome/fontawesome-webfont.ttf"}};
}

LoadedFonts load_fonts(ImFontAtlas& atlas, float scale, const FontFiles& files) {
    expects(scale >= 0.25F && scale <= 8.0F, "the scale of a monitor is from 0.25 to 8");
    atlas.Clear();
    atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;

    Loader loader(atlas, scale);
    Fonts fonts;
    fonts.text = loader.font(files.text, text_px, text_ranges);
    loader.merge_icons(files.icons, text_px);
    fonts.strong = loader.font(files.strong, text_px, latin_ranges);
    loader.merge_icons(files.icons, text_px);
    fonts.small = loader.font(files.text, small_px, latin_ranges);
    loader.merge_icons(files.icons, small_px);
    fonts.mono = loader.font(files.mono, mono_px, latin_ranges);
    fonts.digits = loader.font(files.text, digits_px, digit_ranges);

    std::vector<Diagnostic> diagnostics = loader.diagnostics();
    if (!atlas.Build()) {
        diagnostics.push_back(
            {.place = {}, .message = "font: no font atlas can be built from these fonts", .hint = {}});
        return {built_in_font(atlas), std::move(diagnostics)};
    }
    for (ImFont* font : {fonts.text, fonts.strong, fonts.small, fonts.digits}) {
        make_figures_tabular(*font);
    }
    return {fonts, std::move(diagnostics)};
}

} // namespace millwright::widgets
