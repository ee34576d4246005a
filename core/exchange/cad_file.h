// Exact surfaces from STEP and IGES files, by Open CASCADE, and the way back to STEP. What the file holds as
// planes, cylinders, B-splines, ... becomes rational Bezier patches, which are the same surfaces.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/bspline_surface.h"
#include "core/geometry/surface.h"
#include "core/geometry/trim.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millwright::exchange {

inline constexpr int most_cad_faces = 20'000;
inline constexpr int most_cad_patches = 100'000;

/// One face of a body: a raster of patches, of which the outline leaves a part.
struct CadFace {
    int number = 1;                             ///< its place in the file, from 1
    int rows = 1;                               ///< patches along u
    int columns = 1;                            ///< patches along v
    std::vector<geometry::BezierPatch> patches; ///< row by row; S_u x S_v looks out of the body
    std::vector<Vec2> outline; ///< outer boundary in [0, rows] x [0, columns], not closed; empty: all of it
    std::vector<std::vector<Vec2>> holes; ///< the same of what is cut out inside; only with an outline
    Box3 box;                             ///< mm, of the face itself, not of its control points
    /// Of several patches: all of them as one surface, whose span in a row and a column is the patch there.
    /// Nothing where a surface cannot be one: it breaks, or its weights are too uneven.
    std::optional<geometry::BsplineNet> bspline;

    [[nodiscard]] bool trimmed() const { return !outline.empty(); }
    /// Outline and holes; none where it is not trimmed.
    [[nodiscard]] std::vector<geometry::Trim::Loop> loops() const;
    /// What they leave of one patch, in its own parameters; nothing where it lies outside of them.
    [[nodiscard]] std::optional<geometry::Trim> trim_of(int row, int column) const;
    /// At a place in [0, rows] x [0, columns].
    [[nodiscard]] Vec3 position(const Vec2& at) const;
    /// Outline and holes over [0,1]^2 of the whole face; nothing is cut off where it is not trimmed.
    [[nodiscard]] geometry::Trim trim() const;
    /// The same in the parameters of `bspline`, which there is.
    [[nodiscard]] geometry::Trim bspline_trim() const;
};

struct CadModel {
    std::vector<CadFace> faces;
    std::vector<std::string> left_out; ///< why a face is not among them, a sentence each
    std::vector<std::string> notes;    ///< what is taken in place of what is not understood, a sentence each
    std::string unit;                  ///< of length in the file, as far as it tells: "mm", "inch", ...
};

/// Whether the name ends like that of a STEP or IGES file, in any case.
[[nodiscard]] bool is_cad_file(const std::filesystem::path& file);

/// Whether this build can read and write such files.
[[nodiscard]] bool reads_cad_files();

/// The faces of all bodies and shells, in mm. Throws Error, naming the file, for what is no such file, is
/// damaged or has no face, has more faces or patches than the limits above, and in a build without Open
/// CASCADE; Cancelled.
[[nodiscard]] CadModel read_cad(const std::filesystem::path& file, const Progress& progress);

/// Each patch as a face of its own, in their order. Replaces `file` as a whole or leaves it. Throws Error,
/// naming the file, for degrees above 25 and in a build without Open CASCADE; Cancelled.
void write_step(const geometry::Surface& surface,
                const std::filesystem::path& file,
                const Progress& progress);

} // namespace millwright::exchange
