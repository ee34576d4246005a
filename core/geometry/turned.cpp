#include "core/geometry/turned.h"

#include <Eigen/Geometry>

#include <vector>

namespace millwright::geometry {

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
