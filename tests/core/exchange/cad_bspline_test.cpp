// Faces of many spans as one surface without a fit: Open CASCADE, which wrote them, is the judge.
#include "core/exchange/cad_file.h"
#include "core/geometry/closest_point.h"
#include "tests/support/scratch_folder.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Writer.hxx>
#include <Precision.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Ax2d.hxx>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace millwright::exchange {
namespace {

using geometry::BsplineSurface;

constexpr double wanted_mm = 1e-3;

/// A twisted blade: knots from 2 to 9, some of them twice, and two that almost touch.
Handle(Geom_BSplineSurface) blade(bool rational) {
    const std::vector<double> ku{2, 2.5, 2.5 + 1e-6, 4, 5.5, 6, 8, 9}, kv{-1, 0.5, 2, 3};
    const std::vector<int> mu{4, 1, 1, 2, 1, 1, 1, 4}, mv{3, 1, 2, 3};
    constexpr int rows = 11, columns = 6;
    TColStd_Array1OfReal knots_u(1, int(ku.size())), knots_v(1, int(kv.size()));
    TColStd_Array1OfInteger times_u(1, int(ku.size())), times_v(1, int(kv.size()));
    for (int n = 1; n <= knots_u.Length(); ++n) {
        knots_u(n) = ku[std::size_t(n) - 1];
        times_u(n) = mu[std::size_t(n) - 1];
    }
    for (int n = 1; n <= knots_v.Length(); ++n) {
        knots_v(n) = kv[std::size_t(n) - 1];
        times_v(n) = mv[std::size_t(n) - 1];
    }
    TColgp_Array2OfPnt poles(1, rows, 1, columns);
    TColStd_Array2OfReal weights(1, rows, 1, columns);
    for (int i = 1; i <= rows; ++i) {
        for (int j = 1; j <= columns; ++j) {
            const double turn = 0.12 * i;
            const double across = 9.0 * (j - 3.5), up = 3.0 * std::sin(0.9 * j + 0.4 * i);
            poles(i, j) = gp_Pnt(12.0 * i,
                                 across * std::cos(turn) - up * std::sin(turn),
                                 across * std::sin(turn) + up * std::cos(turn));
            weights(i, j) = rational ? 1.0 + 0.5 * std::sin(i * 1.7 + j) : 1.0;
        }
    }
    return new Geom_BSplineSurface(poles, weights, knots_u, knots_v, times_u, times_v, 3, 2);
}

class CadBspline : public ::testing::Test {
protected:
    [[nodiscard]] CadFace read(const TopoDS_Shape& shape, bool iges, int number = 1) const {
        const std::string file = (folder_ / (iges ? "face.igs" : "face.step")).string();
        if (iges) {
            IGESControl_Writer writer("MM", 0);
            EXPECT_TRUE(writer.AddShape(shape));
            EXPECT_TRUE(writer.Write(file.c_str()));
        } else {
            STEPControl_Controller::Init();
            STEPControl_Writer writer;
            EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
            EXPECT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
        }
        return read_cad(file, {}).faces.at(static_cast<std::size_t>(number) - 1);
    }

    test::ScratchFolder folder_;
};

/// The largest distance of points of the one from the other surface, both ways, over the face's own bounds.
double apart(const CadFace& face, const TopoDS_Face& wanted) {
    const BsplineSurface ours(face.bspline.value());
    const geometry::ClosestPointSearch search(ours);
    const BRepAdaptor_Surface exact(wanted);
    constexpr int side = 60;
    double largest = 0.0;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            const double s = double(i) / side, t = double(j) / side;
            const gp_Pnt p =
                exact.Value(exact.FirstUParameter() + s * (exact.LastUParameter() - exact.FirstUParameter()),
                            exact.FirstVParameter() + t * (exact.LastVParameter() - exact.FirstVParameter()));
            largest = std::max(largest, search.closest({p.X(), p.Y(), p.Z()}).distance);
        }
    }
    for (int i = 0; i <= side / 3; ++i) {
        for (int j = 0; j <= side / 3; ++j) {
            const Vec3 p = ours.position(3.0 * i / side, 3.0 * j / side);
            BRepBuilderAPI_MakeVertex vertex(gp_Pnt(p.x(), p.y(), p.z()));
            const BRepExtrema_DistShapeShape back(vertex.Vertex(), wanted);
            largest = std::max(largest, back.IsDone() ? back.Value() : 1e9);
        }
    }
    return largest;
}

TEST_F(CadBspline, IsTheFaceOfTheFileBothWays) {
    for (const bool rational : {false, true}) {
        for (const bool iges : {false, true}) {
            const TopoDS_Face wanted =
                BRepBuilderAPI_MakeFace(blade(rational), Precision::Confusion()).Face();
            const CadFace face = read(wanted, iges);
            ASSERT_TRUE(face.bspline);
            EXPECT_FALSE(face.trimmed());
            EXPECT_EQ(face.rows * face.columns, 21);
            EXPECT_LT(apart(face, wanted), wanted_mm) << rational << iges;
        }
    }
}

// At the same share of the parameters, derivatives of the library at its own parameters are ours by the
// range.
TEST_F(CadBspline, HasTheDerivativesOfTheLibrary) {
    const Handle(Geom_BSplineSurface) surface = blade(true);
    const CadFace face = read(BRepBuilderAPI_MakeFace(surface, Precision::Confusion()).Face(), false);
    const BsplineSurface ours(face.bspline.value());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int n = 0; n < 500; ++n) {
        const double u = share(random), v = share(random);
        gp_Pnt p;
        gp_Vec du, dv, duu, dvv, duv;
        surface->D2(2.0 + 7.0 * u, -1.0 + 4.0 * v, p, du, dv, duu, dvv, duv);
        const auto as_vec = [](const gp_XYZ& x, double scale) {
            return Vec3(scale * Vec3(x.X(), x.Y(), x.Z()));
        };
        const geometry::SurfaceDerivatives at = ours.derivatives(u, v);
        EXPECT_LT((at.position - as_vec(p.XYZ(), 1.0)).norm(), 1e-9);
        EXPECT_LT((at.du - as_vec(du.XYZ(), 7.0)).norm(), 1e-7);
        EXPECT_LT((at.dv - as_vec(dv.XYZ(), 4.0)).norm(), 1e-7);
        EXPECT_LT((at.duv - as_vec(duv.XYZ(), 28.0)).norm(), 1e-5);
        EXPECT_LT((at.dvv - as_vec(dvv.XYZ(), 16.0)).norm(), 1e-5);
        if (std::abs(u - 0.5 / 7.0) > 1e-4) { // between the knots that almost touch
            EXPECT_LT((at.duu - as_vec(duu.XYZ(), 49.0)).norm(), 1e-4);
        }
    }
}

// A quarter of the parameters each way, bounded by lines at no knot.
TEST_F(CadBspline, OfAPartOfASurfaceIsThatPart) {
    const TopoDS_Face wanted =
        BRepBuilderAPI_MakeFace(blade(false), 3.1, 7.3, 0.1, 2.4, Precision::Confusion()).Face();
    const CadFace face = read(wanted, false);
    ASSERT_TRUE(face.bspline);
    EXPECT_FALSE(face.trimmed());
    EXPECT_LT(apart(face, wanted), wanted_mm);
}

// Closed around: the seam of the cylinder is one side of the parameters, and it looks outwards.
TEST_F(CadBspline, OfACylinderGoesAroundAndLooksOutwards) {
    const CadFace face = read(BRepPrimAPI_MakeCylinder(20.0, 50.0).Shape(), false);
    ASSERT_TRUE(face.bspline);
    const BsplineSurface surface(*face.bspline);
    for (int i = 0; i <= 40; ++i) {
        for (int j = 1; j < 10; ++j) {
            const geometry::SurfacePoint at = surface.point(i / 40.0, j / 10.0);
            const Vec3 out(at.position.x(), at.position.y(), 0.0);
            EXPECT_NEAR(out.norm(), 20.0, 1e-9);
            EXPECT_GT(at.normal.value().dot(out) / 20.0, 1.0 - 1e-9);
        }
    }
    EXPECT_LT((surface.position(0.0, 0.4) - surface.position(1.0, 0.4)).norm() *
                  (surface.position(0.4, 0.0) - surface.position(0.4, 1.0)).norm(),
              1e-9);
}

// The hole's edge in the parameters of the surface must lie on the edge of the library's hole in space.
TEST_F(CadBspline, HasItsHoleWhereTheLibraryHasIt) {
    const Handle(Geom_BSplineSurface) surface = blade(false);
    const double middle_u = 5.0, middle_v = 1.0, radius = 0.8;
    const Handle(Geom2d_Circle) circle =
        new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(middle_u, middle_v), gp_Dir2d(1.0, 0.0)), radius, Standard_False);
    BRepBuilderAPI_MakeFace with_hole(surface, Precision::Confusion());
    with_hole.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle, surface).Edge()).Wire());
    TopoDS_Face trimmed = with_hole.Face();
    BRepLib::BuildCurves3d(trimmed);
    const CadFace face = read(trimmed, false);
    ASSERT_TRUE(face.bspline);
    ASSERT_EQ(face.holes.size(), 1U);
    const geometry::Trim trim = face.bspline_trim();
    ASSERT_EQ(trim.loops.size(), 2U);
    for (const Vec2& corner : trim.loops[1]) {
        const Vec2 at(2.0 + 7.0 * corner.x() - middle_u, -1.0 + 4.0 * corner.y() - middle_v);
        EXPECT_NEAR(at.norm(), radius, 1e-5);
    }
    EXPECT_FALSE(trim.contains({(middle_u - 2.0) / 7.0, (middle_v + 1.0) / 4.0}));
    EXPECT_TRUE(trim.contains({0.05, 0.05}));
}

TEST_F(CadBspline, OfASinglePatchIsThePatch) {
    const TopoDS_Face one =
        BRepBuilderAPI_MakeFace(blade(false), 4.1, 5.2, 0.6, 1.9, Precision::Confusion()).Face();
    const CadFace face = read(one, false);
    EXPECT_EQ(face.patches.size(), 1U);
    EXPECT_FALSE(face.bspline);
}

} // namespace
} // namespace millwright::exchange
