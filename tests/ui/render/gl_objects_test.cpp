#include "ui/render/gl_objects.h"

#include "core/base/error.h"
#include "ui/render/offscreen_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>

namespace millwright::render {
namespace {

const std::array<std::byte, 16> bytes = {};

TEST(GlHandle, DeletesItsObjectOnce) {
    const OffscreenContext context({4, 4});
    GlId id = 0;
    {
        Buffer first{bytes};
        id = first.id();
        const Buffer second = std::move(first);
        EXPECT_EQ(second.id(), id);
        EXPECT_EQ(glIsBuffer(id), GL_TRUE);
    }
    EXPECT_EQ(glIsBuffer(id), GL_FALSE);
}

TEST(GlHandle, DeletesWhatIsAssignedOver) {
    const OffscreenContext context({4, 4});
    Buffer buffer{bytes};
    const GlId old = buffer.id();
    buffer = Buffer{bytes};
    EXPECT_EQ(glIsBuffer(old), GL_FALSE);
    EXPECT_EQ(glIsBuffer(buffer.id()), GL_TRUE);
}

TEST(Texture, RefusesAWrongNumberOfBytes) {
    const OffscreenContext context({4, 4});
    EXPECT_NO_THROW(Texture({2, 2}, bytes, Filter::nearest));
    EXPECT_THROW(Texture({2, 3}, bytes, Filter::nearest), Defect);
    EXPECT_THROW(Texture({0, 3}, {}, Filter::nearest), Defect);
}

} // namespace
} // namespace millwright::render
