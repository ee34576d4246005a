#include "tests/ui/stage/software_renderer.h"

#include "core/base/error.h"

#include <imgui.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::test {

namespace {

struct Texture {
    const unsigned char* alpha = nullptr;
    int width = 0;
    int height = 0;

    [[nodiscard]] float texel(int x, int y) const {
        const int column = std::clamp(x, 0, width - 1);
        const int row = std::clamp(y, 0, height - 1);
        return static_cast<float>(alpha[row * width + column]) / 255.0F;
    }
    [[nodiscard]] float bilinear(float u, float v) const {
        const float x = u * static_cast<float>(width) - 0.5F;
        const float y = v * static_cast<float>(height) - 0.5F;
        const float left = std::floor(x);
        const float top = std::floor(y);
        const float fx = x - left;
        const float fy = y - top;
        const int i = static_cast<int>(left);
        const int j = static_cast<int>(top);
        return (1.0F - fy) * ((1.0F - fx) * texel(i, j) + fx * texel(i + 1, j)) +
               fy * ((1.0F - fx) * texel(i, j + 1) + fx * texel(i + 1, j + 1));
    }
};

float channel(std::uint32_t colour, unsigned shift) {
    return static_cast<float>(colour >> shift & 0xFFU);
}

std::uint32_t blended(std::uint32_t under, const std::array<float, 4>& over) {
    const float alpha = over[3];
    std::uint32_t result = 0xFF000000U;
    for (unsigned i = 0; i < 3; ++i) {
        const float mixed = alpha * over[i] + (1.0F - alpha) * channel(under, 8 * i);
        result |= static_cast<std::uint32_t>(std::clamp(mixed + 0.5F, 0.0F, 255.0F)) << (8 * i);
    }
    return result;
}

float cross(const ImVec2& a, const ImVec2& b, float x, float y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// Pixels exactly on a shared edge belong to the triangle for which the edge is upper or left.
bool owns_edge(const ImVec2& a, const ImVec2& b) {
    return b.y < a.y || (!(b.y > a.y) && b.x > a.x);
}

struct Span {
    int x0, x1, y0, y1;
};

class Painter {
public:
    Painter(Picture& picture, const Texture& texture) : picture_(picture), texture_(texture) {}

    void triangle(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, const Span& clip) {
        const float area = cross(a.pos, b.pos, c.pos.x, c.pos.y);
        if (!(std::abs(area) > 0.0F)) {
            return;
        }
        if (area < 0.0F) {
            triangle(a, c, b, clip);
            return;
        }
        const auto [low_x, high_x] = std::minmax({a.pos.x, b.pos.x, c.pos.x});
        const auto [low_y, high_y] = std::minmax({a.pos.y, b.pos.y, c.pos.y});
        for (int y = std::max(clip.y0, first(low_y)); y < std::min(clip.y1, last(high_y)); ++y) {
            for (int x = std::max(clip.x0, first(low_x)); x < std::min(clip.x1, last(high_x)); ++x) {
                pixel(a, b, c, area, x, y);
            }
        }
    }

private:
    static int first(float low) { return static_cast<int>(std::floor(std::clamp(low, -1e6F, 1e6F))); }
    static int last(float high) { return static_cast<int>(std::ceil(std::clamp(high, -1e6F, 1e6F))) + 1; }

    void pixel(const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, float area, int x, int y) {
        const float px = static_cast<float>(x) + 0.5F;
        const float py = static_cast<float>(y) + 0.5F;
        const std::array<float, 3> w{
            cross(b.pos, c.pos, px, py), cross(c.pos, a.pos, px, py), cross(a.pos, b.pos, px, py)};
        const std::array<bool, 3> owned{
            owns_edge(b.pos, c.pos), owns_edge(c.pos, a.pos), owns_edge(a.pos, b.pos)};
        for (std::size_t i = 0; i < 3; ++i) {
            if (w[i] < 0.0F || (!(w[i] > 0.0F) && !owned[i])) {
                return;
            }
        }
        const auto mix = [&](float va, float vb, float vc) {
            return (w[0] * va + w[1] * vb + w[2] * vc) / area;
        };
        std::array<float, 4> colour{};
        for (unsigned i = 0; i < 4; ++i) {
            colour[i] = mix(channel(a.col, 8 * i), channel(b.col, 8 * i), channel(c.col, 8 * i));
        }
        colour[3] *= texture_.bilinear(mix(a.uv.x, b.uv.x, c.uv.x), mix(a.uv.y, b.uv.y, c.uv.y)) / 255.0F;
        std::uint32_t& under = picture_.pixels[static_cast<std::size_t>(y * picture_.width + x)];
        under = blended(under, colour);
    }

    Picture& picture_;
    const Texture& texture_;
};

void paint_list(Painter& painter, const ImDrawList& list, const Picture& picture) {
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback != nullptr || command.TextureId != ImGui::GetIO().Fonts->TexID) {
            continue;
        }
        const Span clip{std::max(0, static_cast<int>(command.ClipRect.x)),
                        std::min(picture.width, static_cast<int>(command.ClipRect.z)),
                        std::max(0, static_cast<int>(command.ClipRect.y)),
                        std::min(picture.height, static_cast<int>(command.ClipRect.w))};
        for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
            const auto vertex = [&](unsigned n) -> const ImDrawVert& {
                const unsigned index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i + n)];
                return list.VtxBuffer[static_cast<int>(command.VtxOffset + index)];
            };
            painter.triangle(vertex(0), vertex(1), vertex(2), clip);
        }
    }
}

} // namespace

Picture render(const ImDrawData& data, widgets::Colour background) {
    Texture texture;
    unsigned char* alpha = nullptr;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&alpha, &texture.width, &texture.height);
    texture.alpha = alpha;
    Picture picture{static_cast<int>(data.DisplaySize.x), static_cast<int>(data.DisplaySize.y), {}};
    picture.pixels.assign(static_cast<std::size_t>(picture.width * picture.height), background);
    Painter painter(picture, texture);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        paint_list(painter, *data.CmdLists[i], picture);
    }
    return picture;
}

void save_png(const Picture& picture, const std::filesystem::path& file) {
    const int row_bytes = 4 * picture.width;
    if (stbi_write_png(file.c_str(), picture.width, picture.height, 4, picture.pixels.data(), row_bytes) ==
        0) {
        throw Error("cannot write the picture", file);
    }
}

} // namespace millwright::test
