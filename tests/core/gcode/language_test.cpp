#include "core/gcode/language.h"

#include "core/base/files.h"
#include "tests/core/gcode/read_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace millwright::gcode {
namespace {

using ::testing::HasSubstr;

TEST(Language, IsKnownByALine) {
    for (const char* line : {"0 BEGIN PGM PART MM",
                             "12 TOOL CALL 1 Z S8000",
                             "7 L X+10 Y-2.5 R0 FMAX",
                             "8 CC X+0 Y+0",
                             "BLK FORM 0.1 Z X+0 Y+0 Z-20",
                             "33 CALL LBL 1 REP 4"}) {
        EXPECT_EQ(language_of_line(line), Language::klartext) << line;
    }
    for (const char* line : {"IF [#1 GT 10] GOTO 90",
                             "N50 IF[#100EQ#0]THEN #101=3",
                             "WHILE [#1 LE 10] DO1",
                             "END1",
                             "GOTO 100",
                             "G65 P9010 A1. B2.",
                             "DPRNT[X#1[44]]"}) {
        EXPECT_EQ(language_of_line(line), Language::fanuc_macro) << line;
    }
    for (const char* line : {"N10 R1=25.5",
                             "G1 X=R1 Y=R2+5 F1000",
                             "DEF REAL DEPTH",
                             "MSG(\"roughing\")",
                             "CYCLE800(1,\"\",0,57,0,0,0,0,0,0,0,0,0,-1)",
                             "N30 G0 SUPA Z0 D0",
                             "T=\"MILL_10\"",
                             "G3 X10 Y5 CR=12",
                             "GOTOF ENDE",
                             "N10 G90 G17 G710",
                             "G505 G0 X0",
                             "%_N_PART_MPF"}) {
        EXPECT_EQ(language_of_line(line), Language::sinumerik) << line;
    }
    for (const char* line : {"VC1=5", "G0 X=VC1", "IF[VC1 EQ 5]N100", "VZOFZ[1]=0", "VS1=VC2+1"}) {
        EXPECT_EQ(language_of_line(line), Language::okuma) << line;
    }
    for (const char* line : {"IN;SP1;PU0,0;PD100,0;",
                             "PU0,0;",
                             "INSP1PU0,0PD100,0",
                             "PA -10,20",
                             "\x1B.(",
                             "IN",
                             "@PJL SET RESOLUTION=300",
                             "\x1B%-12345X@PJL JOB NAME=A",
                             "CO\"R=5\";IN;SP1;"}) {
        EXPECT_EQ(language_of_line(line), Language::hpgl) << line;
    }
    for (const char* line : {"G1 X10.2 Y3 E0.0432", "G92 E0", "M109 S210", "M82 ;absolute extrusion"}) {
        EXPECT_EQ(language_of_line(line), Language::printer) << line;
    }
}

TEST(Language, FilesThatAreNoProgramsAreKnownByALine) {
    for (const char* line : {"<?xml version=\"1.0\"?>",
                             "\xEF\xBB\xBF<svg width=\"10mm\" x=\"1\">",
                             "  <path d=\"M0 0\"/>",
                             "<!DOCTYPE html>",
                             "</g>"}) {
        EXPECT_EQ(language_of_line(line), Language::xml) << line;
    }
    EXPECT_EQ(language_of_line("solid part"), Language::mesh);
    EXPECT_EQ(language_of_line("  facet normal 0 0 1"), Language::mesh);
    EXPECT_EQ(language_of_line("ISO-10303-21;"), Language::step);
    EXPECT_EQ(language_of_line("SECTION"), Language::dxf);
    EXPECT_EQ(language_of_line("{\"format\": 1, \"R1\"=5"), Language::json);
    EXPECT_EQ(language_of_line("%PDF-1.4"), Language::document);
    EXPECT_EQ(language_of_line("%!PS-Adobe-3.0"), Language::document);
    EXPECT_EQ(language_of_line("<"), std::nullopt);
    EXPECT_EQ(language_of_line("< 5"), std::nullopt);
}

TEST(Language, OfALaterLineIsNamedInPlaceOfWhatIsWrongBefore) {
    ReaderSettings settings;
    settings.most_errors = 100;
    const auto refusal = [&](const std::string& text) {
        const test::ReadProgram read = test::read_all(text, settings);
        EXPECT_EQ(read.errors.size(), 1U) << text;
        return read.errors.empty() ? std::string() : to_text(read.errors.front());
    };
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl}) {
        settings.dialect = dialect;
        EXPECT_THAT(refusal("N10 G71 G90\nN20 R1=5\nN30 G1 X=R1 F100\nM30\n"),
                    HasSubstr(":2:1: this is the Siemens Sinumerik language, not G-code"));
        EXPECT_THAT(refusal("%\nO1000\n#1=0\nWHILE [#1 LT 3] DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n%\n"),
                    HasSubstr(":4:1: this is Fanuc custom macro B, not G-code"));
        EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<svg width=\"10mm\"/>\n"),
                    HasSubstr(":1:1: this is an XML file (an SVG drawing is one), not G-code"));
        EXPECT_THAT(refusal("  0\nSECTION\n  2\nHEADER\n"), HasSubstr(":2:1: this is a DXF drawing"));
    }
    // A program with a fault of its own, and words behind it that G-code has, too.
    settings.dialect = Dialect::linuxcnc;
    EXPECT_THAT(refusal("G21 G90\nG1 X1 F\nM106\nM2\n"), HasSubstr(":2:"));
    EXPECT_THAT(refusal("G21 G71\nG1 X1 F100\n(WHILE R1=5)\nM2\n"), HasSubstr("G71 is not supported"));
}

TEST(Language, LinesOfGcodeShowNone) {
    for (const char* line : {"G1 X10 Y-2 F300",
                             "N10 #1=[#2+3] #<depth>=4",
                             "o1 if [#1 GT 10]",
                             "o<sub> call [1] [2]",
                             "o1 while [#1 LT 3]",
                             "G1 X1e5",
                             "G1 X1E5",
                             "(IF you see this: GOTO 10, R1=5)",
                             "; M104 S200",
                             "G2 X1 Y1 R5",
                             "M2",
                             "INSERT THE TOOL",
                             "SPINDLE ON",
                             "N5 G54 G17 G64 P0.05",
                             "%",
                             "",
                             "T1 M6"}) {
        EXPECT_EQ(language_of_line(line), std::nullopt) << line;
    }
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator("assets/samples/gcode")) {
        if (entry.path().extension() == ".ngc") {
            EXPECT_EQ(language_of(read_file(entry.path())), std::nullopt) << entry.path();
            ++files;
        }
    }
    EXPECT_GT(files, 25);
}

TEST(Language, AProgramIsRefusedInOneLine) {
    ReaderSettings settings;
    settings.most_errors = 100;
    settings.read_on = true;
    const auto refusal = [&](const std::string& text) {
        const test::ReadProgram read = test::read_all(text, settings);
        EXPECT_EQ(read.errors.size(), 1U) << text;
        return read.errors.empty() ? std::string() : to_text(read.errors.front());
    };
    EXPECT_THAT(refusal("G21 G90\nN20 R1=5\nN30 G1 X=R1 F100\nN40 MSG(\"x\")\nM30\n"),
                HasSubstr(":2:1: this is the Siemens Sinumerik language, not G-code (post-process the part"));
    EXPECT_THAT(refusal("0 BEGIN PGM A MM\n1 L X+1 R0 FMAX\n2 END PGM A MM\n"),
                HasSubstr(":1:1: this is Heidenhain Klartext"));
    EXPECT_THAT(refusal("#1=0\nWHILE [#1 LT 3] DO1\nG0 X#1\n#1=#1+1\nEND1\nM30\n"),
                HasSubstr(":2:1: this is Fanuc custom macro B"));
    EXPECT_THAT(refusal("N10 G90 G17 G710\nN20 T=\"MILL\" D1\nN50 M30\n"),
                HasSubstr(":1:1: this is the Siemens Sinumerik language"));
    EXPECT_THAT(refusal("G15 H1\nVC1=5\nG0 X=VC1\nM2\n"),
                HasSubstr("this is the language of Okuma OSP controls"));
    EXPECT_THAT(refusal("IN;SP1;PU0,0;PD100,0;\n"), HasSubstr(":1:1: this is HPGL, a plot, not G-code"));
    settings.dialect = Dialect::grbl;
    EXPECT_THAT(refusal("IN;SP1;PU0,0;PD100,0;\n"), HasSubstr(":1:1: this is HPGL, a plot, not G-code"));
    settings.dialect = Dialect::linuxcnc;
    EXPECT_THAT(refusal("G21\nG1 X1 Y2 E0.5 F100\nG1 X2 E0.7\nM84\n"),
                HasSubstr(":2:1: this is a program for a 3D"));
}

} // namespace
} // namespace millwright::gcode
