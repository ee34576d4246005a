// Bodies that Open CASCADE itself writes: faces of all kinds, trimmed, in other units, as IGES.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/internal/cad_faces.h"
#include "tests/support/scratch_folder.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stop_token>
#include <string>
#include <vector>

namespace millwright::exchange {
namespace {

class CadBodies : public ::testing::Test {
protected:
    CadBodies() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer)); }

    [[nodiscard]] CadModel through_step(const TopoDS_Shape& shape, const char* unit = "MM") const {
        STEPControl_Controller::Init();
        Interface_Static::SetCVal("write.step.unit", unit);
        STEPControl_Writer writer;
        EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
        EXPECT_EQ(writer.Write((folder_ / "body.step").c_str()), IFSelect_RetDone);
        Interface_Static::SetCVal("write.step.unit", "MM");
        return read_cad(folder_ / "body.step", {});
    }

    [[nodiscard]] CadModel through_iges(const TopoDS_Shape& shape) const {
        IGESControl_Writer writer("MM", 0);
        EXPECT_TRUE(writer.AddShape(shape));
        EXPECT_TRUE(writer.Write((folder_ / "body.igs").c_str()));
        return read_cad(folder_ / "body.igs", {});
    }

    test::ScratchFolder folder_;
};

/// Calls `look(position, unit normal)` on a raster of every patch.
template <typename Look> void everywhere(const CadFace& face, Look look) {
    for (const geometry::BezierPatch& patch : face.patches) {
        for (int i = 1; i < 10; ++i) {
            for (int j = 1; j < 10; ++j) {
                const auto normal = patch.unit_normal(i / 10.0, j / 10.0);
                ASSERT_TRUE(normal);
                look(patch.position(i / 10.0, j / 10.0), *normal);
            }
        }
    }
}

double area_of(const std::vector<Vec2>& outline) {
    double doubled = 0.0;
    for (std::size_t n = 0; n < outline.size(); ++n) {
        const Vec2& a = outline[n];
        const Vec2& b = outline[(n + 1) % outline.size()];
        doubled += a.x() * b.y() - a.y() * b.x();
    }
    return std::abs(0.5 * doubled);
}

// It was refused: the mark moves the first line by three columns, and IGES counts columns.
TEST_F(CadBodies, AByteOrderMarkBeforeIgesIsSkipped) {
    const CadModel plain = through_iges(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape());
    write_file(folder_ / "marked.igs", "\xEF\xBB\xBF" + read_file(folder_ / "body.igs"));
    const CadModel marked = read_cad(folder_ / "marked.igs", {});
    ASSERT_EQ(marked.faces.size(), 6U);
    EXPECT_EQ(marked.unit, plain.unit);
    for (std::size_t n = 0; n < marked.faces.size(); ++n) {
        EXPECT_EQ(marked.faces[n].patches.front().position(0.3, 0.7),
                  plain.faces[n].patches.front().position(0.3, 0.7));
    }
}

TEST_F(CadBodies, SphereIsExactAndLooksOutwards) {
    const CadModel model = through_step(BRepPrimAPI_MakeSphere(gp_Pnt(5.0, 6.0, 7.0), 20.0).Shape());
    ASSERT_EQ(model.faces.size(), 1u);
    everywhere(model.faces.front(), [](const Vec3& position, const Vec3& normal) {
        const Vec3 out = position - Vec3(5.0, 6.0, 7.0);
        EXPECT_NEAR(out.norm(), 20.0, 1e-9);
        EXPECT_GT(normal.dot(out.normalized()), 1.0 - 1e-9);
    });
}

TEST_F(CadBodies, EveryFaceOfABoxLooksOutwards) {
    const CadModel model = through_step(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape());
    ASSERT_EQ(model.faces.size(), 6u);
    Vec3 sum = Vec3::Zero();
    for (const CadFace& face : model.faces) {
        EXPECT_FALSE(face.trimmed()) << face.number;
        everywhere(face, [&](const Vec3& position, const Vec3& normal) {
            EXPECT_GT(normal.dot(position - Vec3(15.0, 10.0, 5.0)), 1.0);
            sum += normal;
        });
    }
    EXPECT_LT(sum.norm(), 1e-9);
}

TEST_F(CadBodies, InchesBecomeMillimetres) {
    const CadModel model = through_step(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape(), "INCH");
    Box3 box;
    for (const CadFace& face : model.faces) {
        box.extend(face.box);
    }
    EXPECT_LT((box.sizes() - Vec3(30.0, 20.0, 10.0)).norm(), 1e-6);
    EXPECT_THAT(model.unit, ::testing::HasSubstr("inch"));
}

TEST_F(CadBodies, OutlineOfADiskIsACircle) {
    const TopoDS_Wire circle = BRepBuilderAPI_MakeWire(
        BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(0, 0, 4), gp_Dir(0, 0, 1)), 10.0)));
    const CadModel model = through_step(BRepBuilderAPI_MakeFace(circle).Shape());
    ASSERT_EQ(model.faces.size(), 1u);
    const CadFace& face = model.faces.front();
    ASSERT_TRUE(face.trimmed());
    EXPECT_NEAR(area_of(face.outline), std::numbers::pi / 4.0 * face.rows * face.columns, 0.01);
    EXPECT_LT((face.box.sizes() - Vec3(20.0, 20.0, 0.0)).norm(), 1e-5);
}

TEST_F(CadBodies, CylinderWithAHoleKeepsItsRadiusAndIsTrimmed) {
    const TopoDS_Shape bar = BRepPrimAPI_MakeCylinder(10.0, 40.0).Shape();
    const TopoDS_Shape drill =
        BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-30, 0, 40), gp_Dir(1, 0, 0)), 6.0, 60.0).Shape();
    const CadModel model = through_step(BRepAlgoAPI_Cut(bar, drill).Shape());
    EXPECT_TRUE(model.left_out.empty());
    int trimmed = 0;
    for (const CadFace& face : model.faces) {
        trimmed += face.trimmed() ? 1 : 0;
        for (const Vec2& place : face.outline) {
            EXPECT_GE(place.minCoeff(), 0.0);
            EXPECT_LE(place.x(), face.rows);
            EXPECT_LE(place.y(), face.columns);
        }
    }
    EXPECT_GE(trimmed, 2);
}

TEST_F(CadBodies, HolesOfAPlateComeWithItsOutline) {
    TopoDS_Shape plate = BRepPrimAPI_MakeBox(80.0, 60.0, 5.0).Shape();
    for (const double x : {20.0, 60.0}) {
        const TopoDS_Shape drill =
            BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 30, -1), gp_Dir(0, 0, 1)), 8.0, 7.0).Shape();
        plate = BRepAlgoAPI_Cut(plate, drill).Shape();
    }
    int drilled = 0;
    for (const CadFace& face : through_step(plate).faces) {
        if (face.holes.empty()) {
            continue;
        }
        ++drilled;
        ASSERT_EQ(face.holes.size(), 2U);
        const double square = 80.0 * 60.0 / (face.rows * face.columns); // mm^2 of a patch
        EXPECT_NEAR(area_of(face.outline) * square, 80.0 * 60.0, 1e-3);
        for (const auto& hole : face.holes) {
            EXPECT_NEAR(area_of(hole) * square, std::numbers::pi * 64.0, 1.0);
        }
    }
    EXPECT_EQ(drilled, 2);
}

void expect_box(const Box3& box, const Vec3& low, const Vec3& high) {
    EXPECT_LT((box.min() - low).norm(), 1e-4) << box.min().transpose();
    EXPECT_LT((box.max() - high).norm(), 1e-4) << box.max().transpose();
}

// The control points of these lie up to 13 mm outside of them.
TEST_F(CadBodies, BoxIsThatOfTheFaceNotOfItsControlPoints) {
    const double quarter = std::numbers::pi / 2.0;
    const gp_Ax2 turned(gp_Pnt(0, 0, 0), gp_Dir(1, 1, 1), gp_Dir(1, -1, 0));
    for (const CadFace& face :
         through_step(BRepPrimAPI_MakeSphere(turned, 20.0, -quarter, quarter).Shape()).faces) {
        expect_box(face.box, Vec3::Constant(-20.0), Vec3::Constant(20.0));
    }
    const gp_Ax2 upright(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
    Box3 octant;
    for (const CadFace& face :
         through_step(BRepPrimAPI_MakeSphere(upright, 20.0, 0.0, quarter, quarter).Shape()).faces) {
        octant.extend(face.box);
    }
    expect_box(octant, Vec3::Zero(), Vec3::Constant(20.0));
    // 60 degrees, so that no side of the box is at an end of the arc.
    const gp_Ax2 across(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(std::sqrt(3.0), -1.0, 0));
    const CadModel bar =
        through_step(BRepPrimAPI_MakeCylinder(across, 10.0, 40.0, std::numbers::pi / 3.0).Shape());
    Box3 round;
    for (const CadFace& face : bar.faces) {
        if (face.patches.front().rational()) {
            round.extend(face.box);
        }
    }
    expect_box(round, Vec3(5.0 * std::sqrt(3.0), -5.0, 0.0), Vec3(10.0, 5.0, 40.0));
}

TEST_F(CadBodies, BoxOfATrimmedFaceIsOfWhatIsLeft) {
    const TopoDS_Shape bar = BRepPrimAPI_MakeCylinder(10.0, 40.0).Shape();
    const TopoDS_Shape drill =
        BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-30, 0, 40), gp_Dir(1, 0, 0)), 6.0, 60.0).Shape();
    int walls = 0;
    for (const CadFace& face : through_step(BRepAlgoAPI_Cut(bar, drill).Shape()).faces) {
        if (face.box.min().z() < 1.0 || face.box.min().z() > 39.0) {
            continue;
        }
        ++walls;
        expect_box(face.box, Vec3(-10.0, -6.0, 34.0), Vec3(10.0, 6.0, 40.0));
    }
    EXPECT_EQ(walls, 1);
}

TEST_F(CadBodies, OfAFileWithoutAFaceIsToldWhatItHolds) {
    const auto refusal = [&](const TopoDS_Shape& shape, bool iges) {
        try {
            (void)(iges ? through_iges(shape) : through_step(shape));
        } catch (const Error& error) {
            return error.diagnostic().message + " / " + error.diagnostic().hint;
        }
        return std::string("none");
    };
    const BRep_Builder builder;
    TopoDS_Compound nothing;
    builder.MakeCompound(nothing);
    EXPECT_THAT(
        refusal(nothing, false),
        ::testing::MatchesRegex("the file contains no face: 1 product without shape / .*an assembly .*"));
    TopoDS_Compound frame;
    builder.MakeCompound(frame);
    builder.Add(frame, BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0)).Shape());
    builder.Add(frame, BRepBuilderAPI_MakeEdge(gp_Pnt(0, 5, 0), gp_Pnt(10, 5, 0)).Shape());
    builder.Add(frame, BRepBuilderAPI_MakeVertex(gp_Pnt(1, 2, 3)).Shape());
    for (const bool iges : {false, true}) {
        EXPECT_EQ(refusal(frame, iges),
                  "the file contains no face: 2 edges and 1 point / export surfaces: curves and points alone "
                  "cannot be machined");
    }
}

TEST_F(CadBodies, ThousandsOfFacesComeWithProgressAndCanBeCancelled) {
    const BRep_Builder builder;
    TopoDS_Compound boxes;
    builder.MakeCompound(boxes);
    for (int n = 0; n < 200; ++n) {
        builder.Add(boxes, BRepPrimAPI_MakeBox(gp_Pnt(40.0 * n, 0, 0), 30.0, 20.0, 10.0).Shape());
    }
    EXPECT_EQ(through_step(boxes).faces.size(), 1200U);
    std::stop_source stop;
    double last = 0.0;
    const Progress progress(
        [&](const Progress::Report& now) {
            EXPECT_GE(now.fraction, last);
            last = now.fraction;
            if (last > 0.7) {
                stop.request_stop();
            }
        },
        stop.get_token());
    EXPECT_THROW((void)read_cad(folder_ / "body.step", progress), Cancelled);
    EXPECT_GT(last, 0.7);
}

// A plane without an end. The library's own words alone may be "NCollection_Array1::Value".
TEST_F(CadBodies, FaceThatCannotBeConvertedIsLeftOutWithAReason) {
    const BRep_Builder builder;
    TopoDS_Compound both;
    builder.MakeCompound(both);
    builder.Add(both, BRepBuilderAPI_MakeFace(gp_Pln()).Shape());
    builder.Add(both, BRepPrimAPI_MakeSphere(20.0).Shape());
    const CadModel model = faces_of(both, "both.step", {});
    EXPECT_EQ(model.faces.size(), 1U);
    EXPECT_THAT(model.left_out,
                ::testing::ElementsAre(::testing::StartsWith(
                    "face 1: its surface cannot be converted to a B-spline (Open CASCADE: ")));
}

TEST_F(CadBodies, ReadingTellsHowManyFacesAndHowFar) {
    (void)through_step(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape());
    std::vector<std::string> told;
    const Progress progress(
        [&](const Progress::Report& now) {
            if (told.empty() || told.back() != now.text) {
                told.push_back(now.text);
            }
        },
        {});
    (void)read_cad(folder_ / "body.step", progress);
    EXPECT_THAT(told,
                ::testing::ElementsAre("reading the file",
                                       "reading the text of 6 faces",
                                       "reading the entities of 6 faces",
                                       "creating shapes",
                                       "converting faces"));
}

TEST_F(CadBodies, NumbersOfIgesThatAreNoneAreRefusedWithTheirLine) {
    (void)through_iges(BRepPrimAPI_MakeBox(30.0, 20.0, 10.0).Shape());
    const std::string whole = read_file(folder_ / "body.igs");
    const std::string corner = "110,0.,0.,0.,0.,0.,10.;      ";
    const std::size_t found = whole.find(corner);
    ASSERT_NE(found, std::string::npos);
    const std::ptrdiff_t line =
        1 + std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(found), '\n');
    for (const char* no_number : {"nan", "1e400", "1.D999", "-INF", "1.#INF"}) {
        std::string text = whole;
        text.replace(found,
                     corner.size(),
                     fmt::format("{:{}}", fmt::format("110,0.,0.,0.,0.,0.,{};", no_number), corner.size()));
        write_file(folder_ / "broken.igs", text);
        try {
            (void)read_cad(folder_ / "broken.igs", {});
            FAIL() << no_number;
        } catch (const Error& error) {
            EXPECT_THAT(error.diagnostic().message, ::testing::HasSubstr("entity of type 110: \""));
            EXPECT_THAT(error.diagnostic().message, ::testing::HasSubstr("is not a finite number"));
            EXPECT_EQ(error.diagnostic().place.line, line) << no_number;
        }
    }
}

TEST_F(CadBodies, IgesIsTheSame) {
    const CadModel model = through_iges(BRepPrimAPI_MakeSphere(gp_Pnt(5.0, 6.0, 7.0), 20.0).Shape());
    ASSERT_FALSE(model.faces.empty());
    EXPECT_EQ(model.unit, "mm");
    for (const CadFace& face : model.faces) {
        everywhere(face, [](const Vec3& position, const Vec3&) {
            EXPECT_NEAR((position - Vec3(5.0, 6.0, 7.0)).norm(), 20.0, 1e-6);
        });
    }
}

} // namespace
} // namespace millwright::exchange
