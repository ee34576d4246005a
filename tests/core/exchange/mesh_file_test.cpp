#include "core/exchange/mesh_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <stop_token>
#include <string>
#include <utility>

namespace millwright::exchange {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view two_triangles = R"(solid plate
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 2 0 0
vertex 2 1 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 2 1 0
vertex 0 1 0
endloop
endfacet
endsolid plate
)";

MeshFile parsed(std::string_view bytes, const char* name = "part.stl", double unit = 1.0) {
    return parse_mesh(bytes, name, unit, {});
}

std::string refusal(std::string_view bytes, const char* name = "part.stl") {
    try {
        (void)parsed(bytes, name);
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "none";
}

void append(std::string& bytes, const void* value, std::size_t size) {
    bytes.append(static_cast<const char*>(value), size);
}

/// The two triangles as a binary STL file.
std::string binary_stl(const std::array<float, 18>& corners) {
    std::string bytes(80, ' ');
    const std::uint32_t count = 2;
    append(bytes, &count, 4);
    for (std::size_t n = 0; n < 2; ++n) {
        const std::array<float, 3> normal{0.0F, 0.0F, 1.0F};
        const std::uint16_t attribute = 0;
        append(bytes, normal.data(), 12);
        append(bytes, corners.data() + 9 * n, 36);
        append(bytes, &attribute, 2);
    }
    return bytes;
}

constexpr std::array<float, 18> plate{0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 0, 0, 2, 1, 0, 0, 1, 0};

double area(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        sum += 0.5 * mesh.doubled_area(n).norm();
    }
    return sum;
}

TEST(MeshFile, JoinsCornersInOnePlace) {
    const MeshFile read = parsed(two_triangles);
    EXPECT_EQ(read.mesh.points.size(), 4u);
    EXPECT_EQ(read.mesh.triangles.size(), 2u);
    EXPECT_DOUBLE_EQ(area(read.mesh), 2.0);
    EXPECT_EQ(read.without_area, 0);
}

TEST(MeshFile, BinaryStlIsTheSame) {
    const MeshFile read = parsed(binary_stl(plate));
    EXPECT_EQ(read.mesh.points, parsed(two_triangles).mesh.points);
    EXPECT_EQ(read.mesh.triangles, parsed(two_triangles).mesh.triangles);
}

// As other programs and editors write text: all were refused.
TEST(MeshFile, TextStlIsReadHoweverItIsWritten) {
    const auto replaced = [](std::string text, std::string_view from, std::string_view to) {
        for (std::size_t at = text.find(from); at != std::string::npos;
             at = text.find(from, at + to.size())) {
            text.replace(at, from.size(), to);
        }
        return text;
    };
    const std::string text(two_triangles);
    std::string capitals = text;
    std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
    const std::string mark = "\xEF\xBB\xBF";
    for (const std::string& written : {capitals,
                                       replaced(text, "solid", "Solid"),
                                       replaced(text, "facet", "FACET"),
                                       mark + text,
                                       mark + capitals,
                                       replaced(text, "endsolid", "end solid"),
                                       replaced(text, "endloop", "end loop"),
                                       replaced(text, "endfacet", "End Facet"),
                                       replaced(text, "\n", "\r"),
                                       replaced(text, "\n", "\r\n")}) {
        ASSERT_EQ(refusal(written), "none") << written;
        EXPECT_EQ(parsed(written).mesh.points, parsed(text).mesh.points) << written;
        EXPECT_EQ(parsed(written).mesh.triangles, parsed(text).mesh.triangles) << written;
    }
    EXPECT_THAT(refusal(replaced(text, "endloop", "end of loop")),
                HasSubstr(":7: 'endof' is not an STL keyword"));
}

TEST(MeshFile, LinesOfObjAndPlyMayEndInCrAndBeginWithAMark) {
    const std::string mark = "\xEF\xBB\xBF";
    EXPECT_EQ(parsed(mark + "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "a.obj").mesh.triangles.size(), 1u);
    const std::string head = "ply\rformat ascii 1.0\relement vertex 3\rproperty float x\rproperty float y\r"
                             "property float z\relement face 1\rproperty list uchar int vertex_indices\r"
                             "end_header\r";
    EXPECT_EQ(parsed(mark + head + "0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r", "a.ply").mesh.triangles.size(), 1u);
    // Behind a head of such lines a binary file may begin with the byte of a LF.
    std::string binary = head;
    binary.replace(binary.find("ascii"), 5, "binary_little_endian");
    const std::array<float, 9> corners{std::bit_cast<float>(0x3F80000AU), 0, 0, 1, 0, 0, 0, 1, 0};
    append(binary, corners.data(), sizeof corners);
    binary += '\x03';
    const std::array<std::int32_t, 3> face{0, 1, 2};
    append(binary, face.data(), sizeof face);
    ASSERT_EQ(refusal(binary, "a.ply"), "none");
    EXPECT_FLOAT_EQ(static_cast<float>(parsed(binary, "a.ply").mesh.points.front().x()), corners[0]);
}

// They were read over: "the file contains no triangle with an area".
TEST(MeshFile, TriangleStripsOfPlyAreReadWithTheirSides) {
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                             "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                             "end_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
    const MeshFile strip = parsed(head + "6 1 0 3 2 5 4\n", "a.ply");
    EXPECT_EQ(strip.mesh.triangles.size(), 4u);
    EXPECT_DOUBLE_EQ(area(strip.mesh), 2.0);
    for (std::size_t n = 0; n < 4; ++n) {
        EXPECT_GT(strip.mesh.doubled_area(n).z(), 0.0) << n; // all look the same way
    }
    EXPECT_EQ(parsed(head + "9 1 0 3 2 -1 3 2 5 4\n", "a.ply").mesh.triangles.size(), 4u);
    // Strips are joined by corners that come twice.
    const MeshFile joined = parsed(head + "8 1 0 3 3 3 2 5 4\n", "a.ply");
    EXPECT_EQ(joined.mesh.triangles.size(), 3u);
    EXPECT_EQ(joined.without_area, 0);
    EXPECT_THAT(refusal(head + "3 0 1 9\n", "a.ply"), HasSubstr("a.ply:16"));
    EXPECT_THAT(refusal(head + "3 0 1 -2\n", "a.ply"), HasSubstr("-2 is not a valid index"));
}

// They were left out without a word.
TEST(MeshFile, TrianglesBehindThoseThatAStlHeaderCountsAreTold) {
    EXPECT_TRUE(parsed(binary_stl(plate)).notes.empty());
    std::string one = binary_stl(plate);
    one[80] = 1;
    const MeshFile read = parsed(one);
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    EXPECT_THAT(
        read.notes,
        ElementsAre("50 bytes after the triangle declared in the header are ignored: enough for 1 more"));
    EXPECT_THAT(
        parsed(binary_stl(plate) + "end").notes,
        ElementsAre("3 bytes after the 2 triangles declared in the header are ignored: enough for 0 more"));
}

// It was taken for text.
TEST(MeshFile, ABinaryStlThatBeginsWithSolidMayHoldMoreThanItCounts) {
    std::string bytes = binary_stl(plate) + "end";
    bytes.replace(0, 5, "solid");
    EXPECT_EQ(parsed(bytes).mesh.triangles.size(), 2u);
    EXPECT_EQ(parsed(bytes).notes.size(), 1u);
}

TEST(MeshFile, WhatFollowsTheElementsOfAPlyIsTold) {
    const std::string head = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string text = "ply\nformat ascii 1.0\n" + head + "0 0 0\n4 0 0\n0 3 0\n3 0 1 2\n";
    EXPECT_TRUE(parsed(text + " \n\n", "part.ply").notes.empty());
    EXPECT_THAT(
        parsed(text + "\n3 0 2 1\n", "part.ply").notes,
        ElementsAre("everything after the elements declared in the header, from line 15 on, is ignored"));
    std::string binary = "ply\nformat binary_little_endian 1.0\n" + head;
    for (const float value : {0.0F, 0.0F, 0.0F, 4.0F, 0.0F, 0.0F, 0.0F, 3.0F, 0.0F}) {
        append(binary, &value, sizeof value);
    }
    binary += '\3';
    for (const std::int32_t corner : {0, 1, 2}) {
        append(binary, &corner, sizeof corner);
    }
    EXPECT_TRUE(parsed(binary + "\n", "part.ply").notes.empty());
    EXPECT_THAT(parsed(binary + "more", "part.ply").notes,
                ElementsAre("4 bytes after the elements declared in the header are ignored"));
}

TEST(MeshFile, FacesOfManyCornersAreCutUp) {
    const MeshFile read = parsed("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1.5 0\nv 0 1 0\nf 1 2 3 4 5\n", "part.OBJ");
    EXPECT_EQ(read.mesh.triangles.size(), 3u);
    EXPECT_DOUBLE_EQ(area(read.mesh), 2.5);
}

TEST(MeshFile, ReadsPly) {
    const MeshFile read =
        parsed("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n4 0 0\n0 3 0\n3 0 1 2\n",
               "part.ply");
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    EXPECT_DOUBLE_EQ(area(read.mesh), 6.0);
}

TEST(MeshFile, UnitIsTheCallers) {
    EXPECT_EQ(parsed(two_triangles, "part.stl", 25.4).mesh.points[1], Vec3(50.8, 0.0, 0.0));
}

TEST(MeshFile, TrianglesWithoutAreaAreLeftOutAndCounted) {
    const MeshFile read = parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\nf 1 2 2\n", "part.obj");
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    EXPECT_EQ(read.without_area, 2);
}

// A concave arrow: a fan from its first corner would cover what is outside.
TEST(MeshFile, ConcaveFacesKeepTheirArea) {
    const MeshFile read = parsed("v 1 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nv 0 0 0\nf 1 2 3 4 5\n", "part.obj");
    EXPECT_NEAR(area(read.mesh), 4.0, 1e-12);
    for (std::size_t n = 0; n < read.mesh.triangles.size(); ++n) {
        EXPECT_GT(read.mesh.doubled_area(n).z(), 0.0);
    }
}

TEST(MeshFile, CornersMayCountFromTheEndAndGoOnInTheNextLine) {
    const MeshFile read =
        parsed("v 9 9 9\nv 0 0 0\nv 2 0 0\nv 2 1 0 # last\nf -3/1/2 \\\n-2//1 -1 # corner\n", "part.obj");
    EXPECT_EQ(read.mesh.triangles.size(), 1u);
    EXPECT_DOUBLE_EQ(area(read.mesh), 1.0);
}

TEST(MeshFile, BinaryPlyOfEitherByteOrder) {
    for (const bool big : {false, true}) {
        std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                            "_endian 1.0\ncomment made by hand\nelement vertex 3\nproperty double x\n"
                            "property float y\nproperty float z\nproperty uchar red\nelement face 1\n"
                            "property list uchar short vertex_index\nend_header\n";
        const auto put = [&](auto value) {
            std::array<char, sizeof value> raw{};
            std::memcpy(raw.data(), &value, sizeof value);
            if (big) {
                std::ranges::reverse(raw);
            }
            bytes.append(raw.data(), raw.size());
        };
        for (const auto& [x, y] : {std::pair(0.0, 0.0F), std::pair(4.0, 0.0F), std::pair(0.0, 3.0F)}) {
            put(x);
            put(y);
            put(0.0F);
            put(std::uint8_t{200});
        }
        put(std::uint8_t{3});
        for (const int corner : {0, 1, 2}) {
            put(static_cast<std::int16_t>(corner));
        }
        EXPECT_DOUBLE_EQ(area(parsed(bytes, "part.ply").mesh), 6.0);
        EXPECT_THAT(refusal(bytes.substr(0, bytes.size() - 1), "part.ply"), HasSubstr("ends too early"));
    }
}

TEST(MeshFile, SaysWhatIsWrongAndWhere) {
    EXPECT_THAT(refusal(two_triangles, "part.dxf"), HasSubstr("part.dxf: this file type cannot be read"));
    EXPECT_THAT(refusal(""), HasSubstr("part.stl: the file is empty"));
    EXPECT_THAT(refusal("hello, this is no mesh"), HasSubstr("part.stl: neither text nor"));
    EXPECT_THAT(refusal("solid\nouter loop\nvertex 0 0 zero\n"),
                HasSubstr("part.stl:3: 'zero' is not a number"));
    EXPECT_THAT(refusal("solid\nouter loop\nvertex 0 0 1\nendloop\n"), HasSubstr("part.stl:4: a loop has 1"));
    EXPECT_THAT(refusal("solid\nvertex 0 0 1\n"), HasSubstr("part.stl:2: a vertex is outside a loop"));
    EXPECT_THAT(refusal("solid\nouter loop\n"), HasSubstr("the file ends in the middle of a loop"));
    EXPECT_THAT(refusal(binary_stl(plate).substr(0, 150)),
                HasSubstr("part.stl: 2 triangles need 184 bytes, but the file has 150"));
    EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "part.obj"), HasSubstr("no triangle with an area"));
    EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nf 1 2 2\n", "part.obj"), HasSubstr("no triangle with an area"));
    EXPECT_THAT(refusal("v 0 0 0\nf 1 2 3\n", "part.obj"),
                HasSubstr("part.obj:2: a face refers to point 2, but there are only 1"));
    EXPECT_THAT(refusal("v 0 0 0\nf 1 0 1\n", "part.obj"),
                HasSubstr("part.obj:2: '0' is not a valid corner"));
    EXPECT_THAT(refusal("v 0 0 0\nf 1 1\n", "part.obj"), HasSubstr("part.obj:2: a face has only 2 corners"));
    EXPECT_THAT(refusal("ply\nformat ascii 1.0\nelement vertex 0\n", "part.ply"), HasSubstr("no end_header"));
    EXPECT_THAT(refusal("ply\nformat ascii 1.0\nelement vertex 300000000\n", "part.ply"),
                HasSubstr("part.ply:3: '300000000' is not a valid number of elements for this file"));
    EXPECT_THAT(refusal("plyx\n", "part.ply"), HasSubstr("must start with the word ply"));
}

/// As UTF-16, `first` 0: of Intel's byte order.
std::string in_utf16(std::string_view text, std::size_t first) {
    std::string wide;
    for (const char c : text) {
        wide += first == 0 ? std::string{c, '\0'} : std::string{'\0', c};
    }
    return wide;
}

// A text STL was called a binary one of 922761216 triangles.
TEST(MeshFile, TextInUtf16IsNamedAsWhatItIs) {
    for (const std::size_t first : {0U, 1U}) {
        const std::string mark = first == 0 ? "\xFF\xFE" : "\xFE\xFF";
        for (const char* name : {"part.stl", "part.obj", "part.ply"}) {
            EXPECT_THAT(refusal(in_utf16(two_triangles, first), name),
                        HasSubstr("the file is text in UTF-16"));
            EXPECT_THAT(refusal(mark + in_utf16(two_triangles, first), name), HasSubstr("is text in UTF-16"));
        }
    }
}

TEST(MeshFile, NumbersThatAreNotFiniteAreRefused) {
    std::array<float, 18> broken = plate;
    broken[4] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(binary_stl(broken)), HasSubstr("not a finite number"));
    broken[4] = std::numeric_limits<float>::infinity();
    EXPECT_THAT(refusal(binary_stl(broken)), HasSubstr("not a finite number"));
}

TEST(MeshFile, CanBeCancelled) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW((void)parse_mesh(two_triangles, "part.stl", 1.0, Progress({}, stop.get_token())), Cancelled);
}

} // namespace
} // namespace millwright::exchange
