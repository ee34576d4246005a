// A path of millions of pieces on the graphics card, of which each picture shows as many as there is time
// for, those first that matter most on the screen.
#pragma once

#include "core/gcode/preview_path.h"
#include "ui/render/path_drawer.h"
#include "ui/viewport/internal/layer.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace millwright::viewport {

class PathBuffers {
public:
    /// A stretch of the same path only grows; of another one every chunk is another. False if something is
    /// left for the next time.
    bool follow(const std::vector<std::shared_ptr<const gcode::PathChunk>>& chunks);
    void clear();

    /// `rough`: as many pieces as a moving picture has time for. Points before `done` have the style's other
    /// colours. `share` of the pieces that there is time for, above 0 to 1.
    void draw(const Scene& scene,
              const Canvas& canvas,
              render::PathStyle style,
              bool rough,
              std::int64_t done = -1,
              double share = 1.0) const;

private:
    std::vector<std::shared_ptr<const gcode::PathChunk>> shown_;
    std::vector<render::PathBuffer> buffers_; ///< of `shown_`
};

} // namespace millwright::viewport
