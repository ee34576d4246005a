#include "core/simulation/internal/tile_cutter.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace millwright::simulation {

namespace {

Vec3 across_of(const Vec3& axis, const Vec3& way) {
    const Vec3 across = axis.cross(way);
    constexpr double along = 1e-9; // of a plunge any direction is as good
    return across.norm() > along * way.norm() ? Vec3(across.normalized()) : axis.unitOrthogonal();
}

BodyRay grown_by_tile(const ReadyStep& step, const Vec3& cell, int k) {
    const double half = 0.5 * Tile::side * std::hypot(cell[(k + 1) % 3], cell[(k + 2) % 3]);
    return step.cutter.body().grown(step.cutter.half_motion() + half);
}

template <class Work> void for_each_bit(std::uint64_t bits, const Work& work) {
    for (; bits != 0; bits &= bits - 1) {
        work(static_cast<std::size_t>(std::countr_zero(bits)));
    }
}

/// Turns that are convex nearly enough in two parts, rad (0.6 degrees); so SweptCutter.
constexpr double fine_turn = 0.0105;

int parts_of(const TileMotion& motion) {
    constexpr double nearly_parallel = 0.999; // cosine of 2.6 degrees
    const int turns = static_cast<int>(std::ceil(motion.turn / fine_turn));
    return std::max(1, std::abs(motion.middle[2]) < nearly_parallel ? 2 * turns : 6 * turns);
}

/// What up to eight lines meet at one moment of the step.
struct LaneMoment {
    double f = 0.0;
    std::array<std::array<double, Tile::side>, 2> value{}, rate{};
};

/// Between two moments, where the value of lane `n` falls and rises again, or its line misses. False where
/// there is nothing to search.
bool places_search(
    const LaneMoment& left, const LaneMoment& right, std::size_t end, std::size_t n, LaneSearch& search) {
    const bool left_hit = left.value[end][n] < missed, right_hit = right.value[end][n] < missed;
    const bool falls = left_hit && left.rate[end][n] < 0.0;
    const bool rises = right_hit && right.rate[end][n] > 0.0;
    if (falls && (rises || !right_hit)) {
        search.left_f = left.f;
        search.left_value = left.value[end][n];
        search.left_rate = left.rate[end][n];
        search.right_f = right.f;
        search.right_value = right.value[end][n];
        search.right_rate = right.rate[end][n];
    } else if (rises && !left_hit) {
        search.left_f = right.f;
        search.left_value = right.value[end][n];
        search.left_rate = right.rate[end][n];
        search.right_f = left.f;
        search.mirrored = -1.0;
    } else {
        return false;
    }
    search.far_end = static_cast<double>(end);
    return true;
}

} // namespace

ReadyStep::ReadyStep(const CutStep& cut, const Vec3& cell)
    : step(&cut), cutter(cut.cutter->body, cut.from, cut.to), middle(cutter.pose(0.5)),
      across(across_of(middle.axis, cut.to.tip - cut.from.tip)), bounds(cutter.bounds()),
      near_line(cut.cutter->body.grown(cutter.half_motion())),
      motions{TileMotion(cutter.body().zones(), cutter.motion(), 0),
              TileMotion(cutter.body().zones(), cutter.motion(), 1),
              TileMotion(cutter.body().zones(), cutter.motion(), 2)},
      near_tile{grown_by_tile(*this, cell, 0), grown_by_tile(*this, cell, 1), grown_by_tile(*this, cell, 2)} {
    if (cut.contact_counts) {
        core.emplace(cut.cutter->core, cut.from, cut.to);
    }
}

/// A line that needs a search.
struct TileCutter::Pending {
    std::size_t line = 0;
    std::array<double, 2> enough{};
    std::array<double, 2> least{missed, missed};
    std::array<bool, 2> settled{};
};

TileCutter::~TileCutter() = default;

TileCutter::TileCutter(DexelField& field, int k, int i, int j)
    : field_(field), tile_(field.tile(k, i, j)), k_(k), u_((k + 1) % 3), v_((k + 2) % 3),
      face_(field.box().min()[k]), first_u_(i * Tile::side), first_v_(j * Tile::side),
      count_u_(std::min(Tile::side, field.count()[static_cast<std::size_t>(u_)] - first_u_)),
      count_v_(std::min(Tile::side, field.count()[static_cast<std::size_t>(v_)] - first_v_)) {
    center_[k_] = 0.0;
    center_[u_] = field.middle(u_, first_u_) + 0.5 * (count_u_ - 1) * field.cell()[u_];
    center_[v_] = field.middle(v_, first_v_) + 0.5 * (count_v_ - 1) * field.cell()[v_];
    for (int n = 0; n < Tile::side; ++n) {
        lines_.u[n] = field.middle(u_, first_u_ + n);
        lines_.v[n] = field.middle(v_, first_v_ + n);
    }
}

/// Coordinates from the box's lower face.
bool TileCutter::is_void(const Interval& range) const {
    const auto from = static_cast<float>(range.from - face_);
    const auto to = static_cast<float>(range.to - face_);
    return to <= tile_.low || from >= tile_.high || (from >= tile_.void_from && to <= tile_.void_to);
}

bool TileCutter::may_reach(const ReadyStep& step) const {
    const Vec3& cell = field_.cell();
    const SweptOutline& outline = step.motions[static_cast<std::size_t>(k_)].outline;
    if (!outline.meets_rectangle(
            center_[u_], center_[v_], 0.5 * (count_u_ - 1) * cell[u_], 0.5 * (count_v_ - 1) * cell[v_])) {
        return false;
    }
    if (is_void({step.bounds.min()[k_], step.bounds.max()[k_]})) {
        return false;
    }
    Vec3 at = center_;
    at[k_] = step.middle.tip[k_];
    const auto range =
        step.near_tile[static_cast<std::size_t>(k_)].crossing(step.middle.tip, step.middle.axis, at, k_);
    return range && !is_void({range->enter, range->leave});
}

/// Of the lines that the outline covers, between the step's bounds.
bool TileCutter::find_material(const ReadyStep& step) {
    tile_sweep().outline(step.motions[static_cast<std::size_t>(k_)], lines_);
    std::fill_n(lines_.from, Tile::lines, 0.0);
    std::fill_n(lines_.to, Tile::lines, -1.0);
    bool some = false;
    for_each_bit(lines_.reached, [&](std::size_t line) {
        const Interval found = material(line, step.bounds.min()[k_], step.bounds.max()[k_]);
        lines_.from[line] = found.from;
        lines_.to[line] = found.to;
        some = some || found.from < found.to;
    });
    return some;
}

/// Around the pieces of a line that have a part between `from` and `to`; from > to where none has.
Interval TileCutter::material(std::size_t line, double from, double to) const {
    const auto low = static_cast<float>(from - face_);
    const auto high = static_cast<float>(to - face_);
    Interval found{0.0, -1.0};
    for (const Dexel& piece : tile_.line(line)) {
        if (piece.from < high && piece.to > low) {
            found.from = found.to < found.from ? face_ + static_cast<double>(piece.from) : found.from;
            found.to = face_ + static_cast<double>(piece.to);
        }
    }
    return found;
}

Vec3 TileCutter::place_of(const ReadyStep& step, std::size_t line) const {
    Vec3 at;
    at[k_] = step.middle.tip[k_];
    at[u_] = lines_.u[line % Tile::side];
    at[v_] = lines_.v[line / Tile::side];
    return at;
}

/// Decides a line, or leaves it to the search.
void TileCutter::settle(const ReadyStep& step, std::size_t line) {
    cuts_[line] = {0.0, -1.0};
    const std::array<double, 2> value{lines_.least[0][line], lines_.least[1][line]};
    std::array<double, 2> bound{lines_.bound[0][line], lines_.bound[1][line]};
    if (!(value[0] < missed)) {
        const auto near =
            step.near_line.crossing(step.middle.tip, step.middle.axis, place_of(step, line), k_);
        if (!near || !step.cutter.motion().moves) {
            return;
        }
        bound = {near->enter, -near->leave};
    }
    const Interval there = material(line, bound[0], -bound[1]);
    if (!(there.from < there.to)) {
        return;
    }
    const std::array<double, 2> enough{there.from, -there.to};
    std::array<bool, 2> settled{};
    for (std::size_t end = 0; end < 2; ++end) {
        settled[end] = value[end] - bound[end] < sweep_tolerance || value[end] <= enough[end];
    }
    if (settled[0] && settled[1]) {
        cuts_[line] = {value[0], -value[1]};
    } else {
        pending_.push_back({line, enough, value, settled});
    }
}

/// Up to eight lines at moments between the ends of the step; where the value falls and rises again, or the
/// line misses, a search begins.
void TileCutter::attempt_between(const TileMotion& motion, Pending* pending, std::size_t count) {
    LaneMoment left, right;
    LaneTries tries;
    for (std::size_t n = 0; n < Tile::side; ++n) {
        const std::size_t line = pending[std::min(n, count - 1)].line;
        tries.u[n] = lines_.u[line % Tile::side];
        tries.v[n] = lines_.v[line / Tile::side];
        for (std::size_t end = 0; end < 2; ++end) {
            left.value[end][n] = lines_.at[0][end].value[line];
            left.rate[end][n] = lines_.at[0][end].rate[line];
        }
    }
    const int parts = parts_of(motion);
    for (int part = 1; part <= parts; ++part) {
        right.f = part == parts ? 1.0 : static_cast<double>(part) / parts;
        if (part < parts) {
            tile_sweep().attempt(motion, right.f, tries);
        }
        for (std::size_t n = 0; n < count; ++n) {
            Pending& of = pending[n];
            for (std::size_t end = 0; end < 2; ++end) {
                const LaneInstant& last = lines_.at[1][end];
                right.value[end][n] = part < parts ? tries.value[end][n] : last.value[of.line];
                right.rate[end][n] = part < parts ? tries.rate[end][n] : last.rate[of.line];
                of.least[end] = std::min(of.least[end], right.value[end][n]);
                if (of.settled[end]) {
                    continue;
                }
                LaneSearch search{.u = tries.u[n], .v = tries.v[n], .enough = of.enough[end]};
                if (!places_search(left, right, end, n, search)) {
                    continue;
                }
                searches_.push_back(search);
                owners_.push_back(static_cast<std::uint32_t>(2 * (&of - pending_.data())) +
                                  static_cast<std::uint32_t>(end));
            }
        }
        left = right;
    }
}

void TileCutter::search_all(const TileMotion& motion) {
    const std::size_t count = searches_.size();
    while (searches_.size() % Tile::side != 0) {
        searches_.push_back(searches_.back());
    }
    for (std::size_t n = 0; n < count; n += Tile::side) {
        tile_sweep().search(motion, searches_.data() + n);
    }
    for (std::size_t n = 0; n < count; ++n) {
        double& least = pending_[owners_[n] / 2].least[owners_[n] % 2];
        least = std::min(least, searches_[n].least);
    }
}

void TileCutter::finish(const ReadyStep& step, const TileMotion& motion) {
    searches_.clear();
    owners_.clear();
    for (std::size_t n = 0; n < pending_.size(); n += Tile::side) {
        attempt_between(motion, pending_.data() + n, std::min<std::size_t>(Tile::side, pending_.size() - n));
    }
    search_all(motion);
    for (const Pending& of : pending_) {
        if (of.least[0] < missed) {
            cuts_[of.line] = {of.least[0], -of.least[1]};
        } else if (const auto found = step.cutter.swept(
                       place_of(step, of.line), k_, Interval{of.enough[0], -of.enough[1]})) {
            cuts_[of.line] = *found;
        }
    }
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

void TileCutter::subtract(const ReadyStep& step, std::size_t line, TileCut& found) {
    const Interval& cut = cuts_[line];
    const std::int32_t move = step.step->move;
    Vec3 at = place_of(step, line) - step.middle.tip;
    const auto engage = [&](float end) {
        at[k_] = face_ + static_cast<double>(end) - step.middle.tip[k_];
        found.engaged.extend(at.dot(step.middle.axis), at.dot(step.across));
    };
    const auto from = static_cast<float>(cut.from - face_);
    const auto to = static_cast<float>(cut.to - face_);
    constexpr float sliver = 1e-6F; // mm: shorter pieces are rounding
    for (const Dexel& piece : tile_.line(line)) {
        if (piece.to <= from || piece.from >= to) {
            next_.push_back(piece);
            continue;
        }
        const float low = std::max(piece.from, from), high = std::min(piece.to, to);
        found.length += static_cast<double>(high - low);
        engage(low);
        engage(high);
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
    ++tile_.version;
    tile_.look(middle);
}

void TileCutter::copy_lines(std::size_t from, std::size_t to) {
    const auto shift = static_cast<std::uint32_t>(next_.size()) - tile_.first[from]; // modulo 2^32
    for (std::size_t line = from; line < to; ++line) {
        next_first_[line] = tile_.first[line] + shift;
    }
    const auto begin = tile_.dexels.begin();
    next_.insert(next_.end(), begin + tile_.first[from], begin + tile_.first[to]);
}

bool TileCutter::cut(const ReadyStep& step, TileCut& found) {
    if (!may_reach(step) || !find_material(step)) {
        return false;
    }
    const TileMotion& motion = step.motions[static_cast<std::size_t>(k_)];
    tile_sweep().look(motion, lines_);
    pending_.clear();
    for_each_bit(lines_.reached, [&](std::size_t line) { settle(step, line); });
    if (!pending_.empty()) {
        finish(step, motion);
    }
    std::uint64_t meets = 0;
    for_each_bit(lines_.reached, [&](std::size_t line) {
        const Interval& cut = cuts_[line];
        const Interval there = cut.from < cut.to ? material(line, cut.from, cut.to) : Interval{0.0, -1.0};
        meets |= std::uint64_t{there.from < there.to ? 1U : 0U} << line;
    });
    if (meets == 0) {
        return false;
    }
    found = {.move = step.step->move, .part = step.step->part};
    next_.clear();
    if (step.step->part != ToolPart::cutter) {
        if (step.core) {
            for_each_bit(meets, [&](std::size_t line) { touch(step, line, place_of(step, line), found); });
        }
        return found.contact.has_value();
    }
    std::size_t copied = 0; // lines
    for_each_bit(meets, [&](std::size_t line) {
        copy_lines(copied, line);
        next_first_[line] = static_cast<std::uint32_t>(next_.size());
        if (step.core) {
            touch(step, line, place_of(step, line), found);
        }
        subtract(step, line, found);
        copied = line + 1;
    });
    copy_lines(copied, Tile::lines);
    if (!(found.length > 0.0)) {
        return false;
    }
    next_first_[Tile::lines] = static_cast<std::uint32_t>(next_.size());
    const double middle = 0.5 * (step.bounds.min()[k_] + step.bounds.max()[k_]) - face_;
    replace_lines(static_cast<float>(middle));
    return true;
}

} // namespace millwright::simulation
