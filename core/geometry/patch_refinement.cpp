#include "core/geometry/patch_refinement.h"

#include "core/base/error.h"

#include <vector>

namespace millwright::geometry {

namespace {

Eigen::Vector4d homogeneous(const ControlNet& net, int i, int j) {
    const double w = net.weight(i, j);
    const Vec3& p = net.point(i, j);
    return {w * p.x(), w * p.y(), w * p.z(), w};
}

void set(ControlNet& net, int i, int j, const Eigen::Vector4d& value) {
    net.weight(i, j) = value.w();
    net.point(i, j) = value.head<3>() / value.w();
}

/// One degree more along the rows' index.
ControlNet raised_u(const ControlNet& net) {
    ControlNet raised = ControlNet::sized(net.rows + 1, net.columns);
    for (int j = 0; j < net.columns; ++j) {
        for (int i = 0; i <= net.rows; ++i) {
            const double share = static_cast<double>(i) / net.rows;
            Eigen::Vector4d sum = Eigen::Vector4d::Zero();
            if (i > 0) {
                sum += share * homogeneous(net, i - 1, j);
            }
            if (i < net.rows) {
                sum += (1.0 - share) * homogeneous(net, i, j);
            }
            set(raised, i, j, sum);
        }
    }
    return raised;
}

ControlNet transposed(const ControlNet& net) {
    ControlNet turned = ControlNet::sized(net.columns, net.rows);
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            turned.point(j, i) = net.point(i, j);
            turned.weight(j, i) = net.weight(i, j);
        }
    }
    return turned;
}

/// Along the rows' index, by de Casteljau.
std::pair<ControlNet, ControlNet> split_u(const ControlNet& net, double at) {
    std::pair halves{net, net};
    const int degree = net.rows - 1;
    for (int j = 0; j < net.columns; ++j) {
        std::vector<Eigen::Vector4d> b;
        for (int i = 0; i <= degree; ++i) {
            b.push_back(homogeneous(net, i, j));
        }
        for (int level = 1; level <= degree; ++level) {
            for (int i = 0; i <= degree - level; ++i) {
                const auto n = static_cast<std::size_t>(i);
                b[n] = (1.0 - at) * b[n] + at * b[n + 1];
            }
            set(halves.first, level, j, b[0]);
            const int behind = degree - level;
            set(halves.second, behind, j, b[static_cast<std::size_t>(behind)]);
        }
    }
    return halves;
}

} // namespace

BezierPatch elevated(const BezierPatch& patch, int degree_u, int degree_v) {
    expects(degree_u >= patch.degree_u() && degree_u <= max_degree && degree_v >= patch.degree_v() &&
                degree_v <= max_degree,
            "a degree is elevated, up to the highest there is");
    ControlNet net = patch.net();
    while (net.rows <= degree_u) {
        net = raised_u(net);
    }
    net = transposed(net);
    while (net.rows <= degree_v) {
        net = raised_u(net);
    }
    return BezierPatch(transposed(net));
}

std::pair<BezierPatch, BezierPatch> split(const BezierPatch& patch, Parameter parameter, double at) {
    expects(at > 0.0 && at < 1.0, "a patch is split inside");
    if (parameter == Parameter::u) {
        auto [before, behind] = split_u(patch.net(), at);
        return {BezierPatch(std::move(before)), BezierPatch(std::move(behind))};
    }
    const auto [before, behind] = split_u(transposed(patch.net()), at);
    return {BezierPatch(transposed(before)), BezierPatch(transposed(behind))};
}

} // namespace millwright::geometry
