// A design from a file of another program: a face of a STEP or IGES file as it is, or a patch fitted to it or
// to a mesh; and a surface through measured points or near them.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/mesh_file.h"
#include "core/exchange/patch_fit.h"
#include "core/exchange/point_file.h"
#include "core/project/project.h"
#include "core/region/joined_region.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::project {

/// Degrees of a patch that is fitted.
struct FitDegrees {
    int u = 5; ///< 1 to exchange::max_fit_degree
    int v = 5; ///< the same

    friend bool operator==(const FitDegrees&, const FitDegrees&) = default;
};

/// A file as it was read, before anything of it was chosen: one of the three.
struct ImportSource {
    std::filesystem::path file;
    std::optional<exchange::CadModel> model;
    std::optional<exchange::MeshFile> mesh;         ///< in the unit of the file, whichever that is
    std::optional<exchange::MeasuredPoints> points; ///< the same
};

struct ImportChoice {
    int face = 0;             ///< of a STEP or IGES file, from 1; 0: the only one
    double mm_per_unit = 1.0; ///< of a mesh or of points; the other files tell
    std::optional<FitDegrees> degrees =
        {};                         ///< meshes but rasters are always fitted, others only if these are given
    std::optional<Vec3> along = {}; ///< unit, out of the part: the side of a mesh or of points that is fitted
    /// The same numbers, of several faces as one surface, exactly, in place of `face`; one alone is an exact
    /// face.
    std::vector<int> joined = {};
    bool exact = false; ///< a face of a STEP or IGES file as one surface, of as many spans as it has
    bool cloud = false; ///< points are fitted as a cloud, whether they are in rows or not

    friend bool operator==(const ImportChoice&, const ImportChoice&) = default;
};

/// The faces of the file that are chosen; none of several without a choice.
[[nodiscard]] std::vector<int> chosen_faces(const exchange::CadModel& model, const ImportChoice& choice);

/// As a person points at a face: it is chosen in place of another one or, where faces are joined, added to
/// them or taken out, but for the last of them.
[[nodiscard]] ImportChoice with_face(ImportChoice choice, int number);

/// How near the surface is to each of the measured points.
struct PointFit {
    int rows = 0, columns = 0;     ///< 0: a cloud
    std::vector<Vec3> points;      ///< mm
    std::vector<int> lines;        ///< of the file; of a mesh the numbers of the points, from 1
    exchange::Deviation deviation; ///< of the points; none of the patch

    [[nodiscard]] int worst_line() const;
};

struct ImportedSurface {
    SurfaceInput surface;
    std::optional<exchange::MeshFit> fit;                    ///< if one patch was fitted
    std::optional<PointFit> points;                          ///< of a file of points
    std::shared_ptr<const region::JoinedRegion> joined = {}; ///< if several faces were joined
    std::vector<std::string> notes;                          ///< what the person should know, a sentence each
    std::vector<std::string> warnings{}; ///< the same: why it is not the surface of the file
};

inline constexpr const char* importable_kinds =
    "supported: STEP, IGES, STL, OBJ, PLY and points (CSV, XYZ, ASC, PTS, TXT)";

/// Whether the name ends like that of a file that can be imported.
[[nodiscard]] bool is_importable(const std::filesystem::path& file);
/// Whether a file of that name is a surface unless something else is said: those files of points are left out
/// whose names others have, too, as points of a table do.
[[nodiscard]] bool opens_as_surface(const std::filesystem::path& file);

/// Of a mesh so small that its unit, which no such file names, is doubtful: a sentence with its size in
/// others; else empty.
[[nodiscard]] std::string doubt_of_size(double size_mm, double mm_per_unit);
/// The same of all faces of a model, whose file names its unit.
[[nodiscard]] std::string doubt_of_size(const exchange::CadModel& model);

/// Throws Error, naming the file, for one that cannot be read; Cancelled.
[[nodiscard]] ImportSource read_source(const std::filesystem::path& file, const Progress& progress);

/// Throws Error, naming the file, for no choice among several faces, a face or a side that there is not, for
/// control points beyond `farthest_point_mm` and for what is smaller than 0.001 mm; Cancelled.
[[nodiscard]] ImportedSurface
import_of(const ImportSource& source, const ImportChoice& choice, const Progress& progress);

/// Both in one go.
[[nodiscard]] ImportedSurface
import_surface(const std::filesystem::path& file, const ImportChoice& choice, const Progress& progress);

/// The same of a face at hand.
[[nodiscard]] ImportedSurface
import_face(const exchange::CadFace& face, const ImportChoice& choice, const Progress& progress);

} // namespace millwright::project
