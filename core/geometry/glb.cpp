#include "core/geometry/glb.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

namespace millwright::geometry {

namespace {

constexpr double mm_per_metre = 1000.0;
constexpr double gamma = 2.2; // of sRGB, nearly; colours in a file are linear
constexpr std::size_t most_points = 5'000'000;
constexpr double farthest_m = 1e4;

// Writing.

/// Bytes and the accessors that describe them.
class BinaryPart {
public:
    explicit BinaryPart(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

    int vectors(const std::vector<Vec3>& values, double scale, bool with_bounds) {
        tinygltf::Accessor accessor;
        accessor.type = TINYGLTF_TYPE_VEC3;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        const std::size_t begin = data().size();
        // The bounds are those of the floats in the file. (Optimised, Eigen's cast there and back changed
        // nothing.)
        std::array<float, 3> low{}, high{};
        low.fill(std::numeric_limits<float>::max());
        high.fill(std::numeric_limits<float>::lowest());
        for (const Vec3& value : values) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto kept = static_cast<float>(scale * value[static_cast<Eigen::Index>(k)]);
                low[k] = std::min(low[k], kept);
                high[k] = std::max(high[k], kept);
                append(kept);
            }
        }
        if (with_bounds) {
            accessor.minValues.assign(low.begin(), low.end());
            accessor.maxValues.assign(high.begin(), high.end());
        }
        return finish(std::move(accessor), begin, values.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    }

    int indices(const std::vector<std::array<int, 3>>& triangles) {
        tinygltf::Accessor accessor;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        const std::size_t begin = data().size();
        for (const auto& triangle : triangles) {
            for (const int corner : triangle) {
                append(static_cast<std::uint32_t>(corner));
            }
        }
        return finish(std::move(accessor), begin, 3 * triangles.size(), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    }

private:
    std::vector<unsigned char>& data() { return model_.buffers[0].data; }

    template <class T> void append(T value) {
        const std::size_t at = data().size();
        data().resize(at + sizeof(T));
        std::memcpy(data().data() + at, &value, sizeof(T));
    }

    int finish(tinygltf::Accessor accessor, std::size_t begin, std::size_t count, int target) {
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = begin;
        view.byteLength = data().size() - begin;
        view.target = target;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.count = count;
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    tinygltf::Model& model_;
};

int material_of(tinygltf::Model& model, const Vec3& color) {
    std::vector<double> factor{1.0, 1.0, 1.0, 1.0};
    for (int k = 0; k < 3; ++k) {
        // so few digits that reading gives the same colour back
        factor[static_cast<std::size_t>(k)] = std::round(1e6 * std::pow(color[k], gamma)) / 1e6;
    }
    for (std::size_t n = 0; n < model.materials.size(); ++n) {
        if (model.materials[n].pbrMetallicRoughness.baseColorFactor == factor) {
            return static_cast<int>(n);
        }
    }
    tinygltf::Material material;
    material.pbrMetallicRoughness.baseColorFactor = factor;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.pbrMetallicRoughness.roughnessFactor = 0.5;
    model.materials.push_back(std::move(material));
    return static_cast<int>(model.materials.size()) - 1;
}

tinygltf::Primitive primitive_of(tinygltf::Model& model, BinaryPart& binary, const SolidMesh& mesh) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material_of(model, mesh.color);
    primitive.attributes["POSITION"] = binary.vectors(mesh.positions, 1.0 / mm_per_metre, true);
    primitive.attributes["NORMAL"] = binary.vectors(mesh.normals, 1.0, false);
    primitive.indices = binary.indices(mesh.triangles);
    return primitive;
}

std::vector<double> matrix_of(const Frame& frame) {
    Eigen::Matrix4d matrix = frame.matrix();
    matrix.topRightCorner<3, 1>() /= mm_per_metre;
    return {matrix.data(), matrix.data() + matrix.size()};
}

// Reading.

class Reader {
public:
    Reader(const tinygltf::Model& model, const std::filesystem::path& file) : model_(model), file_(file) {}

    [[nodiscard]] std::vector<SolidBody> bodies() {
        std::vector<SolidBody> all;
        std::set<std::string> names;
        for (const tinygltf::Node& node : model_.nodes) {
            if (node.mesh < 0 || node.name.empty()) {
                continue;
            }
            name_ = node.name;
            if (!names.insert(node.name).second) {
                fail("another one has the same name");
            }
            SolidBody body{node.name, {}};
            const auto& mesh = element(model_.meshes, node.mesh, "mesh");
            for (const tinygltf::Primitive& primitive : mesh.primitives) {
                body.meshes.push_back(mesh_of(primitive));
            }
            all.push_back(std::move(body));
        }
        return all;
    }

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Error(fmt::format("node '{}': {}", name_, why), file_);
    }

    template <class T> const T& element(const std::vector<T>& all, int index, const char* what) const {
        if (index < 0 || index >= std::ssize(all)) {
            fail(fmt::format("{} {} does not exist", what, index));
        }
        return all[static_cast<std::size_t>(index)];
    }

    SolidMesh mesh_of(const tinygltf::Primitive& primitive) {
        if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) {
            fail("only triangles can be shown");
        }
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) {
            fail("its triangles have no positions");
        }
        SolidMesh mesh;
        mesh.color = color_of(primitive.material);
        mesh.positions = vectors(position->second, mm_per_metre);
        points_ += mesh.positions.size();
        if (points_ > most_points) {
            fail(fmt::format("there are more than {} points", most_points));
        }
        mesh.triangles = triangles(primitive.indices, mesh.positions.size());
        const auto normal = primitive.attributes.find("NORMAL");
        if (normal == primitive.attributes.end()) {
            return flat(mesh);
        }
        mesh.normals = vectors(normal->second, 1.0);
        if (mesh.normals.size() != mesh.positions.size()) {
            fail("the numbers of normals and positions differ");
        }
        return mesh;
    }

    /// With a normal of its own for each triangle, as glTF asks where a file has none.
    static SolidMesh flat(const SolidMesh& shared) {
        SolidMesh mesh;
        mesh.color = shared.color;
        for (const auto& triangle : shared.triangles) {
            std::array<Vec3, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) {
                corner[k] = shared.positions[static_cast<std::size_t>(triangle[k])];
            }
            const Vec3 across = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
            const double size = across.norm();
            const Vec3 normal = size > 0.0 ? Vec3(across / size) : Vec3(Vec3::UnitZ());
            const auto first = static_cast<int>(mesh.positions.size());
            for (const Vec3& point : corner) {
                mesh.positions.push_back(point);
                mesh.normals.push_back(normal);
            }
            mesh.triangles.push_back({first, first + 1, first + 2});
        }
        return mesh;
    }

    Vec3 color_of(int material) const {
        if (material < 0) {
            return SolidMesh().color;
        }
        const auto& factor =
            element(model_.materials, material, "material").pbrMetallicRoughness.baseColorFactor;
        Vec3 color = Vec3::Ones();
        for (std::size_t k = 0; k < 3 && k < factor.size(); ++k) {
            color[static_cast<Eigen::Index>(k)] = std::pow(std::clamp(factor[k], 0.0, 1.0), 1.0 / gamma);
        }
        return color;
    }

    /// The bytes of element `n` are at begin + n * stride.
    struct Bytes {
        const unsigned char* begin = nullptr;
        std::size_t stride = 0, count = 0;
    };

    Bytes bytes(const tinygltf::Accessor& accessor, std::size_t size) const {
        if (accessor.sparse.isSparse) {
            fail("sparse data are not supported");
        }
        const auto& view = element(model_.bufferViews, accessor.bufferView, "buffer view");
        const auto& data = element(model_.buffers, view.buffer, "buffer").data;
        const int stride = accessor.ByteStride(view);
        const std::size_t begin = view.byteOffset + accessor.byteOffset;
        const bool inside =
            stride > 0 && view.byteOffset <= data.size() && begin >= view.byteOffset &&
            begin <= data.size() && size <= data.size() - begin && accessor.count > 0 &&
            (accessor.count - 1) <= (data.size() - begin - size) / static_cast<std::size_t>(stride);
        if (!inside) {
            fail("its data lie outside the file");
        }
        return {data.data() + begin, static_cast<std::size_t>(stride), accessor.count};
    }

    std::vector<Vec3> vectors(int index, double scale) const {
        const auto& accessor = element(model_.accessors, index, "accessor");
        if (accessor.type != TINYGLTF_TYPE_VEC3 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
            fail("its vectors are not three floats");
        }
        const Bytes from = bytes(accessor, 3 * sizeof(float));
        std::vector<Vec3> all;
        all.reserve(from.count);
        for (std::size_t n = 0; n < from.count; ++n) {
            std::array<float, 3> value{};
            std::memcpy(value.data(), from.begin + n * from.stride, sizeof(value));
            const Vec3 point = Eigen::Map<const Eigen::Vector3f>(value.data()).cast<double>();
            if (!(point.cwiseAbs().maxCoeff() <= farthest_m)) {
                fail("a number is not finite, or farther than 10 km");
            }
            all.emplace_back(scale * point);
        }
        return all;
    }

    template <class T> static std::uint32_t number_at(const unsigned char* bytes) {
        T value{};
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }

    std::vector<std::uint32_t> numbers(int index) const {
        const auto& accessor = element(model_.accessors, index, "accessor");
        using Read = std::uint32_t (*)(const unsigned char*);
        const auto [read, size] = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT
                                      ? std::pair<Read, std::size_t>(number_at<std::uint32_t>, 4)
                                  : accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                      ? std::pair<Read, std::size_t>(number_at<std::uint16_t>, 2)
                                  : accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
                                      ? std::pair<Read, std::size_t>(number_at<std::uint8_t>, 1)
                                      : std::pair<Read, std::size_t>(nullptr, 0);
        if (accessor.type != TINYGLTF_TYPE_SCALAR || read == nullptr) {
            fail("its indices are not whole numbers");
        }
        const Bytes from = bytes(accessor, size);
        std::vector<std::uint32_t> all;
        all.reserve(from.count);
        for (std::size_t n = 0; n < from.count; ++n) {
            all.push_back(read(from.begin + n * from.stride));
        }
        return all;
    }

    std::vector<std::array<int, 3>> triangles(int indices, std::size_t points) const {
        std::vector<std::uint32_t> corners;
        if (indices >= 0) {
            corners = numbers(indices);
        } else {
            for (std::size_t n = 0; n < points; ++n) {
                corners.push_back(static_cast<std::uint32_t>(n));
            }
        }
        if (corners.size() % 3 != 0) {
            fail("its last triangle does not have three corners");
        }
        std::vector<std::array<int, 3>> all;
        for (std::size_t n = 0; n < corners.size(); n += 3) {
            std::array<int, 3> triangle{};
            for (std::size_t k = 0; k < 3; ++k) {
                if (corners[n + k] >= points) {
                    fail(fmt::format("triangle {} refers to a corner that does not exist", n / 3 + 1));
                }
                triangle[k] = static_cast<int>(corners[n + k]);
            }
            all.push_back(triangle);
        }
        return all;
    }

    const tinygltf::Model& model_;
    const std::filesystem::path& file_;
    std::string name_;
    std::size_t points_ = 0;
};

/// A file system without files. Version 2.8 added a function; without all of them the parser keeps its own
/// ones.
template <typename Callbacks> Callbacks no_files() {
    Callbacks none{};
    none.FileExists = [](const std::string&, void*) { return false; };
    none.ExpandFilePath = [](const std::string& path, void*) { return path; };
    none.ReadWholeFile = [](std::vector<unsigned char>*, std::string* why, const std::string& path, void*) {
        *why += "it needs another file, " + path;
        return false;
    };
    none.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    if constexpr (requires { none.GetFileSizeInBytes; }) {
        none.GetFileSizeInBytes = [](std::size_t*, std::string*, const std::string&, void*) { return false; };
    }
    return none;
}

/// Nothing outside of the file is opened, and pictures in it are left alone.
void keep_inside(tinygltf::TinyGLTF& parser) {
    parser.SetFsCallbacks(no_files<tinygltf::FsCallbacks>());
    parser.SetImageLoader([](tinygltf::Image*,
                             const int,
                             std::string*,
                             std::string*,
                             int,
                             int,
                             const unsigned char*,
                             int,
                             void*) { return true; },
                          nullptr);
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

} // namespace

std::string glb_of(const std::vector<PlacedBody>& bodies, const std::string& name) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "Millwright";
    BinaryPart binary(model);
    tinygltf::Node root;
    root.name = name;
    const double half_turn = std::sqrt(0.5); // a quarter turn about x takes z to y
    root.rotation = {-half_turn, 0.0, 0.0, half_turn};
    for (const PlacedBody& placed : bodies) {
        tinygltf::Mesh mesh;
        mesh.name = placed.body.name;
        for (const SolidMesh& part : placed.body.meshes) {
            mesh.primitives.push_back(primitive_of(model, binary, part));
        }
        tinygltf::Node node;
        node.name = placed.body.name;
        node.mesh = static_cast<int>(model.meshes.size());
        node.matrix = matrix_of(placed.at_rest);
        root.children.push_back(static_cast<int>(model.nodes.size()));
        model.meshes.push_back(std::move(mesh));
        model.nodes.push_back(std::move(node));
    }
    tinygltf::Scene scene;
    scene.nodes = {static_cast<int>(model.nodes.size())};
    model.nodes.push_back(std::move(root));
    model.scenes.push_back(std::move(scene));
    model.defaultScene = 0;
    std::ostringstream bytes;
    tinygltf::TinyGLTF writer;
    expects(writer.WriteGltfSceneToStream(&model, bytes, false, true), "bodies can be written to memory");
    return bytes.str();
}

std::vector<SolidBody> parse_glb(std::string_view bytes, const std::filesystem::path& file) {
    if (bytes.size() < 20 || !bytes.starts_with("glTF")) {
        throw Error("this is not a binary glTF file (.glb)", file);
    }
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("the file is larger than a glb file can be", file);
    }
    tinygltf::TinyGLTF parser;
    keep_inside(parser);
    tinygltf::Model model;
    std::string why, warnings;
    const std::vector<unsigned char> copy(bytes.begin(), bytes.end());
    if (!parser.LoadBinaryFromMemory(
            &model, &why, &warnings, copy.data(), static_cast<unsigned int>(copy.size()), "")) {
        throw Error("this glb file is damaged: " + first_line(why), file);
    }
    return Reader(model, file).bodies();
}

} // namespace millwright::geometry
