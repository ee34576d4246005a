#include "ui/widgets/theme.h"

#include "core/base/error.h"
#include "tests/ui/stage/stage.h"
#include "ui/widgets/fonts.h"
#include "ui/widgets/icons.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace millwright::widgets {
namespace {

/// Relative luminance and contrast as WCAG 2.1 defines them.
double luminance(Colour colour) {
    const auto linear = [colour](unsigned shift) {
        const double c = (colour >> shift & 0xFFU) / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(0) + 0.7152 * linear(8) + 0.0722 * linear(16);
}

double contrast(Colour a, Colour b) {
    const auto [dark, bright] = std::minmax({luminance(a), luminance(b)});
    return (bright + 0.05) / (dark + 0.05);
}

class EachTheme : public testing::TestWithParam<Theme> {};

TEST_P(EachTheme, TextCanBeReadOnEveryGround) {
    const Palette& p = palette(GetParam());
    for (const Colour ground : {p.pane, p.raised, p.field, p.hover, p.selection, p.window}) {
        EXPECT_GE(contrast(p.text, ground), 7.0) << std::hex << ground;
    }
    for (const Colour ground : {p.pane, p.field, p.raised}) {
        EXPECT_GE(contrast(p.muted, ground), 4.5) << std::hex << ground;
    }
    EXPECT_GE(contrast(p.on_accent, p.accent), 4.5);
    EXPECT_GE(contrast(p.on_danger, p.danger), 4.5);
    for (const Colour words : {p.danger, p.warning, p.good, p.accent}) {
        EXPECT_GE(contrast(words, p.pane), 4.5) << std::hex << words;
    }
}

TEST_P(EachTheme, LinesOfAPlotCanBeSeenOnItsGround) {
    const Palette& p = palette(GetParam());
    for (const Colour line : p.series) {
        EXPECT_GE(contrast(line, p.field), 3.0) << std::hex << line;
    }
}

/// CIE L*a*b* of an opaque colour.
std::array<double, 3> lab_of(Colour colour) {
    std::array<double, 3> linear{};
    for (unsigned k = 0; k < 3; ++k) {
        const double c = (colour >> (8 * k) & 0xFFU) / 255.0;
        linear[k] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    const auto [r, g, b] = linear;
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
    const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.95047);
    const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
    const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.08883);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

TEST_P(EachTheme, NoTwoLinesOfAPlotHaveNearlyTheSameColour) {
    const Palette& p = palette(GetParam());
    for (std::size_t i = 0; i < std::size(p.series); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const auto a = lab_of(p.series[i]), b = lab_of(p.series[k]);
            EXPECT_GE(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 20.0) << i << ", " << k;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Theme, EachTheme, testing::Values(Theme::dark, Theme::light));

TEST(Theme, ColoursArePackedAsImGuiPacksThem) {
    EXPECT_EQ(rgb(0x102030), IM_COL32(0x10, 0x20, 0x30, 0xFF));
    EXPECT_EQ(faded(rgb(0x102030), 0.5) >> 24U, 128U);
    EXPECT_EQ(mixed(rgb(0x000000), rgb(0xFFFFFF), 0.5), rgb(0x808080));
}

class FontAtlas : public testing::Test {
protected:
    ImFontAtlas atlas;
};

TEST_F(FontAtlas, FiguresHaveOneWidth) {
    const LoadedFonts loaded = load_fonts(atlas, 1.0F);
    EXPECT_TRUE(loaded.diagnostics.empty());
    for (const ImFont* font : {loaded.fonts.text, loaded.fonts.strong, loaded.fonts.digits}) {
        for (ImWchar c = '1'; c <= '9'; ++c) {
            EXPECT_FLOAT_EQ(font->GetCharAdvance(c), font->GetCharAdvance('0'));
        }
    }
}

TEST_F(FontAtlas, EveryIconHasAGlyphOfItsOwn) {
    const LoadedFonts loaded = load_fonts(atlas, 1.0F);
    for (const char* icon : icons::all) {
        const auto byte = [icon](int i) {
            return static_cast<unsigned>(static_cast<unsigned char>(icon[i]));
        };
        const unsigned code = (byte(0) & 0x0FU) << 12U | (byte(1) & 0x3FU) << 6U | (byte(2) & 0x3FU);
        for (const ImFont* font : {loaded.fonts.text, loaded.fonts.strong, loaded.fonts.small}) {
            EXPECT_NE(font->FindGlyphNoFallback(static_cast<ImWchar>(code)), nullptr) << std::hex << code;
        }
    }
}

TEST_F(FontAtlas, AMissingFileFallsBackAndIsReportedOnce) {
    FontFiles files = system_fonts();
    files.text.insert(files.text.begin(), "/nowhere/Missing.otf");
    const LoadedFonts loaded = load_fonts(atlas, 1.0F, files);
    ASSERT_NE(loaded.fonts.text, nullptr);
    ASSERT_EQ(std::ssize(loaded.diagnostics), 1);
    EXPECT_EQ(loaded.diagnostics[0].place.file, "/nowhere/Missing.otf");
}

TEST_F(FontAtlas, WithNoFontAtAllTheBuiltInOneIsUsed) {
    const LoadedFonts loaded = load_fonts(atlas, 1.0F, FontFiles{});
    ASSERT_NE(loaded.fonts.digits, nullptr);
    EXPECT_TRUE(atlas.IsBuilt());
}

TEST_F(FontAtlas, AFileThatIsNoFontIsReported) {
    const std::filesystem::path file = testing::TempDir() + "millwright_no_font.otf";
    std::ofstream(file) << "OTTO, but not really";
    FontFiles files = system_fonts();
    files.mono = {file};
    const LoadedFonts loaded = load_fonts(atlas, 2.0F, files);
    ASSERT_NE(loaded.fonts.mono, nullptr);
    ASSERT_EQ(std::ssize(loaded.diagnostics), 1);
    EXPECT_EQ(loaded.diagnostics[0].message, "font: not a font");
    std::filesystem::remove(file);
}

TEST_F(FontAtlas, AnAbsurdScaleIsADefect) {
    EXPECT_THROW(static_cast<void>(load_fonts(atlas, 0.0F)), Defect);
}

} // namespace
} // namespace millwright::widgets
