#include "core/simulation/internal/tile_cutter.h"

#include <algorithm>
#include <cmath>

namespace millwright::simulation {

ReadyStep::ReadyStep(const CutStep& cut, double half_tile)
    : step(&cut), cutter(cut.cutter->body, cut.from, cut.to), middle(cutter.pose(0.5)),
      bounds(cutter.bounds()), near_line(cut.cutter->body.grown(cutter.half_motion())),
      near_tile(cut.cutter->body.grown(cutter.half_motion() + half_tile)) {
    if (cut.contact_counts) {
        core.emplace(cut.cutter->core, cut.from, cut.to);
    }
}

TileCutter::TileCutter(DexelField& field, int k, int i, int j)
    : field_(field), tile_(field.tile(k, i, j)), k_(k), u_((k + 1) % 3), v_((k + 2) % 3),
      face_(field.box().min()[k]), first_u_(i * Tile::side), first_v_(j * Tile::side),
      count_u_(std::min(Tile::side, field.count()[static_cast<std::size_t>(u_)] - first_u_)),
      count_v_(std::min(Tile::side, field.count()[static_cast<std::size_t>(v_)] - first_v_)) {
    center_[k_] = 0.0;
    center_[u_] = field.middle(u_, first_u_) + 0.5 * (count_u_ - 1) * field.cell()[u_];
    center_[v_] = field.middle(v_, first_v_) + 0.5 * (count_v_ - 1) * field.cell()[v_];
}

/// Coordinates from the box's lower face.
bool TileCutter::is_void(const Interval& range) const {
    const auto from = static_cast<float>(range.from - face_);
    const auto to = static_cast<float>(range.to - face_);
    return to <= tile_.low || from >= tile_.high || (from >= tile_.void_from && to <= tile_.void_to);
}

bool TileCutter::may_reach(const ReadyStep& step) const {
    if (is_void({step.bounds.min()[k_], step.bounds.max()[k_]})) {
        return false;
    }
    Vec3 at = center_;
    at[k_] = step.middle.tip[k_];
    const auto range = step.near_tile.crossing(step.middle.tip, step.middle.axis, at, k_);
    return range && !is_void({range->enter, range->leave});
}

/// The part of a line that the step removes, where it has material near.
std::optional<Interval> TileCutter::reached(const ReadyStep& step, std::size_t line, const Vec3& at) const {
    const auto near = step.near_line.crossing(step.middle.tip, step.middle.axis, at, k_);
    if (!near) {
        return std::nullopt;
    }
    const auto from = static_cast<float>(near->enter - face_);
    const auto to = static_cast<float>(near->leave - face_);
    Interval material{0.0, -1.0};
    for (const Dexel& piece : tile_.line(line)) {
        if (piece.from < to && piece.to > from) {
            material.from =
                material.to < material.from ? face_ + static_cast<double>(piece.from) : material.from;
            material.to = face_ + static_cast<double>(piece.to);
        }
    }
    return material.from < material.to ? step.cutter.swept(at, k_, material) : std::nullopt;
}

void TileCutter::touch(const ReadyStep& step, std::size_t line, const Vec3& at, TileCut& found) const {
    const auto met = step.core->swept(at, k_);
    if (!met) {
        return;
    }
    for (const Dexel& piece : tile_.line(line)) {
        const double from = std::max(static_cast<double>(piece.from), met->from - face_);
        const double to = std::min(static_cast<double>(piece.to), met->to - face_);
        const double length = to - from;
        if (length > 0.0 && (!found.contact || length > found.contact->length)) {
            Vec3 place = at;
            place[k_] = face_ + 0.5 * (from + to);
            found.contact = Contact{length, place};
        }
    }
}

void TileCutter::subtract(std::size_t line, const Interval& cut, std::int32_t move, TileCut& found) {
    const auto from = static_cast<float>(cut.from - face_);
    const auto to = static_cast<float>(cut.to - face_);
    constexpr float sliver = 1e-6F; // mm: shorter pieces are rounding
    for (const Dexel& piece : tile_.line(line)) {
        if (piece.to <= from || piece.from >= to) {
            next_.push_back(piece);
            continue;
        }
        found.length += static_cast<double>(std::min(piece.to, to) - std::max(piece.from, from));
        if (from - piece.from > sliver) {
            next_.push_back({piece.from, from, piece.from_move, move});
        }
        if (piece.to - to > sliver) {
            next_.push_back({to, piece.to, move, piece.to_move});
        }
    }
}

void TileCutter::replace_lines(float middle) {
    tile_.dexels.assign(next_.begin(), next_.end());
    tile_.first = next_first_;
    tile_.look(middle);
}

bool TileCutter::cut(const ReadyStep& step, TileCut& found) {
    if (!may_reach(step)) {
        return false;
    }
    found = {.move = step.step->move};
    next_.clear();
    for (int j = 0; j < Tile::side; ++j) {
        for (int i = 0; i < Tile::side; ++i) {
            const auto line = static_cast<std::size_t>(j * Tile::side + i);
            next_first_[line] = static_cast<std::uint32_t>(next_.size());
            const auto pieces = tile_.line(line);
            if (pieces.empty()) {
                continue;
            }
            Vec3 at;
            at[k_] = step.middle.tip[k_];
            at[u_] = field_.middle(u_, first_u_ + i);
            at[v_] = field_.middle(v_, first_v_ + j);
            const auto removed = reached(step, line, at);
            if (!removed) {
                next_.insert(next_.end(), pieces.begin(), pieces.end());
                continue;
            }
            if (step.core) {
                touch(step, line, at, found);
            }
            if (!step.step->removes) {
                continue;
            }
            subtract(line, *removed, step.step->move, found);
        }
    }
    if (!step.step->removes) {
        return found.contact.has_value();
    }
    if (!(found.length > 0.0)) {
        return false;
    }
    next_first_[Tile::lines] = static_cast<std::uint32_t>(next_.size());
    const double middle = 0.5 * (step.bounds.min()[k_] + step.bounds.max()[k_]) - face_;
    replace_lines(static_cast<float>(middle));
    return true;
}

} // namespace millwright::simulation
