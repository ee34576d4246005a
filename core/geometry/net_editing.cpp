#include "core/geometry/net_editing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::geometry {

namespace {

struct Ways {
    Vec3 rows = Vec3::Zero(), columns = Vec3::Zero(); ///< from the first to the last one, mean, mm
};

Ways ways_of(const ControlNet& net) {
    Ways ways;
    for (int j = 0; j < net.columns; ++j) {
        ways.rows += (net.point(net.rows - 1, j) - net.point(0, j)) / net.columns;
    }
    for (int i = 0; i < net.rows; ++i) {
        ways.columns += (net.point(i, net.columns - 1) - net.point(i, 0)) / net.rows;
    }
    return ways;
}

/// x runs along the rows' index, and y along the columns'; or the other way.
bool x_is_along_rows(const Ways& ways) {
    return std::abs(ways.rows.x()) + std::abs(ways.columns.y()) >=
           std::abs(ways.columns.x()) + std::abs(ways.rows.y());
}

/// -1, 0 or 1: before, in or behind the middle, as the coordinate sees it.
double side(int index, int count, double way) {
    const int twice = 2 * index - (count - 1);
    const int sign = twice > 0 ? 1 : (twice < 0 ? -1 : 0);
    return way < 0.0 ? -sign : sign;
}

} // namespace

std::vector<NetPlace> images(const ControlNet& net, const NetSymmetry& symmetry, const NetPlace& place) {
    const bool along = x_is_along_rows(ways_of(net));
    std::vector<NetPlace> places{place};
    if (along ? symmetry.x : symmetry.y) {
        places.push_back({net.rows - 1 - place.i, place.j});
    }
    if (along ? symmetry.y : symmetry.x) {
        for (std::size_t n = places.size(); n-- > 0;) {
            places.push_back({places[n].i, net.columns - 1 - places[n].j});
        }
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

Vec2 side_of(const ControlNet& net, const NetSymmetry& symmetry, const NetPlace& place) {
    const Ways ways = ways_of(net);
    const bool along = x_is_along_rows(ways);
    const auto on_rows = [&](int axis) { return side(place.i, net.rows, ways.rows[axis]); };
    const auto on_columns = [&](int axis) { return side(place.j, net.columns, ways.columns[axis]); };
    return {symmetry.x ? (along ? on_rows(0) : on_columns(0)) : 1.0,
            symmetry.y ? (along ? on_columns(1) : on_rows(1)) : 1.0};
}

Vec3 share_of_way(const Vec2& side, const Vec2& leads) {
    return {side.x() * leads.x(), side.y() * leads.y(), 1.0};
}

namespace {

void turn_points(std::vector<Vec3>& points, double turn) {
    const Mat3 rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
    for (Vec3& point : points) {
        point = rotation * point;
    }
}

} // namespace

ControlNet turned(ControlNet net, double turn) {
    turn_points(net.points, turn);
    return net;
}

BsplineNet turned(BsplineNet net, double turn) {
    turn_points(net.points, turn);
    return net;
}

} // namespace millwright::geometry
