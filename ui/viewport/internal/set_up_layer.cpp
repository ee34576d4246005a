// The map of what the places of the part on the table cost, as a plane beside the part: a point of it is
// where the middle of the part would come. With it the border of the part at the place that is marked.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <vector>

namespace millwright::viewport {

namespace {

using toolpath::SetUpParameter;
using toolpath::SetUpPlace;

constexpr int map_border_steps = 60;
constexpr double beside_share = 0.08; // of the part's diagonal: between the part and the plane

Eigen::Index index(SetUpParameter parameter) {
    return static_cast<Eigen::Index>(parameter);
}

/// Where `place` would bring a point of the part that is at `p` now.
Vec3 moved_with_part(const Vec3& p, const SetUpPlace& now, const SetUpPlace& place) {
    const Eigen::AngleAxisd turn(place[3] - now[3], Vec3::UnitZ());
    return turn * p + (place - now).head<3>();
}

/// A point beside the part from which the map is laid out: the place `now` is there.
Vec3 anchor(const Box3& part, SetUpParameter across, SetUpParameter up) {
    Vec3 at = part.center();
    const double away = beside_share * part.diagonal().norm();
    if (across != SetUpParameter::c && up != SetUpParameter::c) {
        at.z() = part.min().z() - away;
    } else if (across != SetUpParameter::b && up != SetUpParameter::b) {
        at.y() = part.max().y() + away;
    } else {
        at.x() = part.max().x() + away;
    }
    return at;
}

class SetUpLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const bool same = made_from_ == scene.set_up && cutting_setup_ == scene.cutting_setup &&
                          place_.isApprox(scene.set_up_place, 0.0);
        if (!scene.layers.machine.set_up_map || same) {
            return;
        }
        made_from_ = scene.set_up;
        cutting_setup_ = scene.cutting_setup;
        place_ = scene.set_up_place;
        map_ = {};
        border_ = {};
        mark_ = {};
        corners_.clear();
        shown_ = made_from_ && made_from_->study && cutting_setup_;
        if (shown_) {
            now_ = made_from_->now;
            now_.head<3>() = cutting_setup_->machine.description().workpiece_offset;
            make_border();
            make_map();
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.machine.set_up_map || !shown_) {
            return;
        }
        if (has_plane_) {
            canvas.painter.mesh(
                map_,
                {.coloring = {.from = render::ColorFrom::value, .scale = set_up_colors(scene)},
                 .model = canvas.s_T_w,
                 .back_color = {},
                 .highlight = 0.0F},
                canvas.view);
            draw_mark(canvas);
        }
        canvas.painter.lines(border_,
                             {.coloring = {.color = with_opacity(canvas.colors.selected, 1.0F)},
                              .model = canvas.s_T_w,
                              .width_px = 2.0F},
                             canvas.view);
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return scene.layers.machine.set_up_map && shown_ ? moved(corners_, scene_from_workpiece(scene))
                                                         : std::vector<glm::dvec3>{};
    }

private:
    void make_border() {
        std::vector<render::LineVertex> border;
        const std::array<Vec2, 5> corners{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(0, 0)};
        for (std::size_t side = 0; side + 1 < corners.size(); ++side) {
            for (int k = 0; k < map_border_steps; ++k) {
                for (const int end : {k, k + 1}) {
                    const double t = static_cast<double>(end) / map_border_steps;
                    const Vec2 uv = (1.0 - t) * corners[side] + t * corners[side + 1];
                    const Vec3 p = cutting_setup_->patch.position(uv.x(), uv.y());
                    border.push_back({.position = render::to_float(moved_with_part(p, now_, place_))});
                }
            }
        }
        border_ = render::LineBuffer(border, render::LineTopology::segments);
        for (const Vec2& corner : corners) {
            const Vec3 p = cutting_setup_->patch.position(corner.x(), corner.y());
            corners_.push_back(moved_with_part(p, now_, place_));
        }
    }

    void make_map() {
        const toolpath::SetUpMap& map = made_from_->study->map;
        has_plane_ = map.across != SetUpParameter::turn && map.up != SetUpParameter::turn;
        if (!has_plane_) {
            return;
        }
        const Vec3 from = anchor(cutting_setup_->patch.control_box(), map.across, map.up);
        const auto at = [&](double x, double y) {
            Vec3 p = from;
            p[index(map.across)] += x - now_[index(map.across)];
            p[index(map.up)] += y - now_[index(map.up)];
            return p;
        };
        std::vector<render::MeshVertex> vertices;
        for (std::size_t row = 0; row < map.y.size(); ++row) {
            for (std::size_t column = 0; column < map.x.size(); ++column) {
                const double cost = map.costs[row * map.x.size() + column];
                vertices.push_back({.position = render::to_float(at(map.x[column], map.y[row])),
                                    .normal = {0.0F, 0.0F, 1.0F},
                                    .value = static_cast<float>(cost)});
            }
        }
        map_ = render::MeshBuffer(vertices, triangles_of(map));
        for (const double x : {map.x.front(), map.x.back()}) {
            for (const double y : {map.y.front(), map.y.back()}) {
                corners_.push_back(at(x, y));
            }
        }
        const std::vector<render::PointVertex> marked{
            {.position = render::to_float(at(place_[index(map.across)], place_[index(map.up)]))}};
        mark_ = render::PointBuffer(marked);
    }

    /// Cells between four places that can be reached.
    static std::vector<std::uint32_t> triangles_of(const toolpath::SetUpMap& map) {
        std::vector<std::uint32_t> triangles;
        const std::size_t columns = map.x.size();
        for (std::size_t row = 0; row + 1 < map.y.size(); ++row) {
            for (std::size_t column = 0; column + 1 < columns; ++column) {
                const std::size_t k = row * columns + column;
                bool whole = true;
                for (const std::size_t corner : {k, k + 1, k + columns, k + columns + 1}) {
                    whole = whole && std::isfinite(map.costs[corner]);
                }
                for (const std::size_t corner :
                     {k, k + 1, k + columns + 1, k, k + columns + 1, k + columns}) {
                    if (whole) {
                        triangles.push_back(static_cast<std::uint32_t>(corner));
                    }
                }
            }
        }
        return triangles;
    }

    void draw_mark(const Canvas& canvas) const {
        canvas.painter.points(mark_,
                              {.coloring = {.color = with_opacity(canvas.colors.selected, 1.0F)},
                               .model = canvas.s_T_w,
                               .size_px = 11.0F,
                               .ring_px = 2.0F,
                               .ring_color = with_opacity(canvas.colors.background_bottom, 1.0F),
                               .depth = render::Depth::ghost},
                              canvas.view);
    }

    std::shared_ptr<const plan::SetUpResult> made_from_;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    SetUpPlace place_ = SetUpPlace::Zero();
    SetUpPlace now_ = SetUpPlace::Zero();
    bool shown_ = false;
    bool has_plane_ = false;
    render::MeshBuffer map_;
    render::LineBuffer border_;
    render::PointBuffer mark_;
    std::vector<Vec3> corners_;
};

} // namespace

std::unique_ptr<Layer> make_set_up_layer() {
    return std::make_unique<SetUpLayer>();
}

} // namespace millwright::viewport
