#include "core/exchange/cad_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/geometry/presets.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <regex>
#include <string>
#include <string_view>

namespace millwright::exchange {
namespace {

using geometry::BezierPatch;
using geometry::ControlNet;
using geometry::PatchId;
using geometry::Surface;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CadFile : public ::testing::Test {
protected:
    void SetUp() override {
        if (!reads_cad_files()) {
            GTEST_SKIP() << "this build has no Open CASCADE";
        }
    }

    [[nodiscard]] CadModel read_text(const std::string& text, const char* name) const {
        write_file(folder_ / name, text);
        return read_cad(folder_ / name, {});
    }

    /// The dome with another unit of length in place of its millimetre, the entity UNIT_HERE.
    [[nodiscard]] std::string dome_in(const std::string& unit) const {
        write_step(geometry::surface_preset("dome").make(), folder_ / "dome.step", {});
        const std::regex millimetre(
            R"((#[0-9]+) = \( LENGTH_UNIT\(\) NAMED_UNIT\(\*\) SI_UNIT\(\.MILLI\.,\.METRE\.\) \);)");
        const std::string named = std::regex_replace(unit, std::regex("UNIT_HERE"), "$$1");
        return std::regex_replace(read_file(folder_ / "dome.step"), millimetre, named);
    }

    [[nodiscard]] std::string refusal(const std::string& text, const char* name) const {
        try {
            (void)read_text(text, name);
        } catch (const Error& error) {
            return error.diagnostic().message;
        }
        return "none";
    }

    test::ScratchFolder folder_;
};

/// A quarter of a cylinder of radius 10 about z, 30 high, exactly.
BezierPatch quarter_cylinder() {
    ControlNet net = ControlNet::sized(3, 2);
    for (int j = 0; j < 2; ++j) {
        net.point(0, j) = {10.0, 0.0, 30.0 * j};
        net.point(1, j) = {10.0, 10.0, 30.0 * j};
        net.point(2, j) = {0.0, 10.0, 30.0 * j};
        net.weight(1, j) = std::numbers::sqrt2 / 2.0;
    }
    return BezierPatch(net);
}

void expect_same(const BezierPatch& a, const BezierPatch& b) {
    ASSERT_EQ(a.degree_u(), b.degree_u());
    ASSERT_EQ(a.degree_v(), b.degree_v());
    for (std::size_t n = 0; n < a.net().points.size(); ++n) {
        EXPECT_LT((a.net().points[n] - b.net().points[n]).norm(), 1e-9) << n;
        EXPECT_NEAR(a.net().weights[n], b.net().weights[n], 1e-12) << n;
    }
}

TEST_F(CadFile, AByteOrderMarkIsSkipped) {
    write_step(geometry::surface_preset("dome").make(), folder_ / "dome.step", {});
    const std::string text = read_file(folder_ / "dome.step");
    const std::string mark = "\xEF\xBB\xBF";
    EXPECT_EQ(read_text(mark + text, "marked.step").faces.size(), read_text(text, "plain.step").faces.size());
}

TEST_F(CadFile, EverySurfaceComesBackAsItWas) {
    for (const auto& known : geometry::surface_presets()) {
        write_step(known.make(), folder_ / "design.step", {});
        const CadModel model = read_cad(folder_ / "design.step", {});
        EXPECT_EQ(model.unit, "mm");
        ASSERT_EQ(model.faces.size(), static_cast<std::size_t>(known.make().patch_count())) << known.id;
        for (std::size_t n = 0; n < model.faces.size(); ++n) {
            const CadFace& face = model.faces[n];
            ASSERT_EQ(face.patches.size(), 1u);
            EXPECT_FALSE(face.trimmed());
            expect_same(face.patches.front(), known.make().patches()[n]);
        }
    }
}

TEST_F(CadFile, RationalPatchesKeepTheirWeights) {
    write_step(Surface({quarter_cylinder()}), folder_ / "cylinder.stp", {});
    const CadModel model = read_cad(folder_ / "cylinder.stp", {});
    ASSERT_EQ(model.faces.size(), 1u);
    ASSERT_EQ(model.faces.front().patches.size(), 1u);
    expect_same(model.faces.front().patches.front(), quarter_cylinder());
}

TEST_F(CadFile, SameSurfaceSameBytes) {
    std::filesystem::create_directory(folder_ / "other");
    write_step(geometry::surface_preset("dome").make(), folder_ / "dome.step", {});
    write_step(geometry::surface_preset("dome").make(), folder_ / "other" / "dome.step", {});
    EXPECT_EQ(read_file(folder_ / "dome.step"), read_file(folder_ / "other" / "dome.step"));
}

/// `side` x `side` domes beside each other.
Surface field_of_domes(int side) {
    std::vector<BezierPatch> patches;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            ControlNet net = geometry::surface_preset("dome").make().patches().front().net();
            for (Vec3& point : net.points) {
                point += Vec3(200.0 * i, 200.0 * j, 0.0);
            }
            patches.emplace_back(net);
        }
    }
    return Surface(std::move(patches));
}

/// Of the faces from `first` on the surface is one that the file does not have.
std::string with_broken_faces(const std::string& text, int first) {
    const std::regex face("(ADVANCED_FACE\\('[^']*',\\([^)]*\\)),#[0-9]+");
    std::string broken;
    auto rest = text.cbegin();
    int count = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), face); at != std::sregex_iterator(); ++at) {
        broken.append(rest, (*at)[0].first);
        broken += count++ < first ? at->str() : at->str(1) + ",#9999999";
        rest = (*at)[0].second;
    }
    return broken.append(rest, text.cend());
}

TEST_F(CadFile, FacesThatTheLibraryLeavesOutAreNamed) {
    write_step(field_of_domes(2), folder_ / "domes.step", {});
    const std::string text = read_file(folder_ / "domes.step");
    const CadModel model = read_text(with_broken_faces(text, 3), "broken.step");
    EXPECT_EQ(model.faces.size(), 3u);
    ASSERT_EQ(model.left_out.size(), 1u);
    EXPECT_THAT(model.left_out.front(),
                HasSubstr("Open CASCADE could not create 1 of 4 faces of the file (#"));
    EXPECT_THAT(refusal(with_broken_faces(text, 0), "all.step"), HasSubstr("could not create 4 of 4 faces"));
    EXPECT_TRUE(read_text(with_broken_faces(text, 4), "whole.step").left_out.empty());
}

std::string conversion(const std::string& name, const std::string& factor, const std::string& rest = "") {
    return fmt::format("UNIT_HERE = ( CONVERSION_BASED_UNIT('{}',#9002) LENGTH_UNIT() NAMED_UNIT(#9001) );\n"
                       "#9001 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
                       "#9002 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),#9003);\n{}",
                       name,
                       factor,
                       rest.empty() ? "#9003 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );"
                                    : rest);
}

double width(const CadModel& model) {
    return model.faces.front().box.sizes().x();
}

TEST_F(CadFile, AUnitThatTheFileConvertsItselfIsTaken) {
    const CadModel model = read_text(dome_in(conversion("CUBIT", "3.5")), "cubit.step");
    EXPECT_NEAR(width(model), 80.0 * 3.5, 1e-6);
    EXPECT_THAT(model.notes, ::testing::IsEmpty());
    EXPECT_EQ(model.unit, "cubit");
}

// It had come in millimetres.
TEST_F(CadFile, AUnitThatIsConvertedInSeveralStepsIsTaken) {
    const std::string inch =
        "#9003 = ( CONVERSION_BASED_UNIT('INCH',#9004) LENGTH_UNIT() NAMED_UNIT(#9001) );\n"
        "#9004 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.54),#9005);\n"
        "#9005 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.CENTI.,.METRE.) );";
    const CadModel model = read_text(dome_in(conversion("HAND", "4.", inch)), "hand.step");
    EXPECT_NEAR(width(model), 80.0 * 4.0 * 25.4, 1e-6);
    EXPECT_EQ(model.unit, "hand");
    EXPECT_THAT(model.notes, ::testing::IsEmpty());
    const std::string circle =
        "#9003 = ( CONVERSION_BASED_UNIT('INCH',#9002) LENGTH_UNIT() NAMED_UNIT(#9001) );";
    EXPECT_THAT(read_text(dome_in(conversion("HAND", "1.", circle)), "circle.step").notes,
                ElementsAre(HasSubstr("its conversions do not lead to a unit")));
}

// They had come as millimetres or metres without a word.
TEST_F(CadFile, AUnitThatIsNotUnderstoodIsToldWithItsPlace) {
    const auto told = [&](const std::string& unit) {
        const CadModel model = read_text(dome_in(unit), "unit.step");
        return fmt::format("{:.0f} mm: {}", width(model), fmt::join(model.notes, "; "));
    };
    EXPECT_EQ(told("UNIT_HERE = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.DECI.,.METRE.) );"), "8000 mm: ");
    EXPECT_EQ(told("UNIT_HERE = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MYRIA.,.METRE.) );"),
              "80000 mm: the unit of length #106 in line 137 cannot be read (Enumeration si_prefix has not "
              "an allowed value): 1000 mm is assumed");
    EXPECT_EQ(
        told("UNIT_HERE = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.GRAM.) );"),
        "80 mm: the unit of length #106 in line 137 cannot be read (it is not a metre): 1 mm is assumed");
    const std::string exponents = "\n#9001 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);";
    EXPECT_EQ(
        told("UNIT_HERE = ( CONVERSION_BASED_UNIT('CUBIT',$) LENGTH_UNIT() NAMED_UNIT(#9001) );" + exponents),
        "80 mm: the unit of length #106 in line 137 cannot be read (it has no factor): 1 mm is assumed");
    EXPECT_EQ(
        told("UNIT_HERE = ( CONTEXT_DEPENDENT_UNIT('CUBIT') LENGTH_UNIT() NAMED_UNIT(#9001) );" + exponents),
        "80 mm: #105 in line 133 has no unit of length that can be read: mm is assumed");
    EXPECT_EQ(told(""), "80 mm: #105 in line 133 has no unit of length that can be read: mm is assumed");
}

// An assembly has a context for each of its parts.
TEST_F(CadFile, AUnitThatManyContextsHaveIsToldOnceAndOfManyUnitsAFew) {
    constexpr const char* myriametre = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MYRIA.,.METRE.) )";
    const auto with_contexts = [&](int count, bool shared) {
        std::string more;
        for (int n = 0; n < count; ++n) {
            const int unit = shared ? 9000 : 9000 + n;
            if (!shared || n == 0) {
                more += fmt::format("#{} = {};\n", unit, myriametre);
            }
            more += fmt::format("#{} = ( GEOMETRIC_REPRESENTATION_CONTEXT(3) "
                                "GLOBAL_UNIT_ASSIGNED_CONTEXT((#{})) REPRESENTATION_CONTEXT('','') );\n",
                                9500 + n,
                                unit);
        }
        write_step(geometry::surface_preset("dome").make(), folder_ / "dome.step", {});
        std::string text = read_file(folder_ / "dome.step");
        text.insert(text.rfind("ENDSEC;"), more);
        return read_text(text, "contexts.step").notes;
    };
    EXPECT_THAT(with_contexts(30, true), ElementsAre(HasSubstr("#9000 in line")));
    const std::vector<std::string> notes = with_contexts(30, false);
    ASSERT_EQ(notes.size(), 21u);
    EXPECT_EQ(notes.back(), "and 10 more of this kind");
}

TEST_F(CadFile, AUnitOfNoLengthIsRefusedWithItsLine) {
    for (const char* const factor : {"0.", "-25.4"}) {
        try {
            (void)read_text(dome_in(conversion("INCH", factor)), "none.step");
            FAIL() << "a unit of " << factor;
        } catch (const Error& error) {
            EXPECT_THAT(error.diagnostic().message, HasSubstr("is not a valid unit of length"));
            EXPECT_EQ(error.diagnostic().place.line, 137);
        }
    }
}

TEST_F(CadFile, AUnitThatIsWrittenOtherwiseIsToldWithoutALine) {
    std::string text = dome_in("UNIT_HERE = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MYRIA.,.METRE.) );");
    text = std::regex_replace(text, std::regex("#106 ="), "#0106 =");
    EXPECT_THAT(read_text(text, "zero.step").notes,
                ElementsAre(HasSubstr("unit of length #106 cannot be read")));
}

// Given one by one, each face costs the library a look at all that came before, and makes a part of its own.
TEST_F(CadFile, ManyPatchesAreOnePartInTheirOrder) {
    const Surface domes = field_of_domes(10);
    double last = 0.0;
    write_step(domes,
               folder_ / "domes.step",
               Progress(
                   [&](const Progress::Report& now) {
                       EXPECT_GE(now.fraction, last);
                       last = now.fraction;
                   },
                   {}));
    EXPECT_EQ(last, 1.0);
    const std::string text = read_file(folder_ / "domes.step");
    EXPECT_EQ(text.find("PRODUCT('domes'"), text.rfind("PRODUCT('"));
    const CadModel model = read_cad(folder_ / "domes.step", {});
    ASSERT_EQ(model.faces.size(), domes.patches().size());
    for (std::size_t n = 0; n < model.faces.size(); ++n) {
        expect_same(model.faces[n].patches.front(), domes.patches()[n]);
    }
}

TEST_F(CadFile, WritingCanBeCancelledAndLeavesTheFile) {
    for (const double at : {0.0, 0.05, 0.3, 0.6}) {
        write_file(folder_ / "old.step", "as it was");
        std::stop_source stop;
        const Progress progress(
            [&](const Progress::Report& now) {
                if (now.fraction >= at) {
                    stop.request_stop();
                }
            },
            stop.get_token());
        EXPECT_THROW(write_step(field_of_domes(5), folder_ / "old.step", progress), Cancelled) << at;
        EXPECT_EQ(read_file(folder_ / "old.step"), "as it was");
    }
}

TEST_F(CadFile, DamagedAndOtherFilesAreRefused) {
    EXPECT_THAT(refusal("", "part.step"), HasSubstr("empty"));
    EXPECT_THAT(refusal("solid plate\n", "part.step"), HasSubstr("ISO-10303-21"));
    EXPECT_THAT(refusal("hello\n", "part.igs"), HasSubstr("column 73"));
    for (const char* name : {"part.step", "part.igs"}) {
        std::string wide = "\xFF\xFE";
        for (const char c : std::string("ISO-10303-21;\nHEADER;\nENDSEC;\nEND-ISO-10303-21;\n")) {
            wide += {c, '\0'};
        }
        EXPECT_THAT(refusal(wide, name), HasSubstr("the file is text in UTF-16"));
        EXPECT_THAT(refusal(wide.substr(2), name), HasSubstr("the file is text in UTF-16"));
    }
    write_step(geometry::surface_preset("dome").make(), folder_ / "whole.step", {});
    const std::string whole = read_file(folder_ / "whole.step");
    EXPECT_THAT(refusal(whole.substr(0, whole.size() / 2), "half.step"), HasSubstr("the file is cut off"));
    EXPECT_THAT(refusal("ISO-10303-21;\nnonsense\nEND-ISO-10303-21;\n", "broken.step"), HasSubstr("damaged"));
    EXPECT_THROW((void)read_cad(folder_ / "missing.step", {}), Error);
}

/// A file with these lines as its data.
std::string step_of(const std::string& data) {
    return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
           "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" +
           data + "ENDSEC;\nEND-ISO-10303-21;\n";
}

TEST_F(CadFile, WithoutAFaceIsToldAsWhatItIs) {
    EXPECT_EQ(refusal(step_of(""), "empty.step"), "the file contains no entities");
    EXPECT_EQ(refusal(step_of("#1=CARTESIAN_POINT('',(1.,2.,3.));\n"), "point.step"),
              "the file contains no face: 1 point");
    EXPECT_EQ(refusal(step_of("#1=APPLICATION_CONTEXT('');\n#2=PRODUCT_CONTEXT('',#1,'');\n"
                              "#3=PRODUCT('bracket','bracket','',(#2));\n"),
                      "assembly.step"),
              "the file contains no face: 1 product without shape");
    EXPECT_EQ(refusal(step_of("#1=NO_SUCH_SHELL('',());\n"), "other.step"),
              "the file contains no face: 1 entity of unknown type");
}

// The library follows a reference that the file does not have; the process that reads it ends, this one goes
// on.
TEST_F(CadFile, WhatBreaksTheLibraryBreaksNothingElse) {
    write_step(geometry::surface_preset("dome").make(), folder_ / "whole.step", {});
    std::string text = read_file(folder_ / "whole.step");
    const std::size_t vector = text.find("VECTOR('',#");
    ASSERT_NE(vector, std::string::npos);
    text.replace(vector, 11, "VECTOR('',#9");
    EXPECT_NE(refusal(text, "broken.step"), "none");
}

/// What is said of the dome with `from`, which it holds, as `to`.
std::string dome_with(const std::string& text, std::string_view from, std::string_view to) {
    const std::size_t found = text.find(from);
    EXPECT_NE(found, std::string::npos) << from;
    return std::string(text).replace(found, from.size(), to);
}

// The library takes nan and 1e400 for coordinates; with some it never ends, others it lets pass.
TEST_F(CadFile, NumbersThatAreNoneAreRefusedWithTheirLine) {
    write_step(geometry::surface_preset("dome").make(), folder_ / "whole.step", {});
    const std::string whole = read_file(folder_ / "whole.step");
    const std::string point = "CARTESIAN_POINT('',(0.,0.,0.))";
    for (const char* no_number : {"nan", "-NaN", "inf", "1e400", "-1.E+999", "1.#INF", "1.#QNAN", "0.0.0"}) {
        const std::string text =
            dome_with(whole, point, fmt::format("CARTESIAN_POINT('',(0.,{},0.))", no_number));
        try {
            (void)read_text(text, "broken.step");
            FAIL() << no_number;
        } catch (const Error& error) {
            const Diagnostic& said = error.diagnostic();
            EXPECT_THAT(said.message,
                        HasSubstr(fmt::format("CARTESIAN_POINT: \"{}\" is not a finite number", no_number)));
            EXPECT_EQ(said.message.front(), '#');
            const std::ptrdiff_t lines = std::count(
                text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(no_number)), '\n');
            EXPECT_EQ(said.place.line, lines + 1) << no_number;
        }
    }
    EXPECT_THAT(refusal(dome_with(whole, point, "CARTESIAN_POINT('',(0.,0.,-1.E10))"), "far.step"),
                HasSubstr("\"-1.E10\" is not a valid part coordinate, the limit is 1000000000"));
    EXPECT_THAT(refusal(dome_with(whole, "VECTOR('',#", "VECTOR('',1e999,#"), "vector.step"),
                HasSubstr("VECTOR: \"1e999\""));
}

TEST_F(CadFile, WhatOnlyLooksLikeANumberIsRead) {
    write_step(geometry::surface_preset("dome").make(), folder_ / "whole.step", {});
    const std::string whole = read_file(folder_ / "whole.step");
    const std::string point = "CARTESIAN_POINT('',(0.,0.,0.))";
    for (const char* fine : {"CARTESIAN_POINT('(nan,1e400,inf)',(0.,0.,0.))",
                             "CARTESIAN_POINT('it''s (nan',(0.,0.,0.))",
                             "CARTESIAN_POINT /* (1e400) */ ('',(0.,0.E-999,-0))",
                             "CARTESIAN_POINT\n('',\n(0., +0.E+00,0.))"}) {
        EXPECT_EQ(read_text(dome_with(whole, point, fine), "fine.step").faces.size(), 1U) << fine;
    }
}

TEST_F(CadFile, TooManyFacesAreRefusedBeforeTheModelIsRead) {
    std::string faces;
    for (int n = 1; n <= most_cad_faces + 1; ++n) {
        faces += fmt::format("#{}=ADVANCED_FACE('',(),#{},.T.);\n", n, n);
    }
    EXPECT_EQ(refusal(step_of(faces), "many.step"),
              "the file has 20001 faces, but at most 20000 are supported");
}

TEST_F(CadFile, CanBeCancelled) {
    write_step(geometry::surface_preset("dome").make(), folder_ / "whole.step", {});
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)read_cad(folder_ / "whole.step", Progress({}, stop.get_token())), Cancelled);
}

} // namespace
} // namespace millwright::exchange
