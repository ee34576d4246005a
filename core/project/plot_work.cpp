#include "core/project/plot_work.h"

#include "core/base/files.h"
#include "core/gcode/plot_program.h"
#include "core/gcode/posts/post_file.h"
#include "core/gcode/posts/release.h"
#include "core/kinematics/machine_file.h"
#include "core/plot/hpgl/reader.h"
#include "core/plot/path_file.h"
#include "core/plot/picture/engraving.h"
#include "core/plot/picture/finished_look.h"
#include "core/plot/picture/relief_plan.h"
#include "core/plot/picture/trace.h"
#include "core/project/assets.h"
#include "core/project/internal/background.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <utility>

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

constexpr double thesis_pixel = 0.26; // mm: KMITL thesis of 2006
constexpr double chord_tolerance = 0.005;
constexpr double light_half = 0.3; // mm that halve the light: docs/reference/picture.md
constexpr int look_squares = 160;

std::string ending_of(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(
        ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

bool is_picture(const fs::path& file) {
    constexpr std::array<std::string_view, 4> endings{".png", ".jpg", ".jpeg", ".bmp"};
    return std::ranges::find(endings, ending_of(file)) != endings.end();
}

/// Deriving one result, part by part.
class Derivation {
public:
    Derivation(PlotResult& result, const fs::path& assets, const Progress& progress)
        : result_(result), settings_(result.settings), assets_(assets), progress_(progress) {}

    void make_path() {
        result_.picture = is_picture(result_.file);
        if (ending_of(result_.file) == ".path") {
            use(plot::read_path(read_file(result_.file), result_.file));
        } else if (result_.picture) {
            cut_picture();
        } else {
            plot::ReaderSettings reading;
            reading.unit = {settings_.plotter_unit, settings_.plotter_unit};
            plot::Plot read = plot::read_hpgl_file(result_.file, reading);
            result_.notices = std::move(read.diagnostics);
            cut_strokes(read.strokes);
        }
        if (result_.path->empty()) {
            throw Error("there is nothing to cut", result_.file);
        }
        if (settings_.plate > 0.0) {
            plot::expect_within_plate(*result_.path, settings_.plate);
        }
    }

    void make_look() {
        const bool strokes = !result_.picture || settings_.use == PictureUse::outlines;
        const plot::ToolTip tip =
            strokes ? plot::ToolTip{.kind = plot::TipKind::flat, .diameter = settings_.strokes.tool_diameter}
                    : settings_.tip;
        const bool cuts = std::ranges::any_of(*result_.path,
                                              [](const plot::CutPoint& point) { return point.at.z() < 0.0; });
        if (!cuts || tip.kind == plot::TipKind::point) {
            return;
        }
        auto look = std::make_shared<plot::HeightField>(
            plot::finished(*result_.path, tip, look_squares, progress_.part(0.5, 0.7)));
        constexpr double spare = 0.5;
        result_.light =
            plot::against_light(*look, spare - static_cast<double>(std::ranges::min(look->z)), light_half);
        result_.look = std::move(look);
    }

    [[nodiscard]] bool has_program() const { return result_.path->size() <= most_points_at_once; }

    void forget_program() { result_.program.clear(); }

    void make_program(const fs::path& folder) {
        progress_.report(0.7, "Writing the program");
        const fs::path file = folder / (result_.file.stem().string() + ".ngc");
        write_file(file, plot_program_text(result_, assets_));
        result_.program = file;
    }

private:
    PlotResult& result_;
    const PlotSettings& settings_;
    const fs::path& assets_;
    const Progress& progress_;

    void cut_picture() {
        plot::PictureSettings reading;
        reading.gray = settings_.gray;
        reading.invert = settings_.invert;
        plot::ReadPicture read = plot::read_picture_file(result_.file, reading, progress_.part(0.0, 0.2));
        result_.notices = std::move(read.notices);
        const plot::Picture& picture = read.picture;
        double pitch = picture.pixels_per_mm ? 1.0 / *picture.pixels_per_mm : thesis_pixel;
        if (settings_.picture_width > 0.0) {
            pitch = settings_.picture_width / picture.width;
        }
        switch (settings_.use) {
        case PictureUse::relief:
            return cut_relief(picture, pitch);
        case PictureUse::outlines:
            return cut_strokes(plot::strokes_of(
                plot::trace(picture, {.threshold = settings_.threshold}), pitch, chord_tolerance));
        case PictureUse::halftone:
            return use(plot::halftone(picture,
                                      pitch,
                                      {.pitch = settings_.dot_pitch,
                                       .tip = settings_.tip,
                                       .plunging = settings_.level.plunging,
                                       .safe_height = settings_.safe_height}));
        case PictureUse::dots:
            break;
        }
        plot::Level level = settings_.level;
        level.depth = settings_.depth;
        use(plot::cut_path(plot::dithered(picture, pitch, {.pitch = settings_.dot_pitch}), cut_of({level})));
    }

    void cut_relief(const plot::Picture& picture, double pitch) {
        plot::ReliefPlan plan;
        plan.relief.tip = settings_.tip;
        plan.relief.step_over = settings_.step_over;
        constexpr double merge = 0.005; // mm: as the command line has it
        plan.relief.merge_tolerance = merge;
        if (settings_.depth_per_pass) {
            plan.relief.roughing = plot::Roughing{.depth_per_pass = *settings_.depth_per_pass};
        }
        plan.relief.cutting = settings_.level.cutting;
        plan.relief.plunging = settings_.level.plunging;
        plan.relief.safe_height = settings_.safe_height;
        plan.plate = settings_.frame;
        use(plot::relief_path(
            plot::height_field(picture, pitch, settings_.depth), plan, progress_.part(0.2, 0.5)));
    }

    [[nodiscard]] plot::CutSettings cut_of(std::vector<plot::Level> levels) const {
        plot::CutSettings cut;
        cut.levels = std::move(levels);
        cut.safe_height = settings_.safe_height;
        cut.change_position.z() = std::max(cut.change_position.z(), cut.safe_height);
        return cut;
    }

    /// Those that are set, and one like `level` for each other pen.
    [[nodiscard]] std::vector<plot::Level> levels_of(const plot::Strokes& strokes) const {
        std::vector<plot::Level> levels;
        for (const plot::Level& usual : plot::levels_for(strokes, settings_.level)) {
            bool set = false;
            for (const plot::Level& level : settings_.levels) {
                if (level.pen == usual.pen) {
                    levels.push_back(level);
                    set = true;
                }
            }
            if (!set) {
                levels.push_back(usual);
            }
        }
        return levels;
    }

    void cut_strokes(const plot::Strokes& drawn) {
        const plot::Strokes planned =
            plot::planned(drawn, settings_.strokes, progress_.part(0.2, 0.4)).strokes;
        result_.drawn_strokes = drawn.size();
        const Vec2 home = Vec2::Zero();
        result_.as_drawn = plot::work_time(drawn, {}, home, home);
        result_.as_planned = plot::work_time(planned, {}, home, home);
        result_.levels = levels_of(planned);
        std::vector<plot::Level> in_order = result_.levels;
        std::ranges::stable_sort(in_order, {}, &plot::Level::order);
        result_.cuts.clear();
        for (const plot::Level& level : in_order) {
            if (level.enabled) {
                result_.cuts.push_back({level.pen, cuts_of(plot::cut_path(planned, cut_of({level})))});
                progress_.check();
            }
        }
        use(plot::cut_path(planned, cut_of(result_.levels)));
        plot::Strokes placed = planned;
        for (plot::Stroke& stroke : placed) {
            for (Vec2& point : stroke.points) {
                point += settings_.origin;
            }
        }
        result_.strokes = std::make_shared<const plot::Strokes>(std::move(placed));
    }

    void use(plot::CutPath path) {
        for (plot::CutPoint& point : path) {
            point.at += Vec3(settings_.origin.x(), settings_.origin.y(), 0.0);
        }
        result_.lengths = plot::lengths(path);
        if (result_.cuts.empty()) {
            result_.cuts.push_back({1, cuts_of(path, Vec2::Zero())});
        }
        result_.air = pieces(path, Vec2::Zero(), [](plot::CutMove move) {
            return move == plot::CutMove::rapid || move == plot::CutMove::retract;
        });
        result_.path = std::make_shared<const plot::CutPath>(std::move(path));
    }

    [[nodiscard]] gcode::PreviewPath cuts_of(const plot::CutPath& path) const {
        return cuts_of(path, settings_.origin);
    }

    [[nodiscard]] static gcode::PreviewPath cuts_of(const plot::CutPath& path, const Vec2& shift) {
        return pieces(path, shift, [](plot::CutMove move) {
            return move == plot::CutMove::plunge || move == plot::CutMove::cut;
        });
    }

    /// The moves of the kind, as pieces that are drawn, and nothing between them.
    template <class Wanted>
    static gcode::PreviewPath pieces(const plot::CutPath& path, const Vec2& shift, const Wanted& wanted) {
        gcode::PreviewPath made;
        gcode::PathChunker chunker;
        const auto add = [&](const plot::CutPoint& point, gcode::PathKind kind) {
            chunker.add({point.at + Vec3(shift.x(), shift.y(), 0.0), 0, kind}, 0.0);
            if (auto chunk = chunker.take_full()) {
                made.chunks.push_back(std::move(chunk));
            }
        };
        bool down = false;
        for (std::size_t n = 1; n < path.size(); ++n) {
            const bool drawn = wanted(path[n].move);
            if (drawn && !down) {
                add(path[n - 1], gcode::PathKind::start);
            }
            if (drawn) {
                add(path[n], gcode::PathKind::feed);
            }
            down = drawn;
        }
        if (auto rest = chunker.take_rest()) {
            made.chunks.push_back(std::move(rest));
        }
        return made;
    }
};

} // namespace

bool is_plot_file(const fs::path& file) {
    constexpr std::array<std::string_view, 4> endings{".plt", ".hpgl", ".hpg", ".path"};
    return is_picture(file) || std::ranges::find(endings, ending_of(file)) != endings.end();
}

std::string plot_program_text(const PlotResult& result, const fs::path& assets) {
    expects(result.path != nullptr, "there is a path to be written");
    const kinematics::MachineModel machine =
        kinematics::read_machine(machine_path(result.settings.machine, result.file.parent_path(), assets));
    const gcode::Program program =
        gcode::plot_program(*result.path,
                            {.machine = machine.name(),
                             .axes = gcode::plot_axes(machine),
                             .header = {"made of: " + result.file.filename().string()},
                             .spindle_rpm = result.settings.spindle_rpm});
    const std::string name = result.file.stem().string();
    const gcode::PostFormat format =
        gcode::read_post(post_path(result.settings.post, result.file.parent_path(), assets));
    return gcode::release(program,
                          machine,
                          format,
                          {.text = {.name = gcode::text_name(name)}, .file = name + "." + format.extension})
        .listing.text;
}

class PlotWorker::Worker {
public:
    Worker(fs::path assets, std::function<void()> wake)
        : assets_(std::move(assets)), wake_(std::move(wake)), background_(wake_) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        background_.clear();
        background_.wait_idle();
        std::error_code ignored;
        if (!folder_.empty()) {
            fs::remove_all(folder_, ignored);
        }
    }

    void request(PlotResult start) {
        background_.replace(
            [this, start = std::move(start)](const Progress& progress) mutable { derive(start, progress); });
    }
    void cancel() { background_.clear(); }

    [[nodiscard]] std::shared_ptr<const PlotResult> latest() const {
        const std::scoped_lock lock(mutex_);
        return latest_;
    }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    void publish(const PlotResult& now) {
        auto copy = std::make_shared<PlotResult>(now);
        {
            const std::scoped_lock lock(mutex_);
            copy->revision = ++revision_;
            latest_ = std::move(copy);
        }
        wake_();
    }

    /// For the programs of this worker alone.
    void make_folder() {
        if (!folder_.empty()) {
            return;
        }
        std::error_code failure;
        std::string place = (fs::temp_directory_path(failure) / "millwright-plot-XXXXXX").string();
        if (failure || ::mkdtemp(place.data()) == nullptr) {
            throw Error("a folder for the program cannot be made", place);
        }
        folder_ = place;
    }

    void derive(PlotResult& now, const Progress& progress) {
        progress.report(0.0, "Cutting " + now.file.filename().string());
        Derivation derivation(now, assets_, progress);
        try {
            derivation.make_path();
            publish(now);
            progress.check();
            derivation.make_look();
            publish(now);
            progress.check();
            if (derivation.has_program()) {
                make_folder();
                derivation.make_program(folder_);
            } else {
                derivation.forget_program();
            }
        } catch (const Error& error) {
            now.failure = error.diagnostic();
            now.program.clear();
        }
        progress.check(); // nobody wants it any more: what is there stays
        now.finished = true;
        publish(now);
    }

    fs::path assets_;
    fs::path folder_; ///< of the worker's thread; empty before its first program
    std::function<void()> wake_;
    mutable std::mutex mutex_; ///< guards what follows
    std::shared_ptr<const PlotResult> latest_;
    std::uint64_t revision_ = 0;
    Background background_; // last: its thread ends before the rest goes
};

PlotWorker::PlotWorker(fs::path assets, std::function<void()> wake)
    : worker_(std::make_unique<Worker>(std::move(assets), std::move(wake))) {}

PlotWorker::~PlotWorker() = default;

void PlotWorker::request(const fs::path& file, const PlotSettings& settings) {
    PlotResult start;
    start.file = file;
    start.settings = settings;
    if (const auto before = latest(); before && before->file == file) {
        start.program = before->program; // can be played until the new one is there
    }
    worker_->request(std::move(start));
}

void PlotWorker::cancel() {
    worker_->cancel();
}

std::shared_ptr<const PlotResult> PlotWorker::latest() const {
    return worker_->latest();
}

Activity PlotWorker::activity() const {
    return worker_->activity();
}

void PlotWorker::wait_idle() const {
    worker_->wait_idle();
}

} // namespace millwright::project
