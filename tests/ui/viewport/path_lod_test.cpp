// Long paths on the screen: what is drawn of them, and what the mouse finds, against brute force.
#include "ui/viewport/path_lod.h"

#include "ui/render/camera.h"
#include "ui/render/path_drawer.h"
#include "ui/viewport/program_picking.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <vector>

namespace millwright::viewport {
namespace {

constexpr render::PixelSize large_view{800, 600};

gcode::PreviewPath random_path(int points, double step) {
    gcode::PreviewPath path;
    gcode::PathChunker chunker;
    std::mt19937 random(12);
    std::uniform_real_distribution<double> way(-step, step);
    Vec3 at = Vec3::Zero();
    for (int n = 0; n < points; ++n) {
        at = (at + Vec3(way(random), way(random), way(random))).cwiseMax(-100.0).cwiseMin(100.0);
        chunker.add({at, static_cast<gcode::Step>(n), gcode::PathKind::feed}, 1.0);
        if (auto full = chunker.take_full()) {
            path.chunks.push_back(std::move(full));
        }
    }
    if (auto rest = chunker.take_rest()) {
        path.chunks.push_back(std::move(rest));
    }
    return path;
}

/// Lines of 300 mm to and fro, 1 mm apart, that are nowhere straight.
gcode::PreviewPath rough_raster(int lines, int points) {
    gcode::PreviewPath path;
    gcode::PathChunker chunker;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> rough(-0.4, 0.4);
    gcode::Step step = 0;
    for (int line = 0; line < lines; ++line) {
        for (int n = 0; n < points; ++n) {
            const int along = line % 2 == 0 ? n : points - 1 - n;
            chunker.add({Vec3(300.0 * along / points - 150.0, line - 0.5 * lines, rough(random)),
                         step++,
                         gcode::PathKind::feed},
                        1.0);
            if (auto full = chunker.take_full()) {
                path.chunks.push_back(std::move(full));
            }
        }
    }
    if (auto rest = chunker.take_rest()) {
        path.chunks.push_back(std::move(rest));
    }
    return path;
}

render::Bounds bounds_of(const gcode::PreviewPath& path) {
    const Box3 box = path.bounds();
    return {{box.min().x(), box.min().y(), box.min().z()}, {box.max().x(), box.max().y(), box.max().z()}};
}

render::View view_of(const gcode::PreviewPath& path) {
    const render::Bounds bounds = bounds_of(path);
    return render::Camera().fitted(bounds, render::aspect(large_view)).view(large_view, bounds);
}

render::View path_from_above(const gcode::PreviewPath& path, double zoom) {
    const render::Bounds bounds = bounds_of(path);
    return render::Camera()
        .seen_from(render::StandardView::top)
        .fitted(bounds, render::aspect(large_view))
        .zoomed(zoom, {400.0, 300.0}, large_view)
        .view(large_view, bounds);
}

std::size_t drawn(const std::vector<std::vector<std::uint16_t>>& indices) {
    std::size_t count = 0;
    for (const auto& chunk : indices) {
        count += chunk.size() - static_cast<std::size_t>(std::ranges::count(chunk, render::path_restart));
    }
    return count;
}

std::vector<glm::dvec2> pixels_of(const gcode::PreviewPath& path,
                                  const std::vector<std::vector<std::uint16_t>>& indices,
                                  const render::View& view) {
    std::vector<glm::dvec2> pixels;
    for (std::size_t c = 0; c < indices.size(); ++c) {
        for (const std::uint16_t n : indices[c]) {
            if (n != render::path_restart) {
                const Vec3 at = path.chunks[c]->points[n].position();
                pixels.push_back(render::project(view, {at.x(), at.y(), at.z()})->pixel);
            }
        }
    }
    return pixels;
}

/// Of all chunks, one behind the other.
std::vector<bool> drawn_blocks(const gcode::PreviewPath& path,
                               const std::vector<std::vector<std::uint16_t>>& indices) {
    std::vector<bool> result;
    for (std::size_t c = 0; c < path.chunks.size(); ++c) {
        for (const gcode::PathBlock& block : path.chunks[c]->blocks) {
            const auto inside = [&](std::uint16_t n) {
                return n > block.first && n + 1U < block.first + block.count; // the ends belong to two
            };
            result.push_back(std::ranges::any_of(indices[c], inside));
        }
    }
    return result;
}

bool any_in_picture(const gcode::PathChunk& chunk, const gcode::PathBlock& block, const render::View& view) {
    const auto points = std::span(chunk.points).subspan(block.first, block.count);
    return std::ranges::any_of(points, [&](const gcode::PreviewPoint& point) {
        const Vec3 at = point.position();
        const auto seen = render::project(view, {at.x(), at.y(), at.z()});
        return seen && seen->pixel.x >= 0.0 && seen->pixel.x <= large_view.width && seen->pixel.y >= 0.0 &&
               seen->pixel.y <= large_view.height;
    });
}

TEST(PiecesInSight, LeaveOutLinesThatCoverEachOtherAndNoOther) {
    // Straight passes, each of which is one block: 40 a millimetre, all over the picture.
    constexpr int passes = 4000;
    gcode::PreviewPath path;
    gcode::PathChunker chunker;
    gcode::Step step = 0;
    for (int pass = 0; pass < passes; ++pass) {
        for (int n = 0; n < 1023; ++n) {
            const double along = pass % 2 == 0 ? n : 1022 - n;
            chunker.add({Vec3(0.1 * along, pass / 40.0, 0.0), step++, gcode::PathKind::feed}, 1.0);
            if (auto full = chunker.take_full()) {
                path.chunks.push_back(std::move(full));
            }
        }
    }
    const render::View view = path_from_above(path, 1.0);
    const auto all = visible_pieces(path.chunks, view, 1);
    const auto thinned = visible_pieces(path.chunks, view, 1, 1.0);
    EXPECT_GT(drawn(all), 7000U);
    EXPECT_LT(drawn(thinned), drawn(all) / 2);
    // The ends of all lines are still within a pixel and a half of one that is drawn.
    const auto ends = pixels_of(path, thinned, view);
    for (const glm::dvec2& pixel : pixels_of(path, all, view)) {
        ASSERT_TRUE(
            std::ranges::any_of(ends, [&](const glm::dvec2& end) { return glm::length(end - pixel) < 1.5; }))
            << pixel.x << " " << pixel.y;
    }
}

TEST(PiecesInSight, KeepWithinTheLimitAndUseIt) {
    const gcode::PreviewPath path = random_path(150'000, 3.0);
    const render::View view = view_of(path);
    const std::size_t points = drawn(visible_pieces(path.chunks, view, 20'000));
    EXPECT_LE(points, 20'000U);
    EXPECT_GE(points, 18'000U);
}

TEST(PiecesInSight, OfAShortPathAreEveryPointWhereItIsNear) {
    const gcode::PreviewPath path = random_path(5000, 20.0);
    const std::size_t points = drawn(visible_pieces(path.chunks, view_of(path), 100'000));
    EXPECT_GE(points, 4900U); // points on a straight line through their neighbours may be left out
}

TEST(PiecesInSight, LeaveOutWhatIsOutsideOfThePicture) {
    const gcode::PreviewPath path = rough_raster(200, 300);
    const render::View near = path_from_above(path, 0.05);
    const std::size_t whole = drawn(visible_pieces(path.chunks, path_from_above(path, 1.0), 1'000'000));
    const auto pieces = visible_pieces(path.chunks, near, 1'000'000);
    EXPECT_LT(drawn(pieces), whole / 8);
    const std::vector<bool> seen = drawn_blocks(path, pieces);
    std::size_t block = 0;
    int in_picture = 0;
    for (const auto& chunk : path.chunks) {
        for (const gcode::PathBlock& piece : chunk->blocks) {
            const bool wanted = any_in_picture(*chunk, piece, near);
            in_picture += wanted ? 1 : 0;
            EXPECT_TRUE(!wanted || seen[block]) << "block " << block;
            ++block;
        }
    }
    EXPECT_GT(in_picture, 2);
}

std::optional<gcode::PathPlace> brute_force(const gcode::PreviewPath& path,
                                            const render::View& view,
                                            const glm::dvec2& pixel,
                                            double within) {
    std::optional<gcode::PathPlace> best;
    double nearest = within;
    for (std::int64_t n = 1; n < path.point_count(); ++n) {
        const Vec3 from = path.point(n - 1).position(), to = path.point(n).position();
        const auto a = render::project(view, {from.x(), from.y(), from.z()});
        const auto b = render::project(view, {to.x(), to.y(), to.z()});
        if (!a || !b) {
            continue;
        }
        for (int k = 0; k <= 200; ++k) {
            const glm::dvec2 at = glm::mix(a->pixel, b->pixel, k / 200.0);
            if (glm::distance(at, pixel) < nearest) {
                nearest = glm::distance(at, pixel);
                best = gcode::PathPlace{n, 0.0};
            }
        }
    }
    return best;
}

TEST(PickPath, FindsWhatBruteForceFinds) {
    const gcode::PreviewPath path = random_path(400, 30.0);
    const render::View view = view_of(path);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> x(100.0, 700.0), y(100.0, 500.0);
    int found = 0;
    for (int round = 0; round < 200; ++round) {
        const glm::dvec2 pixel(x(random), y(random));
        const auto place = pick_path(path, view, pixel, 4.0);
        // The brute force goes in steps, so that its border is a little uncertain.
        EXPECT_TRUE(place || !brute_force(path, view, pixel, 3.5));
        if (!place) {
            continue;
        }
        EXPECT_TRUE(brute_force(path, view, pixel, 4.5));
        ++found;
        // Of several as near on the screen any is right: compare how near it is.
        const Vec3 p = path.position(*place);
        const auto seen = render::project(view, {p.x(), p.y(), p.z()});
        ASSERT_TRUE(seen);
        EXPECT_LT(glm::distance(seen->pixel, pixel), 4.0 + 1e-3);
    }
    EXPECT_GT(found, 20);
}

TEST(PickPath, GivesUpWhenTooMuchWouldHaveToBeLookedAt) {
    const gcode::PreviewPath path = random_path(20'000, 50.0);
    const render::View view = view_of(path);
    EXPECT_TRUE(pick_path(path, view, {400.0, 300.0}, 10.0));
    EXPECT_FALSE(pick_path(path, view, {400.0, 300.0}, 10.0, 1000));
}

TEST(PathVertex, KeepsPlacesWithinA65535thOfTheBox) {
    const glm::vec3 min(-10.0F, 0.0F, 5.0F), max(30.0F, 2.0F, 5.0F);
    const std::array<float, 3> point{12.3F, 1.7F, 5.0F};
    const render::PathVertex vertex = render::path_vertex(point.data(), 2, min, max);
    EXPECT_NEAR(min.x + (max.x - min.x) * vertex.place[0] / 65535.0F, 12.3F, 40.0F / 65535.0F);
    EXPECT_NEAR(min.y + (max.y - min.y) * vertex.place[1] / 65535.0F, 1.7F, 2.0F / 65535.0F);
    EXPECT_EQ(vertex.place[2], 0);
    EXPECT_EQ(vertex.kind, 2);
}

} // namespace
} // namespace millwright::viewport
