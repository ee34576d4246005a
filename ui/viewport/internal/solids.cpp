#include "ui/viewport/internal/solids.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "ui/viewport/internal/boxes.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace millwright::viewport {

namespace {

constexpr int sides = 48; // of a circle
constexpr float edge_opacity = 0.55F;
constexpr double edge_lift = 0.0015; // of the content's radius

glm::vec3 on_circle(const glm::vec2& radius_and_z, int side) {
    const double angle = 2.0 * pi * side / sides;
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    return {radius_and_z.x * c, radius_and_z.x * s, radius_and_z.y};
}

void add_edge(Solid& solid, const glm::vec3& a, const glm::vec3& b) {
    solid.edges.push_back({.position = a});
    solid.edges.push_back({.position = b});
}

void add_rim(Solid& solid, const glm::vec2& corner) {
    for (int side = 0; corner.x > 0.0F && side < sides; ++side) {
        add_edge(solid, on_circle(corner, side), on_circle(corner, side + 1));
    }
}

void add_triangle(Solid& solid, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    solid.triangles.insert(solid.triangles.end(), {a, b, c});
}

/// Whether the profile has a corner at `at`, and is not just a curve there.
bool is_edge(const glm::vec2& before, const glm::vec2& at, const glm::vec2& after) {
    constexpr float cosine_of_curve = 0.94F; // 20 degrees
    return glm::dot(glm::normalize(at - before), glm::normalize(after - at)) < cosine_of_curve;
}

/// The band between two corners of the profile.
void add_band(Solid& solid, const glm::vec2& from, const glm::vec2& to) {
    const glm::vec2 along = to - from;
    const glm::vec2 outwards = glm::normalize(glm::vec2(along.y, -along.x));
    const auto base = static_cast<std::uint32_t>(solid.vertices.size());
    for (int side = 0; side <= sides; ++side) {
        const glm::vec3 normal = on_circle(outwards, side);
        solid.vertices.push_back({.position = on_circle(from, side), .normal = normal});
        solid.vertices.push_back({.position = on_circle(to, side), .normal = normal});
    }
    for (std::uint32_t side = 0; side < sides; ++side) {
        const std::uint32_t k = base + 2 * side;
        add_triangle(solid, k, k + 2, k + 3);
        add_triangle(solid, k, k + 3, k + 1);
    }
}

void append_solid(Solid& to, const Solid& part) {
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), part.vertices.begin(), part.vertices.end());
    to.edges.insert(to.edges.end(), part.edges.begin(), part.edges.end());
    for (const std::uint32_t corner : part.triangles) {
        to.triangles.push_back(first + corner);
    }
}

} // namespace

Solid tool_solid() {
    constexpr std::array<glm::vec2, 7> profile = {{{0.0F, 0.0F},
                                                   {1.0F, 3.2F},
                                                   {1.0F, 11.0F},
                                                   {2.4F, 12.2F},
                                                   {2.4F, 17.0F},
                                                   {1.7F, 17.8F},
                                                   {0.0F, 17.8F}}};
    return turned_solid(profile);
}

Solid tool_solid(const toolpath::Tool& tool) {
    expects(tool.cutter.has_value(), "a tool with a cutter is drawn");
    constexpr double chord_share = 1e-3; // of the radius: steps of five degrees
    Solid solid;
    for (const auto& body : {tool.cutter, tool.holder}) {
        std::vector<glm::vec2> profile;
        for (const Vec2& p : body ? body->outline(chord_share * body->shape().radius) : std::vector<Vec2>()) {
            profile.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
        }
        append_solid(solid, turned_solid(profile));
    }
    return solid;
}

void add_quad(Solid& solid, const std::array<glm::vec3, 4>& corners) {
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const auto base = static_cast<std::uint32_t>(solid.vertices.size());
    for (const glm::vec3& corner : corners) {
        solid.vertices.push_back({.position = corner, .normal = normal});
    }
    add_triangle(solid, base, base + 1, base + 2);
    add_triangle(solid, base, base + 2, base + 3);
}

Solid box_solid(const glm::vec3& min, const glm::vec3& max) {
    Solid solid;
    const auto corner = [&](int k) {
        return glm::vec3(
            (k & 1) != 0 ? max.x : min.x, (k & 2) != 0 ? max.y : min.y, (k & 4) != 0 ? max.z : min.z);
    };
    constexpr std::array<std::array<int, 4>, 6> faces = {
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& [a, b, c, d] : faces) {
        add_quad(solid, {corner(a), corner(b), corner(c), corner(d)});
    }
    for (int k = 0; k < 8; ++k) {
        for (const int bit : {1, 2, 4}) {
            if ((k & bit) == 0) {
                add_edge(solid, corner(k), corner(k | bit));
            }
        }
    }
    return solid;
}

Solid turned_solid(std::span<const glm::vec2> profile) {
    Solid solid;
    for (std::size_t k = 0; k < profile.size(); ++k) {
        if (k == 0 || k + 1 == profile.size() || is_edge(profile[k - 1], profile[k], profile[k + 1])) {
            add_rim(solid, profile[k]);
        }
        if (k + 1 < profile.size()) {
            add_band(solid, profile[k], profile[k + 1]);
        }
    }
    return solid;
}

Solid cylinder_solid(float diameter, float height) {
    const float r = 0.5F * diameter;
    const float z = 0.5F * height;
    const std::array<glm::vec2, 4> profile = {{{0.0F, -z}, {r, -z}, {r, z}, {0.0F, z}}};
    return turned_solid(profile);
}

SolidBuffers::SolidBuffers(const Solid& solid)
    : mesh_(solid.vertices, solid.triangles), edges_(solid.edges, render::LineTopology::segments) {}

void SolidBuffers::draw(const Canvas& canvas, const glm::mat4& model, const glm::vec3& color) const {
    canvas.painter.mesh(
        mesh_, {.coloring = {.color = {color, 1.0F}}, .model = model, .back_color = {}}, canvas.view);
    // An edge lies half inside its own solid, which would break it up.
    canvas.painter.lines(edges_,
                         {.coloring = {.color = {canvas.colors.wire, edge_opacity}}, .model = model},
                         nearer(canvas, edge_lift * radius(canvas.content)));
}

} // namespace millwright::viewport
