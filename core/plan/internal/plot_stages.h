// The stages of what comes of a plot or a picture: what each reads, what it makes, and how. plot_derivation.h
// runs them.
#pragma once

#include "core/base/progress.h"
#include "core/plan/plot_work.h"
#include "core/plot/picture/picture.h"
#include "core/plot_strokes/strokes.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace millwright::plan {

enum class PlotStageKind {
    reading,
    spindle,
    shown_picture,
    strokes,
    cut,
    path,
    plate,
    look,
    light,
    speeds,
    program,
    time_as_drawn,
    motion
};

/// What a person entered, and the state of the files that it names.
struct PlotSource {
    /// A file that is not there has the least time and no bytes.
    struct FileState {
        std::filesystem::file_time_type written = std::filesystem::file_time_type::min();
        std::uintmax_t bytes = 0;

        friend bool operator==(const FileState&, const FileState&) = default;
    };

    project::PlotInput input;
    FileState file = {}, machine = {}, post = {};
};
[[nodiscard]] PlotSource plot_source_of(const project::PlotInput& input, const std::filesystem::path& assets);

/// What stages hand on that is no part of the result.
struct PlotParts {
    // Of the reading: what the file has.
    std::shared_ptr<const plot::Strokes> read_strokes;
    std::optional<plot::Picture> picture;
    plot::FilePixels pixels;          ///< of a picture, for people to look at
    plot::CutPath read_path;          ///< of a path file, or of a program
    std::optional<PlotPoints> points; ///< where they lie in the file
    Vec2 end = Vec2::Zero();          ///< where strokes leave the tool

    // Of the strokes, where strokes are cut along their lines.
    std::shared_ptr<const plot::Strokes> drawn, planned; ///< null where no strokes are

    // Of the cut: before it is moved to the origin.
    std::shared_ptr<const plot::CutPath> cut, cut_as_drawn; ///< as drawn: of strokes alone
};

/// What a stage works with.
struct PlotStageWork {
    PlotResult& result;
    PlotParts& parts;
    std::vector<Diagnostic>& notices; ///< its own
    const std::filesystem::path& assets;
    const Progress& progress;
    const std::function<void()>& show; ///< there is more of the result to be looked at

    [[nodiscard]] const project::PlotSettings& settings() const { return result.input.settings; }
    /// Names the file in it.
    void note(std::optional<Diagnostic> notice) const;
};

struct PlotStage {
    PlotStageKind kind;
    std::string_view title = {}; ///< what is being done, for people; empty: as before
    double share = 0.0;          ///< of the work, relative to the other stages
    /// The earlier stages whose results it reads: it is stale when one of them was made again.
    std::vector<PlotStageKind> reads = {};
    /// Whether what it reads of the input itself is equal; null: nothing.
    bool (*same)(const PlotSource& then, const PlotSource& now) = nullptr;
    void (*make)(const PlotStageWork& work) = nullptr;             ///< throws Error or Cancelled
    void (*clear)(PlotResult& result, PlotParts& parts) = nullptr; ///< takes out what it made
    bool of_program = false; ///< it is left out of a path that is too long to get one automatically
    bool shown = false;      ///< what is there is published when it has been made
    bool finishes = false;   ///< PlotResult::finished holds when it has been made
};

/// In the order in which they depend on each other, which is that of PlotStageKind.
[[nodiscard]] std::span<const PlotStage> plot_stages();

} // namespace millwright::plan
