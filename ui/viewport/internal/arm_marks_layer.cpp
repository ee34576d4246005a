// What is drawn around an arm: how far it reaches, the ranges of its joints, where it would go, where its
// tool has been and shall go, and how the tool stands.

#include "core/arm/arm_forward.h"
#include "core/base/units.h"
#include "ui/viewport/internal/arm_buffers.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/thin_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::viewport {

namespace {

using arm::JointPositions;

constexpr double frame_share = 0.11; // axes of the tool, to the reach
constexpr double ring_share = 0.13;  // radius of a joint's range, to the reach
constexpr double meridian_step = 30.0 * pi / 180.0;
constexpr double parallel_spacing = 0.34; // of the reach, between two circles of the shell
constexpr float ghost_opacity = 0.30F;

std::vector<Vec3> turned(const std::vector<Vec2>& border, double angle) {
    std::vector<Vec3> points;
    for (const Vec2& place : border) {
        points.emplace_back(place.x() * std::cos(angle), place.x() * std::sin(angle), place.y());
    }
    return points;
}

std::vector<Vec3> circle(const Vec2& place, double first, double last) {
    std::vector<Vec3> points;
    const int steps = std::max(8, static_cast<int>(std::ceil((last - first) / (pi / 48.0))));
    for (int n = 0; n <= steps; ++n) {
        const double angle = first + (last - first) * n / steps;
        points.emplace_back(place.x() * std::cos(angle), place.x() * std::sin(angle), place.y());
    }
    return points;
}

/// Meridians and parallels of the reach.
std::vector<std::vector<Vec3>> shell_curves(const ArmLook& look) {
    const arm::ReachShell& shell = *look.shell;
    std::vector<std::vector<Vec3>> curves;
    const auto meridians =
        std::max(1, static_cast<int>(std::round((shell.last - shell.first) / meridian_step)));
    for (const auto& border : shell.border) {
        for (int n = 0; n <= meridians; ++n) {
            curves.push_back(turned(border, shell.first + (shell.last - shell.first) * n / meridians));
        }
        double since = 0.0;
        for (std::size_t n = 1; n < border.size(); ++n) {
            since += (border[n] - border[n - 1]).norm();
            if (since > parallel_spacing * look.reach) {
                curves.push_back(circle(border[n], shell.first, shell.last));
                since = 0.0;
            }
        }
    }
    return curves;
}

enum Kind { nothing, plain, troubled };

/// Smooth for a picture that rests, thin for one that moves. More pieces than `most_smooth` are always thin:
/// without a graphics card a picture with 10,000 smooth ones takes half a second.
struct Drawn {
    render::LineBuffer smooth;
    ThinLines thin;
};
constexpr std::size_t most_smooth = 4000;

bool drawn_thin(const Canvas& canvas, const render::LineBuffer& smooth) {
    return canvas.edges == render::Edges::rough || smooth.segment_count() == 0;
}

render::LineBuffer smooth_lines(const std::vector<render::LineVertex>& lines) {
    return lines.size() <= 2 * most_smooth ? render::LineBuffer(lines, render::LineTopology::segments)
                                           : render::LineBuffer();
}

Drawn drawn(const std::vector<std::vector<Vec3>>& curves) {
    std::vector<render::LineVertex> lines;
    std::vector<Vec3> points;
    std::vector<int> kinds;
    for (const std::vector<Vec3>& curve : curves) {
        if (curve.empty()) {
            continue;
        }
        append(lines, curve);
        points.insert(points.end(), curve.begin(), curve.end());
        kinds.resize(points.size(), plain);
        kinds[points.size() - curve.size()] = nothing; // the way from one curve to the next
    }
    return {smooth_lines(lines), ThinLines(points, [&](std::size_t n) { return kinds[n]; })};
}

render::LineBuffer track_lines(const ArmTrack& track, const render::ViewColors& colors) {
    std::vector<render::LineVertex> lines;
    for (std::size_t n = 1; n < track.tips.size(); ++n) {
        const bool free = track.troubles[n] == arm::ArmTrouble::none;
        append(lines,
               std::array{track.tips[n - 1], track.tips[n]},
               with_opacity(free ? colors.good : colors.danger, 1.0F));
    }
    return smooth_lines(lines);
}

class ArmMarksLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (!scene.arm) {
            return;
        }
        ghost_.follow(scene.arm->look);
        if (scene.arm->look != look_) {
            look_ = scene.arm->look;
            shell_ = look_->shell ? drawn(shell_curves(*look_)) : Drawn();
        }
        if (scene.arm->trace != trace_of_) {
            trace_of_ = scene.arm->trace;
            trace_ = trace_of_ && !trace_of_->empty() ? drawn({*trace_of_}) : Drawn();
        }
        if (scene.arm->track != track_of_) {
            track_of_ = scene.arm->track;
            thin_track_ =
                track_of_
                    ? ThinLines(track_of_->tips,
                                [this](std::size_t n) {
                                    return track_of_->troubles[n] == arm::ArmTrouble::none ? plain : troubled;
                                })
                    : ThinLines();
            for (const auto theme : {render::Theme::dark, render::Theme::light}) {
                tracks_[static_cast<std::size_t>(theme)] =
                    track_of_ ? track_lines(*track_of_, render::view_colors(theme)) : render::LineBuffer();
            }
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.arm) {
            return;
        }
        if (scene.layers.arm.reach) {
            draw_shell(canvas, scene.arm->joints);
        }
        if (scene.arm->ghost) {
            ghost_.draw(canvas,
                        *scene.arm->ghost,
                        {.color = canvas.colors.accent,
                         .opacity = ghost_opacity,
                         .depth = render::Depth::ghost,
                         .moving_only = true});
        }
        if (scene.layers.arm.joint_limits) {
            draw_ranges(canvas, scene.arm->joints);
        }
        draw_paths(scene, canvas);
        const auto& grip = canvas.highlight.arm;
        if (scene.layers.path.intended && scene.arm->part) {
            draw_frame(canvas, *scene.arm->part, grip && grip->is_part());
        }
        if (scene.layers.arm.tool_frame) {
            draw_frame(canvas, arm::base_T_tool(look_->arm(), scene.arm->joints), grip && grip->is_tip());
        }
    }

    [[nodiscard]] std::vector<Label> labels(const Scene& scene, const Canvas& canvas) const override {
        std::vector<Label> all;
        if (scene.arm && scene.layers.arm.tool_frame) {
            constexpr std::array names{"x", "y", "z"};
            const std::array colors{canvas.colors.axis_x, canvas.colors.axis_y, canvas.colors.axis_z};
            const Frame tool = arm::base_T_tool(look_->arm(), scene.arm->joints);
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 end =
                    tool * Vec3(1.18 * frame_share * look_->reach * Vec3::Unit(static_cast<Eigen::Index>(k)));
                all.push_back({render::to_glm(end), names[k], colors[k], true});
            }
        }
        return all;
    }

private:
    void draw_shell(const Canvas& canvas, const JointPositions& joints) const {
        const glm::vec4 faint = with_opacity(canvas.colors.rapid, 0.22F);
        if (drawn_thin(canvas, shell_.smooth)) {
            shell_.thin.draw(canvas, {glm::vec4(0.0F), faint});
        } else {
            canvas.painter.lines(
                shell_.smooth,
                {.coloring = {.color = faint}, .width_px = 1.0F, .depth = render::Depth::ghost},
                canvas.view);
        }
        if (!look_->shell) {
            return;
        }
        std::vector<render::LineVertex> lines; // in the plane where the arm is
        for (const auto& border : look_->shell->border) {
            append(lines, turned(border, joints[0]));
        }
        canvas.painter.lines(
            render::LineBuffer(lines, render::LineTopology::segments),
            {.coloring = {.color = with_opacity(canvas.colors.rapid, 0.95F)}, .width_px = 1.6F},
            canvas.view);
    }

    /// An arc or a line for each joint's range, the part that is left behind in the neutral colour, a mark at
    /// its position; all in the signal colour of warnings near a limit.
    void draw_ranges(const Canvas& canvas, const JointPositions& joints) const {
        const arm::ArmModel& arm = look_->arm();
        JointPositions at = joints;
        for (int n = 0; n < arm.joint_count(); ++n) {
            const arm::ArmJoint& joint = arm.joint(n);
            const glm::vec3 color =
                near_limit(joint, joints[n]) ? canvas.colors.warning : canvas.colors.neutral[5];
            const double low = std::isfinite(joint.min) ? joint.min : joints[n] - pi;
            const double high = std::isfinite(joint.max) ? joint.max : joints[n] + pi;
            // Of joints with one centre each has a ring of its own.
            const double radius = ring_share * look_->reach * (1.0 - 0.12 * (n % 3));
            const auto mark = [&](double position, double along) -> Vec3 {
                at[n] = position;
                const Frame frame = arm::base_T_joints(arm, at)[static_cast<std::size_t>(n)];
                return frame * Vec3(joint.kind == arm::JointKind::revolute ? along * radius : 0.0, 0.0, 0.0);
            };
            std::vector<Vec3> arc;
            const int steps = 48;
            for (int k = 0; k <= steps; ++k) {
                arc.push_back(mark(low + (high - low) * k / steps, 1.0));
            }
            std::vector<render::LineVertex> lines, needle;
            append(lines, arc);
            append(lines, std::array{mark(low, 0.86), mark(low, 1.14)});
            append(lines, std::array{mark(high, 0.86), mark(high, 1.14)});
            append(needle, std::array{mark(joints[n], 0.78), mark(joints[n], 1.22)});
            at[n] = joints[n];
            draw_over(canvas, lines, color, 1.5F);
            draw_over(canvas, needle, canvas.colors.accent, 3.0F);
        }
    }

    static void draw_over(const Canvas& canvas,
                          const std::vector<render::LineVertex>& lines,
                          const glm::vec3& color,
                          float width_px) {
        canvas.painter.lines(render::LineBuffer(lines, render::LineTopology::segments),
                             {.coloring = {.color = with_opacity(color, 0.95F)},
                              .width_px = width_px,
                              .depth = render::Depth::overlay},
                             canvas.view);
    }

    void draw_paths(const Scene& scene, const Canvas& canvas) const {
        if (scene.layers.path.trace) {
            draw_trace(canvas);
        }
        if (scene.layers.path.intended) {
            draw_track(canvas);
        }
    }

    void draw_trace(const Canvas& canvas) const {
        const glm::vec4 color = with_opacity(canvas.colors.selected, 1.0F);
        if (drawn_thin(canvas, trace_.smooth)) {
            return trace_.thin.draw(canvas, {glm::vec4(0.0F), color});
        }
        draw_seamed(canvas, trace_.smooth, {.coloring = {.color = color}, .width_px = 2.0F}, canvas.view);
    }

    void draw_track(const Canvas& canvas) const {
        const render::LineBuffer& smooth = tracks_[static_cast<std::size_t>(canvas.colors.theme)];
        if (drawn_thin(canvas, smooth)) {
            return thin_track_.draw(canvas,
                                    {glm::vec4(0.0F),
                                     with_opacity(canvas.colors.good, 1.0F),
                                     with_opacity(canvas.colors.danger, 1.0F)});
        }
        draw_seamed(
            canvas, smooth, {.coloring = {.from = render::ColorFrom::vertex}, .width_px = 2.0F}, canvas.view);
    }

    void draw_frame(const Canvas& canvas, const Frame& frame, bool held) const {
        const std::array colors{canvas.colors.axis_x, canvas.colors.axis_y, canvas.colors.axis_z};
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<render::LineVertex> axis;
            const Vec3 end =
                frame * Vec3(frame_share * look_->reach * Vec3::Unit(static_cast<Eigen::Index>(k)));
            append(axis, std::array{Vec3(frame.translation()), end});
            draw_over(canvas, axis, colors[k], 3.0F);
        }
        const std::array<render::PointVertex, 1> tip{{{.position = render::to_float(frame.translation())}}};
        canvas.painter.points(render::PointBuffer(tip),
                              {.coloring = {.color = with_opacity(canvas.colors.handle, 1.0F)},
                               .size_px = held ? 17.0F : 13.0F,
                               .ring_px = 2.0F,
                               .depth = render::Depth::overlay},
                              canvas.view);
    }

    ArmBuffers ghost_;
    std::shared_ptr<const ArmLook> look_;
    std::shared_ptr<const std::vector<Vec3>> trace_of_;
    std::shared_ptr<const ArmTrack> track_of_;
    Drawn shell_, trace_;
    ThinLines thin_track_;
    std::array<render::LineBuffer, 2> tracks_; ///< by theme
};

} // namespace

std::unique_ptr<Layer> make_arm_marks_layer() {
    return std::make_unique<ArmMarksLayer>();
}

} // namespace millwright::viewport
