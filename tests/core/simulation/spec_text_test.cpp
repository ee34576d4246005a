#include "core/simulation/spec_text.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::simulation {
namespace {

using testing::HasSubstr;

BoxStock box_from(std::string_view text) {
    return std::get<BoxStock>(*parse_stock(text).stock);
}
CylinderStock cylinder_from(std::string_view text) {
    return std::get<CylinderStock>(*parse_stock(text).stock);
}
template <class Parse> Diagnostic refusal(Parse parse, std::string_view text) {
    try {
        (void)parse(text);
    } catch (const Error& error) {
        return error.diagnostic();
    }
    ADD_FAILURE() << text << " was accepted";
    return {};
}

TEST(StockText, NamesBoxesCylindersAndTubes) {
    EXPECT_EQ(box_from("box:60,40,10").low, Vec3(0.0, 0.0, -10.0));
    EXPECT_EQ(box_from("box:60,40,10").high, Vec3(60.0, 40.0, 0.0));
    EXPECT_EQ(box_from("box:60,40,10@-5,+2.5,1e1").high, Vec3(55.0, 42.5, 20.0));
    EXPECT_EQ(cylinder_from("cylinder:30,50").base, Vec3(0.0, 0.0, -50.0));
    EXPECT_EQ(cylinder_from("cylinder:30,50,x").axis, 0);
    EXPECT_EQ(cylinder_from("cylinder:30,50,x").base, Vec3::Zero());
    const CylinderStock tube = cylinder_from("tube:30,12,50,y@1,2,3");
    EXPECT_EQ(tube.axis, 1);
    EXPECT_DOUBLE_EQ(tube.bore, 12.0);
    EXPECT_DOUBLE_EQ(tube.length, 50.0);
    EXPECT_EQ(tube.base, Vec3(1.0, 2.0, 3.0));
}

TEST(StockText, NamesMeshesWithAPlace) {
    EXPECT_EQ(parse_stock("a/b.STL").mesh_file, "a/b.STL");
    EXPECT_EQ(parse_stock("a.ply@1,2,3").mesh_file, "a.ply");
    EXPECT_EQ(parse_stock("a.ply@1,2,3").shift, Vec3(1.0, 2.0, 3.0));
    EXPECT_EQ(parse_stock("me@home/a.obj").mesh_file, "me@home/a.obj");
}

TEST(StockText, SaysWhatIsWrongAndWhere) {
    const Diagnostic found = refusal(parse_stock, "box:60,x,10");
    EXPECT_EQ(found.message, "\"box:60,x,10\", column 8: \"x\" is not a number");
    EXPECT_THAT(found.hint, HasSubstr("box:LX,LY,LZ"));
    EXPECT_THAT(refusal(parse_stock, "box:60,0,10").message, HasSubstr("is not above 0"));
    EXPECT_THAT(refusal(parse_stock, "box:60,nan,10").message, HasSubstr("is not a number"));
    EXPECT_THAT(refusal(parse_stock, "box:60,1e300,10").message, HasSubstr("is beyond 100000"));
    EXPECT_THAT(refusal(parse_stock, "box:60,40").message, HasSubstr("is not three lengths"));
    EXPECT_THAT(refusal(parse_stock, "box:60,40,10@1,2").message, HasSubstr("is not three numbers"));
    EXPECT_THAT(refusal(parse_stock, "tube:30,50,10").message, HasSubstr("bore of 50 mm does not fit"));
    EXPECT_THAT(refusal(parse_stock, "cylinder:30").message, HasSubstr("is not diameter and length"));
    for (const char* text : {"", "box", "ball:3", "@", "box:", "sphere:3,4,5", ":", "a.step"}) {
        EXPECT_THAT(refusal(parse_stock, text).message, HasSubstr("\"")) << text;
    }
}

toolpath::ProfileShape shape_from(std::string_view text) {
    return parse_tool(text).body->shape();
}

TEST(ToolText, NamesEveryKind) {
    EXPECT_EQ(shape_from("flat:6"), (toolpath::ProfileShape{.flat = 3.0, .radius = 3.0, .top = 50.0}));
    EXPECT_EQ(shape_from("ball:6:l20"), (toolpath::ProfileShape{.corner = 3.0, .radius = 3.0, .top = 20.0}));
    EXPECT_EQ(shape_from("bull:20:2"),
              (toolpath::ProfileShape{.flat = 8.0, .corner = 2.0, .radius = 10.0, .top = 100.0}));
    EXPECT_DOUBLE_EQ(shape_from("v:60:6").half_angle, from_degrees(30.0));
    EXPECT_DOUBLE_EQ(shape_from("v:60:6:0.2").flat, 0.1);
    EXPECT_DOUBLE_EQ(shape_from("v:60:6:r0.2").corner, 0.2);
    EXPECT_DOUBLE_EQ(shape_from("drill:5").half_angle, from_degrees(59.0));
    EXPECT_DOUBLE_EQ(shape_from("drill:5:140").half_angle, from_degrees(70.0));
}

TEST(ToolText, HasANumberAndFiles) {
    EXPECT_EQ(parse_tool("3=flat:6").number, 3);
    EXPECT_EQ(parse_tool("flat:6").number, std::nullopt);
    EXPECT_EQ(parse_tool("12=a/b.json").file, "a/b.json");
    EXPECT_EQ(parse_tool("12=a/b.json").number, 12);
}

TEST(ToolText, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(refusal(parse_tool, "2=flat:zz").message, "\"2=flat:zz\", column 8: \"zz\" is not a number");
    EXPECT_THAT(refusal(parse_tool, "bull:6:4").message, HasSubstr("is no corner radius of this tool"));
    EXPECT_THAT(refusal(parse_tool, "v:180:6").message, HasSubstr("below 180"));
    EXPECT_THAT(refusal(parse_tool, "v:60:6:9").message, HasSubstr("is wider than the tool"));
    EXPECT_THAT(refusal(parse_tool, "v:1:6").message, HasSubstr("and the tool is 50 mm long"));
    EXPECT_THAT(refusal(parse_tool, "ball:6:l2").message, HasSubstr("shorter than its corner"));
    EXPECT_THAT(refusal(parse_tool, "flat:6:2").message, HasSubstr("too few numbers, or too many"));
    for (const char* text :
         {"", "flat", "flat:", "endmill:6", "=flat:6", "x=flat:6", "flat:l5", "v:l5", "bull:l5"}) {
        EXPECT_THAT(refusal(parse_tool, text).hint, HasSubstr("flat:D")) << text;
    }
}

} // namespace
} // namespace millwright::simulation
