#include "core/plan/set_up_study.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/geometry/net_editing.h"
#include "core/plan/set_up_reach.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace millwright::plan {

using toolpath::SetUpParameter;

toolpath::SetUpSearchSettings set_up_box(const CuttingSetup& cutting_setup,
                                         const SetUpStudySettings& settings) {
    Vec3 middle = -cutting_setup.patch.control_box().center();
    middle.z() = cutting_setup.machine.description().workpiece_offset.z();
    const Vec3 reach(settings.reach, settings.reach, settings.height_reach);
    toolpath::SetUpSearchSettings box;
    box.least << middle - reach, -settings.turn_reach;
    box.most << middle + reach, settings.turn_reach;
    return box;
}

toolpath::SetUpCost set_up_cost(const CuttingSetup& cutting_setup, const SetUpStudySettings& settings) {
    return {cutting_setup.patch,
            cutting_setup.machine,
            cutting_setup.flipped,
            grid::Grid::uniform(settings.nodes, settings.nodes),
            cutting_setup.direction,
            settings.goal,
            cutting_setup.tool};
}

SetUpStudy set_up_study(const CuttingSetup& cutting_setup,
                        const SetUpStudySettings& settings,
                        const Progress& progress,
                        const toolpath::SetUpCosts& measure) {
    expects(settings.reach > 0.0 && settings.height_reach > 0.0, "the search ranges of a part are positive");
    expects(settings.turn_reach >= 0.0 && settings.turn_reach <= pi, "a part may be turned by 0 to pi");
    expects(settings.nodes >= 2 && settings.nodes <= 200,
            "the cost is measured on 2 to 200 nodes in each direction");
    constexpr double searching = 0.4; // share of the work
    const toolpath::SetUpCost cost = set_up_cost(cutting_setup, settings);
    toolpath::SetUpSearchSettings box = set_up_box(cutting_setup, settings);
    SetUpStudy study;
    study.search = toolpath::search_set_up(cost, box, progress.part(0.0, searching), measure);
    expect_in_reach(study.search, cutting_setup, settings, box);
    const bool maps_turn = settings.across == SetUpParameter::turn || settings.up == SetUpParameter::turn;
    if (maps_turn && !(settings.turn_reach > 0.0)) { // it was not searched, but is to be seen
        box.least[3] = -pi;
        box.most[3] = pi;
    }
    study.map = toolpath::set_up_map(cost,
                                     study.search.best.place,
                                     settings.across,
                                     settings.up,
                                     settings.places,
                                     box,
                                     progress.part(searching, 1.0),
                                     measure);
    return study;
}

project::Project with_set_up(project::Project project, const toolpath::SetUpPlace& place) {
    project.machine.workpiece_offset = toolpath::offset_of(place);
    for (geometry::ControlNet& net : project.surface.patches) {
        net = geometry::turned(std::move(net), place[3]);
    }
    for (project::FaceInput* face : project.surface.exact_faces()) {
        face->net = geometry::turned(std::move(face->net), place[3]);
    }
    if (auto& joined = project.surface.joined; joined && joined->corners) {
        const Mat3 rotation = Eigen::AngleAxisd(place[3], Vec3::UnitZ()).toRotationMatrix();
        for (Vec3& corner : *joined->corners) {
            corner = rotation * corner;
        }
    }
    return project;
}

std::string_view name(SetUpParameter parameter) {
    constexpr std::array names{"a", "b", "c", "turn"};
    return names.at(static_cast<std::size_t>(parameter));
}

std::string_view unit(SetUpParameter parameter) {
    return parameter == SetUpParameter::turn ? "deg" : "mm";
}

double for_people(SetUpParameter parameter, double value) {
    return parameter == SetUpParameter::turn ? to_degrees(value) : value;
}

std::string set_up_csv(const toolpath::SetUpMap& map) {
    std::string text = fmt::format("{}_{},{}_{},cost_mm,axis_deg_to_curve\n",
                                   name(map.across),
                                   unit(map.across),
                                   name(map.up),
                                   unit(map.up));
    for (std::size_t row = 0; row < map.y.size(); ++row) {
        for (std::size_t column = 0; column < map.x.size(); ++column) {
            const std::size_t place = row * map.x.size() + column;
            const double cost = map.costs[place];
            const std::optional<double>& axis_max = map.axis_max[place];
            text += fmt::format("{:.4f},{:.4f},{},{}\n",
                                for_people(map.across, map.x[column]),
                                for_people(map.up, map.y[row]),
                                std::isfinite(cost) ? fmt::format("{:.6f}", cost) : std::string(),
                                axis_max ? fmt::format("{:.4f}", to_degrees(*axis_max)) : std::string());
        }
    }
    return text;
}

} // namespace millwright::plan
