#include "core/exchange/internal/cad_faces.h"

#include "core/base/error.h"
#include "core/exchange/internal/cad_box.h"

#include <BRepAdaptor_Curve2d.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_BSplineSurfaceToBezierSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::exchange {

namespace {

using geometry::BezierPatch;
using geometry::BsplineNet;
using geometry::ControlNet;

/// Calls `work`; what the library throws becomes an Error that says what could not be done.
template <typename Work> auto told_as(const char* what, Work work) {
    try {
        return work();
    } catch (const Standard_Failure& failure) {
        const char* const reason = failure.GetMessageString();
        throw Error(
            fmt::format("{} (Open CASCADE: {})",
                        what,
                        reason != nullptr && *reason != '\0' ? reason : failure.DynamicType()->Name()));
    }
}

/// The same face on a B-spline surface, its boundary in the parameters of that.
TopoDS_Face as_nurbs(const TopoDS_Face& face) {
    BRepBuilderAPI_NurbsConvert converted(face);
    return TopoDS::Face(converted.Shape());
}

/// The part of the face's surface within its bounds, whatever the surface was.
struct Bounded {
    Handle(Geom_BSplineSurface) surface;
    std::pair<double, double> u;
    std::pair<double, double> v;
};

/// Rounding puts bounds a little beyond what there is: the surface's own, or one period.
std::pair<double, double>
within(std::pair<double, double> bounds, std::pair<double, double> own, bool periodic) {
    constexpr double rounding = 1e-7; // of the own range
    const double range = own.second - own.first;
    const auto snapped = [&](double value) {
        const double to_first = std::abs(value - own.first);
        const double to_second = std::abs(value - own.second);
        return to_first < rounding * range ? own.first : to_second < rounding * range ? own.second : value;
    };
    if (!periodic) {
        return {std::max(snapped(bounds.first), own.first), std::min(snapped(bounds.second), own.second)};
    }
    return {snapped(bounds.first), std::min(snapped(bounds.second), snapped(bounds.first) + range)};
}

void expect_area(const std::pair<double, double>& bounds) {
    if (!(bounds.first < bounds.second) || !std::isfinite(bounds.second - bounds.first)) {
        throw Error("its boundary encloses no part of its surface");
    }
}

Bounded bounded(const TopoDS_Face& face) {
    Bounded result;
    BRepTools::UVBounds(face, result.u.first, result.u.second, result.v.first, result.v.second);
    expect_area(result.u);
    expect_area(result.v);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    result.surface = Handle(Geom_BSplineSurface)::DownCast(surface);
    if (result.surface.IsNull()) {
        result.surface = GeomConvert::SurfaceToBSplineSurface(new Geom_RectangularTrimmedSurface(
            surface, result.u.first, result.u.second, result.v.first, result.v.second));
    }
    std::pair<double, double> u;
    std::pair<double, double> v;
    result.surface->Bounds(u.first, u.second, v.first, v.second);
    result.u = within(result.u, u, result.surface->IsUPeriodic());
    result.v = within(result.v, v, result.surface->IsVPeriodic());
    return result;
}

BezierPatch patch_of(const Geom_BezierSurface& surface) {
    ControlNet net = ControlNet::sized(surface.NbUPoles(), surface.NbVPoles());
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            const gp_Pnt pole = surface.Pole(i + 1, j + 1);
            net.point(i, j) = {pole.X(), pole.Y(), pole.Z()};
            net.weight(i, j) = surface.Weight(i + 1, j + 1);
        }
    }
    return BezierPatch(std::move(net));
}

/// u and v changed for each other: the normal looks the other way.
BezierPatch turned_over(const BezierPatch& patch) {
    const ControlNet& net = patch.net();
    ControlNet turned = ControlNet::sized(net.columns, net.rows);
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            turned.point(j, i) = net.point(i, j);
            turned.weight(j, i) = net.weight(i, j);
        }
    }
    return BezierPatch(std::move(turned));
}

void turn_over(CadFace& face) {
    std::vector<BezierPatch> turned;
    for (int j = 0; j < face.columns; ++j) {
        for (int i = 0; i < face.rows; ++i) {
            turned.push_back(turned_over(face.patches[static_cast<std::size_t>(i * face.columns + j)]));
        }
    }
    face.patches = std::move(turned);
    if (face.bspline) {
        face.bspline = geometry::turned_over(*face.bspline);
    }
    std::swap(face.rows, face.columns);
    const auto turn = [](std::vector<Vec2>& loop) {
        for (Vec2& place : loop) {
            std::swap(place.x(), place.y());
        }
    };
    turn(face.outline);
    std::ranges::for_each(face.holes, turn);
}

/// Which patch a parameter lies in, and where: 1.5 is the middle of the second.
double place_between(const TColStd_Array1OfReal& knots, double parameter) {
    int k = knots.Lower();
    while (k + 2 <= knots.Upper() && parameter > knots(k + 1)) {
        ++k;
    }
    const double share = (parameter - knots(k)) / (knots(k + 1) - knots(k));
    return k - knots.Lower() + std::clamp(share, 0.0, 1.0);
}

struct Knots {
    TColStd_Array1OfReal u;
    TColStd_Array1OfReal v;
};

std::vector<Vec2> loop_of(const TopoDS_Wire& wire, const TopoDS_Face& face, const Knots& knots) {
    constexpr int pieces_of_a_curve = 48;
    std::vector<Vec2> outline;
    for (BRepTools_WireExplorer edges(wire, face); edges.More(); edges.Next()) {
        const BRepAdaptor_Curve2d curve(edges.Current(), face);
        const bool backwards = edges.Orientation() == TopAbs_REVERSED;
        const bool straight =
            curve.GetType() == GeomAbs_Line ||
            (curve.GetType() == GeomAbs_BSplineCurve && curve.Degree() == 1 && curve.NbKnots() == 2);
        const int pieces = straight ? 1 : pieces_of_a_curve;
        for (int k = 0; k < pieces; ++k) {
            const double share = static_cast<double>(backwards ? pieces - k : k) / pieces;
            const gp_Pnt2d at = curve.Value(curve.FirstParameter() +
                                            share * (curve.LastParameter() - curve.FirstParameter()));
            outline.emplace_back(place_between(knots.u, at.X()), place_between(knots.v, at.Y()));
        }
    }
    return outline;
}

std::vector<std::vector<Vec2>>
holes_of(const TopoDS_Face& face, const TopoDS_Wire& outer, const Knots& knots) {
    std::vector<std::vector<Vec2>> holes;
    for (TopExp_Explorer at(face, TopAbs_WIRE); at.More(); at.Next()) {
        const TopoDS_Wire& wire = TopoDS::Wire(at.Current());
        if (wire.IsSame(outer)) {
            continue;
        }
        if (std::vector<Vec2> hole = loop_of(wire, face, knots); hole.size() > 2) {
            holes.push_back(std::move(hole));
        }
    }
    return holes;
}

/// Whether the outline runs along the sides of the raster alone.
bool is_everything(const std::vector<Vec2>& outline, int rows, int columns) {
    constexpr double on_side = 1e-6; // of a patch
    const auto near_end = [](double place, int last) { return place < on_side || place > last - on_side; };
    return std::ranges::all_of(outline, [&](const Vec2& place) {
        return near_end(place.x(), rows) || near_end(place.y(), columns);
    });
}

/// The patches of the face, and the knots between them.
struct Raster {
    CadFace face;
    Knots knots;
};

Raster raster_of(const Bounded& part) {
    GeomConvert_BSplineSurfaceToBezierSurface pieces(
        part.surface, part.u.first, part.u.second, part.v.first, part.v.second, 1e-9);
    Raster result{
        CadFace{},
        {TColStd_Array1OfReal(1, pieces.NbUPatches() + 1), TColStd_Array1OfReal(1, pieces.NbVPatches() + 1)}};
    result.face.rows = pieces.NbUPatches();
    result.face.columns = pieces.NbVPatches();
    for (int i = 1; i <= result.face.rows; ++i) {
        for (int j = 1; j <= result.face.columns; ++j) {
            result.face.patches.push_back(patch_of(*pieces.Patch(i, j)));
        }
    }
    pieces.UKnots(result.knots.u);
    pieces.VKnots(result.knots.v);
    return result;
}

/// From 0 to 1, each as often as the library counts it.
std::vector<double> normalised_knots(const TColStd_Array1OfReal& sequence, int degree) {
    const double first = sequence.First(), range = sequence.Last() - sequence.First();
    std::vector<double> knots;
    for (const double knot : sequence) {
        knots.push_back((knot - first) / range);
    }
    std::fill_n(knots.begin(), degree + 1, 0.0);
    std::fill_n(knots.rbegin(), degree + 1, 1.0);
    return knots;
}

BsplineNet net_of(const Geom_BSplineSurface& surface) {
    BsplineNet net;
    net.degree_u = surface.UDegree();
    net.degree_v = surface.VDegree();
    net.knots_u = normalised_knots(surface.UKnotSequence(), net.degree_u);
    net.knots_v = normalised_knots(surface.VKnotSequence(), net.degree_v);
    net.rows = surface.NbUPoles();
    net.columns = surface.NbVPoles();
    for (int i = 1; i <= net.rows; ++i) {
        for (int j = 1; j <= net.columns; ++j) {
            const gp_Pnt pole = surface.Pole(i, j);
            net.points.emplace_back(pole.X(), pole.Y(), pole.Z());
            net.weights.push_back(surface.Weight(i, j));
        }
    }
    return net;
}

/// The part within its bounds as one surface with as many spans as the raster has patches.
std::optional<BsplineNet> bspline_of(const Bounded& part, const CadFace& raster) {
    if (raster.rows * raster.columns == 1) {
        return std::nullopt;
    }
    const Handle(Geom_BSplineSurface) within_bounds =
        Handle(Geom_BSplineSurface)::DownCast(part.surface->Copy());
    within_bounds->Segment(part.u.first, part.u.second, part.v.first, part.v.second);
    within_bounds->SetUNotPeriodic();
    within_bounds->SetVNotPeriodic();
    BsplineNet net = net_of(*within_bounds);
    const bool usable = geometry::fault_of(net).empty() &&
                        std::ssize(geometry::span_ends(net.knots_u)) == raster.rows + 1 &&
                        std::ssize(geometry::span_ends(net.knots_v)) == raster.columns + 1;
    return usable ? std::optional(std::move(net)) : std::nullopt;
}

void take_boundary(CadFace& result, const TopoDS_Face& face, const Knots& knots) {
    const TopoDS_Wire outer = BRepTools::OuterWire(face);
    result.outline = loop_of(outer, face, knots);
    result.holes = holes_of(face, outer, knots);
    if (result.holes.empty() && is_everything(result.outline, result.rows, result.columns)) {
        result.outline.clear();
    }
}

CadFace cad_face(const TopoDS_Face& original, int number) {
    const TopoDS_Face face =
        told_as("its surface cannot be converted to a B-spline", [&] { return as_nurbs(original); });
    const Bounded part = told_as("its boundary does not lie on its surface", [&] { return bounded(face); });
    auto [result, knots] =
        told_as("its surface cannot be divided into patches", [&] { return raster_of(part); });
    result.number = number;
    result.bspline = told_as("its part within the boundary cannot be cut out",
                             [&, &result = result] { return bspline_of(part, result); });
    told_as("its boundary cannot be traced on its surface",
            [&, &result = result, &knots = knots] { take_boundary(result, face, knots); });
    if (face.Orientation() == TopAbs_REVERSED) {
        turn_over(result);
    }
    result.box =
        told_as("its size cannot be determined", [&, &result = result] { return box_of(result, original); });
    return result;
}

constexpr const char* write_fewer = "export the body or the faces to be machined to a separate file";

/// The faces in the order of the file.
std::vector<TopoDS_Face> faces_listed(const TopoDS_Shape& shape, const std::filesystem::path& file) {
    std::vector<TopoDS_Face> faces;
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
        faces.push_back(TopoDS::Face(at.Current()));
        if (std::ssize(faces) > most_cad_faces) {
            throw Error(fmt::format("more than {} faces", most_cad_faces), file, write_fewer);
        }
    }
    expects(!faces.empty(), "a shape with faces");
    return faces;
}

} // namespace

CadModel faces_of(const TopoDS_Shape& shape, const std::filesystem::path& file, const Progress& progress) {
    const std::vector<TopoDS_Face> faces = faces_listed(shape, file);
    CadModel model;
    std::ptrdiff_t patches = 0;
    for (std::size_t n = 0; n < faces.size(); ++n) {
        progress.check();
        progress.report(static_cast<double>(n) / static_cast<double>(faces.size()), "converting faces");
        const int number = static_cast<int>(n) + 1;
        try {
            model.faces.push_back(cad_face(faces[n], number));
            patches += std::ssize(model.faces.back().patches);
        } catch (const Error& error) {
            model.left_out.push_back(fmt::format("face {}: {}", number, error.diagnostic().message));
        }
        if (patches > most_cad_patches) {
            throw Error(fmt::format("more than {} Bezier patches", most_cad_patches), file, write_fewer);
        }
    }
    if (model.faces.empty()) {
        throw Error(faces.size() == 1 ? "the only face cannot be converted: " + model.left_out.front()
                                      : fmt::format("none of the {} faces can be converted: {}",
                                                    faces.size(),
                                                    model.left_out.front()),
                    file);
    }
    return model;
}

} // namespace millwright::exchange
