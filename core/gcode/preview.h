// A program on its way into a preview: the path of the tool tip, and what is in force when.
#pragma once

#include "core/gcode/canon.h"
#include "core/gcode/preview_path.h"
#include "core/kinematics/machine_model.h"

#include <functional>
#include <memory>

namespace millwright::gcode {

struct PreviewSettings {
    /// Whose tool tip it is: positions are then those on its workpiece. Null: X Y Z as they are programmed,
    /// with all offsets.
    std::shared_ptr<const kinematics::MachineModel> machine;
    double chord_tolerance = 0.01; ///< mm: of arcs, splines and of straight ways that rotary axes bend
};

/// The sink of an interpreter. Chunks are handed on as they are full, the last by finish().
class PreviewBuilder final : public CanonSink {
public:
    using ChunkListener = std::function<void(std::shared_ptr<const PathChunk>)>;

    PreviewBuilder(PreviewSettings settings, ChunkListener listener);
    PreviewBuilder(const PreviewBuilder&) = delete;
    PreviewBuilder& operator=(const PreviewBuilder&) = delete;
    ~PreviewBuilder() override;

    /// To be called before each line that is executed.
    void begin_step(Step step);
    /// The path so far as a chunk, without waiting until it is full.
    void finish();

    void move(const Move& move, const SourceLine& now) override;
    void curve(const Curve& curve, const SourceLine& now) override;
    void command(const Command& command, const SourceLine& now) override;

    /// s, as fast as programmed; rapids at the speed of the machine, dwells included.
    [[nodiscard]] double seconds() const;
    /// Of the ways of the tip, mm.
    [[nodiscard]] double length() const;

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace millwright::gcode
