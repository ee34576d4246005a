// What a model of the thesis's processor has to do, one test a promise, from the core of the arithmetic to
// the programs that run on it. The folders' own tests go deeper.
#include "core/base/units.h"
#include "core/cordic/disassembler.h"
#include "core/cordic/interpolation.h"
#include "core/cordic/pipeline.h"
#include "core/cordic/processor.h"
#include "core/cordic/quadrant_fold.h"
#include "core/cordic/run_report.h"
#include "core/cordic/vcd.h"
#include "core/cordic_control/plc_assembler.h"
#include "core/cordic_control/stitch_timing.h"
#include "core/cordic_control/supervised_run.h"
#include "core/cordic_machine/cordic_program.h"
#include "core/cordic_study/comparison.h"
#include "core/gcode/interpreter.h"
#include "tests/core/cordic/golden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace millwright::gcode {
namespace {

using cordic::FloatArithmetic;
using cordic::Kernel;
using cordic::thesis_sequence;
namespace golden = cordic::golden;

template <class Number> Kernel<FloatArithmetic<Number>> kernel() {
    return {FloatArithmetic<Number>(), thesis_sequence()};
}

cordic_machine::CordicProgramSettings in_binary64() {
    cordic_machine::CordicProgramSettings settings;
    settings.format = cordic::binary64;
    return settings;
}

cordic_machine::CordicProgram compiled_thesis_program(const std::string& text,
                                                      const cordic_machine::CordicProgramSettings& settings) {
    cordic_machine::CordicProgramBuilder builder("thesis.ngc", settings);
    Interpreter program(std::string_view(text), "thesis.ngc", {}, builder);
    program.run();
    EXPECT_TRUE(program.errors().empty());
    return builder.take();
}

cordic::Processor executed(const cordic_machine::CordicProgram& program) {
    cordic::Processor processor({}, program.image);
    processor.run(1'000'000'000);
    EXPECT_EQ(processor.state().stop, cordic::Stop::halted);
    return processor;
}

TEST(Thesis, CoreMatchesTheHexVectorsBitForBitInBinary64) {
    bool overflow = false;
    for (const auto& wanted : golden::rotations) {
        const auto found = kernel<double>().rotated({wanted.x, wanted.y, wanted.z}, overflow);
        EXPECT_EQ(found, (cordic::Vector3<double>{wanted.x_out, wanted.y_out, wanted.z_out}));
    }
    for (const auto& wanted : golden::vectorings) {
        const auto found = kernel<double>().vectored({wanted.x, wanted.y, 0.0}, overflow);
        EXPECT_EQ(found.x, wanted.length);
        EXPECT_EQ(found.z, wanted.angle);
    }
    EXPECT_FALSE(overflow);
}

TEST(Thesis, GainsCorrectionsAndRangesEqualTheTableTo1e12) {
    struct Row {
        cordic::CoordinateSystem m;
        double gain, correction, range;
    };
    using cordic::CoordinateSystem;
    for (const Row& row :
         {Row{CoordinateSystem::circular, 1.27544518598050299, 0.784039962994691197, 1.70857018578320988},
          Row{CoordinateSystem::linear, 1.0, 1.0, 1.76574701070785522},
          Row{CoordinateSystem::hyperbolic,
              0.753126104724598985,
              1.32779885129881577,
              1.83745609184498476}}) {
        const cordic::Sequence sequence = thesis_sequence(row.m);
        EXPECT_NEAR(cordic::gain(sequence), row.gain, 1e-12);
        EXPECT_NEAR(cordic::correction(sequence), row.correction, 1e-12);
        EXPECT_NEAR(cordic::convergence_range(sequence), row.range, 1e-12);
    }
}

TEST(Thesis, InputsOutsideTheConvergenceRangeAreDetected) {
    const auto core = kernel<double>();
    const auto rad = [](double degrees) { return degrees * pi / 180.0; };
    EXPECT_EQ(core.reach_of_rotation(rad(97.8)), cordic::Reach::inside);
    EXPECT_EQ(core.reach_of_rotation(rad(98.0)), cordic::Reach::outside);
    EXPECT_EQ(core.reach_of_rotation(rad(-120.0)), cordic::Reach::outside);
    EXPECT_EQ(core.reach_of_vectoring(std::cos(rad(97.0)), std::sin(rad(97.0))), cordic::Reach::inside);
    EXPECT_EQ(core.reach_of_vectoring(std::cos(rad(100.0)), std::sin(rad(100.0))), cordic::Reach::outside);
}

TEST(Thesis, PreAndPostMakeAnExactRoundTripThroughTheSectors) {
    const FloatArithmetic<double> numbers;
    for (int tenth = -1800; tenth <= 1800; ++tenth) {
        const double angle = tenth * pi / 1800.0;
        const double x = std::cos(angle);
        const double y = std::sin(angle);
        bool overflow = false;
        const auto folded = cordic::pre(numbers, x, y, overflow);
        EXPECT_EQ(folded.f1, y >= x);
        EXPECT_EQ(folded.f2, (y >= x ? y : x) < 0.0);
        EXPECT_GE(folded.x, 0.0);
        const auto back = cordic::post(numbers, folded, overflow);
        EXPECT_EQ(back.x, x);
        EXPECT_EQ(back.y, y);
    }
}

TEST(Thesis, SignOfZeroIsPositiveAndTheMatlabDefectIsASwitch) {
    const cordic_machine::CordicProgram program =
        compiled_thesis_program("G21 F30 G1 X8\nM2\n", in_binary64());
    EXPECT_NEAR(executed(program).set_point(executed(program).published()[0]).vx, 0.5, 2e-9);
    cordic::ProcessorSettings matlab;
    matlab.zero = cordic::SignOfZero::zero;
    cordic::Processor short_of_speed(matlab, program.image);
    short_of_speed.run(10'000);
    EXPECT_NEAR(short_of_speed.set_point(short_of_speed.published()[0]).vx, 0.392019981, 1e-9);
}

template <class Number> double worst_speed_error(int count) {
    std::mt19937 random(2002);
    std::uniform_real_distribution<double> turn(-pi, pi);
    std::uniform_real_distribution<double> power(-6.0, 3.0);
    double worst = 0.0;
    for (int n = 0; n < count; ++n) {
        const double angle = turn(random);
        const double length = std::pow(10.0, power(random));
        const auto x = static_cast<Number>(length * std::cos(angle));
        const auto y = static_cast<Number>(length * std::sin(angle));
        bool overflow = false;
        const auto set = cordic::line_set_point(
            kernel<Number>(), x, y, Number{0}, Number{0}, Number{1}, Number{1}, overflow);
        const double far = std::hypot(static_cast<double>(x), static_cast<double>(y));
        worst = std::max({worst,
                          std::abs(static_cast<double>(set.vx) - static_cast<double>(x) / far),
                          std::abs(static_cast<double>(set.vy) - static_cast<double>(y) / far)});
    }
    return worst;
}

TEST(Thesis, LinesOfAnyDirectionAndLengthHaveTheirSpeedWithinTheBounds) {
    EXPECT_LE(worst_speed_error<double>(100'000), 6e-8);
    EXPECT_LE(worst_speed_error<float>(100'000), 8e-7);
}

TEST(Thesis, ArcsOfAnyNumberOfChordsAndBothDirectionsReachTheirEnd) {
    for (const int chords : {4, 5, 50, 1000, 65536}) {
        for (const double sweep : {-2.0 * pi, -1.5 * pi, 0.1, 2.0 * pi}) {
            double x = 10.0;
            double y = 10.0;
            bool overflow = false;
            for (int n = 0; n < chords; ++n) {
                const auto next =
                    cordic::arc_point(kernel<double>(), 5.0, 10.0, x, y, sweep / chords, overflow);
                x = next.x;
                y = next.y;
            }
            // Each chord shrinks the radius by 3.58e-9 of it and turns it by 6e-8 rad too much at most.
            const double bound = 5.0 * chords * 6.4e-8;
            EXPECT_NEAR(x, 5.0 + 5.0 * std::cos(sweep), bound) << chords << ' ' << sweep;
            EXPECT_NEAR(y, 10.0 + 5.0 * std::sin(sweep), bound) << chords << ' ' << sweep;
        }
    }
}

TEST(Thesis, CompilerTakesAbsoluteAndIncrementalCentresAndRadiiAndReportsEndsThatDoNotMatch) {
    const cordic_machine::CordicProgramSettings settings = in_binary64();
    const cordic_machine::CordicProgram relative =
        compiled_thesis_program("G21 F60 G0 X10 Y10\nG3 X5 Y5 I-5 J0\nM2\n", settings);
    const cordic_machine::CordicProgram absolute =
        compiled_thesis_program("G21 F60 G90.1 G0 X10 Y10\nG3 X5 Y5 I5 J10\nM2\n", settings);
    const cordic_machine::CordicProgram radius =
        compiled_thesis_program("G21 F60 G0 X10 Y10\nG3 X5 Y5 R-5\nM2\n", settings);
    EXPECT_EQ(absolute.image, relative.image);
    EXPECT_EQ(radius.points.size(), relative.points.size());
    cordic_machine::CordicProgramBuilder builder("thesis.ngc", settings);
    Interpreter wrong(
        std::string_view("G21 F60 G0 X10 Y10\nG3 X5 Y6 I-5 J0\nM2\n"), "thesis.ngc", {}, builder);
    wrong.run();
    ASSERT_EQ(wrong.errors().size(), 1U);
    EXPECT_EQ(wrong.errors()[0].place.line, 2);
}

TEST(Thesis, TheLastChordLandsExactlyOnTheProgrammedEnd) {
    const cordic_machine::CordicProgram program =
        compiled_thesis_program("G21 F60 G0 X10 Y10\nG3 X5 Y5 I-5 J0\nM2\n", in_binary64());
    const cordic::Processor processor = executed(program);
    const auto end = processor.set_point(processor.published().back());
    EXPECT_EQ(end.x, 5.0);
    EXPECT_EQ(end.y, 5.0);
}

TEST(Thesis, ALineIs74ClocksOfCordicAndAChord111) {
    cordic_machine::CordicProgramSettings settings = in_binary64();
    settings.arc_end = cordic_machine::ArcEnd::rotated;
    const cordic_machine::CordicProgram program =
        compiled_thesis_program("G21 F60 G0 X10 Y10\nG3 X5 Y5 I-5 J0\nM2\n", settings);
    const cordic::Processor processor = executed(program);
    const auto chords = static_cast<std::int64_t>(processor.published().size()) - 1;
    EXPECT_EQ(processor.state().clocks.cordic, 74 + 111 * chords);
}

TEST(Thesis, ComparisonHasTheNumbersOfItsSpeedExperiment) {
    const auto slow = cordic::line_time(cordic::mcs51_line_clocks, cordic::mcs51_clock_hz);
    const auto fast = cordic::line_time(74, 8e6);
    EXPECT_NEAR(slow.seconds, 1.337e-3, 1e-9);
    EXPECT_NEAR(100.0 * fast.reduction, 99.308, 5e-4);
    EXPECT_NEAR(fast.times_fewer, 144.5, 0.05);
    EXPECT_EQ(std::floor(slow.most_rpm), 44'876);
    EXPECT_EQ(std::floor(fast.most_rpm), 6'486'486);
    EXPECT_NEAR(cordic::stitch_times({}, slow.seconds).screw_rpm, 675.0, 1e-9);
    EXPECT_NEAR(100.0 * cordic::stitch_times({}, slow.seconds).share, 6.68, 0.01);
}

TEST(Thesis, SewingMissesItsDeadlineOnlyWhereTheComputationTakesLongerThanAStitch) {
    const std::array<cordic::Stitch, 3> stitches{{{1e-3, 3.0}, {25e-3, 3.0}, {9.25e-6, 3.0}}};
    const auto run = cordic::time_stitches({}, stitches);
    EXPECT_EQ(run.late_computations, 1);
    EXPECT_EQ(run.late, std::vector<std::size_t>{1});
    EXPECT_EQ(run.late_moves, 0);
}

TEST(Thesis, ReferenceModelRunsSideBySideOverItsOwnPath) {
    const std::string path =
        "G21 G90.1 F60\nG1 X8\nY6\nX6\nG2 X4 Y4 I4 J6\nG1 X2\nG3 X0 Y2 I2 J2\nG1 Y0\nM2\n";
    const cordic_machine::CordicProgram program = compiled_thesis_program(path, in_binary64());
    const auto report = cordic::report_of(executed(program), program.points, 8e6);
    EXPECT_EQ(report.published, report.expected);
    EXPECT_LT(report.position_error, 1e-5);
    EXPECT_LT(report.speed_error, 1e-5);
    EXPECT_GT(report.position_error, 0.0); // it is no copy of the model
}

TEST(Thesis, TheExamplesOfTable21CompileToExactlyThoseInstructions) {
    const auto instructions = [](const std::string& text) {
        std::string names;
        const cordic_machine::CordicProgram program = compiled_thesis_program(text, in_binary64());
        for (std::span<const std::uint8_t> code(program.image.code); !code.empty();) {
            const auto found = cordic::decode(code, program.image.format);
            EXPECT_TRUE(found.has_value());
            names += found->instruction.opcode == cordic::Opcode::mov
                         ? std::string(cordic::to_text(found->instruction.target)) + " "
                         : std::string(cordic::to_text(found->instruction.opcode)) + " ";
            code = code.subspan(static_cast<std::size_t>(found->size));
        }
        return names;
    };
    EXPECT_EQ(instructions("G0 X5 Y5\nG0 X0 Y0\nM2\n"), "Vmax Amax XI YJ G00 XI YJ G00 M02 ");
    cordic_machine::CordicProgramSettings rotated = in_binary64();
    rotated.arc_end = cordic_machine::ArcEnd::rotated;
    const cordic_machine::CordicProgram arc =
        compiled_thesis_program("G21 F60 G90.1 G0 X0 Y100\nG2 X100 Y100 I50 J50\nM2\n", rotated);
    const std::string text = cordic::disassemble(arc.image);
    for (const char* wanted : {"MOV XI, 50", "MOV YJ, 50", "MOV Dz, ", "MOV N, ", "G02"}) {
        EXPECT_NE(text.find(wanted), std::string::npos) << wanted;
    }
}

TEST(Thesis, ControlUnitBeginsAtZeroAndStopsWhereItsStackOfFourOverflowsOrIsEmpty) {
    const auto stop_of = [](const std::string& text) {
        auto made = cordic::assemble_microprogram(text, "unit.micro");
        EXPECT_TRUE(made.errors.empty());
        const cordic::Image nothing{cordic::binary32, {0x01}};
        cordic::Processor processor({}, nothing, std::move(made.program));
        EXPECT_EQ(processor.state().sequencer.address, 0);
        processor.run(100);
        return processor.state().stop;
    };
    EXPECT_EQ(stop_of("CJS always B\nJZ | halt\nB: CJS always C\nCRTN always\nC: CJS always D\nCRTN always\n"
                      "D: CJS always E\nCRTN always\nE: CRTN always\n"),
              cordic::Stop::halted);
    EXPECT_EQ(stop_of("A: CJS always A\n"), cordic::Stop::stack_overflow);
    EXPECT_EQ(stop_of("CRTN always\n"), cordic::Stop::stack_underflow);
}

TEST(Thesis, BusReadsWithAleThenPsenAndWritesWithAleThenWrAsAWaveform) {
    cordic::ProcessorSettings settings;
    settings.publishing = cordic::Publishing::bus;
    const cordic_machine::CordicProgram program = compiled_thesis_program("G0 X1\nM2\n", in_binary64());
    cordic::Processor processor(settings, program.image);
    cordic::VcdWriter waves(processor.format(), 8e6);
    bool addressed = false;
    int reads = 0;
    int writes = 0;
    while (processor.state().stop == cordic::Stop::none) {
        processor.clock();
        waves.add(processor.state());
        const cordic::BusPins& pins = processor.state().bus.pins;
        EXPECT_LE(pins.ale + pins.psen + pins.rd + pins.wr, 1);
        EXPECT_TRUE(addressed || !(pins.psen || pins.rd || pins.wr)); // never without an address before
        addressed = pins.ale || (addressed && !(pins.psen || pins.rd || pins.wr));
        reads += pins.psen ? 1 : 0;
        writes += pins.wr ? 1 : 0;
    }
    EXPECT_EQ(reads, static_cast<int>(program.image.code.size()));
    EXPECT_EQ(writes, 6 * 8 + 5); // the record, and M02
    EXPECT_NE(waves.take().find(" ALE $end"), std::string::npos);
}

TEST(Thesis, FixedAndFloatVariantsHaveTheErrorsOfTheReport) {
    struct Level {
        cordic::NumberFormat format;
        double rotation; ///< largest error of a unit vector at half degrees
    };
    for (const Level& level : {Level{cordic::binary64, 5.97e-8},
                               Level{cordic::fixed_format(4, 16), 1.68e-4},
                               Level{cordic::fixed_format(4, 20), 8.58e-6},
                               Level{cordic::fixed_format(4, 24), 4.45e-7},
                               Level{cordic::fixed_format(4, 28), 7.95e-8},
                               Level{cordic::fixed_format(4, 32), 6.02e-8},
                               Level{cordic::fixed_format(4, 40), 5.94e-8}}) {
        const double worst = cordic::with_arithmetic(level.format, [&](const auto& arithmetic) {
            const Kernel kernel(arithmetic, thesis_sequence());
            double found = 0.0;
            bool overflow = false;
            for (int n = -180; n <= 180; ++n) {
                const double z = n * pi / 360.0;
                const auto v = kernel.rotated({arithmetic.from_double(1.0, overflow),
                                               arithmetic.from_double(0.0, overflow),
                                               arithmetic.from_double(z, overflow)},
                                              overflow);
                found = std::max({found,
                                  std::abs(arithmetic.to_double(v.x) - std::cos(z)),
                                  std::abs(arithmetic.to_double(v.y) - std::sin(z))});
            }
            return found;
        });
        EXPECT_NEAR(worst / level.rotation, 1.0, 0.01) << cordic::to_text(level.format);
    }
}

TEST(Thesis, LogicIsScannedBesideTheMotionWithTimersAndInterlocks) {
    const cordic_machine::CordicProgram program =
        compiled_thesis_program("G21 F600\nM3 S100\nG1 X10\nM110\nG1 X0\nM30\n", in_binary64());
    cordic::Processor processor({}, program.image);
    cordic::Plc plc(cordic::assemble_plc("LD I0\nST HOLD\nLD U110\nTON T0, 200\nST FIN\n", "logic"));
    cordic::SupervisedSettings settings;
    settings.inputs = {{0.2, 0, true}, {0.7, 0, false}};
    const auto done = cordic::run_supervised(processor, plc, settings);
    EXPECT_EQ(done.end, cordic::SupervisedEnd::finished);
    EXPECT_NEAR(done.held_seconds, 0.5, 3e-3);   // the interlock
    EXPECT_NEAR(done.waited_seconds, 0.2, 3e-3); // the timer behind the machine's own M110
    EXPECT_NEAR(done.seconds, 2.0 + 0.5 + 0.2, 1e-2);
}

TEST(Thesis, PipelineGivesAResultAClockAfterItsFillWithTheBitsOfTheIteration) {
    const auto iterative = kernel<double>();
    cordic::Pipeline pipeline(iterative, cordic::Mode::rotation);
    int ready = 0;
    for (int n = 0; n < 137; ++n) {
        const auto vector = [](int k) { return cordic::Vector3<double>{1.0, 0.1, 0.01 * k}; };
        if (const auto out = pipeline.clock(vector(n))) {
            bool overflow = false;
            EXPECT_EQ(out->vector, iterative.rotated(vector(ready), overflow));
            ++ready;
        }
    }
    EXPECT_EQ(pipeline.latency(), 29 + 8);
    EXPECT_EQ(ready, 100);
}

TEST(Thesis, ZeroLengthTinyAndHugeMovesEndInADefinedState) {
    cordic_machine::CordicProgramSettings narrow;
    narrow.format = cordic::fixed_format(10, 6);
    narrow.acceleration = 100.0;
    const cordic_machine::CordicProgram still =
        compiled_thesis_program("G21 F60\nG1 X1\nG1 X1\nG1 X1.001\nM2\n", narrow);
    EXPECT_EQ(still.warnings.size(), 2U);
    EXPECT_EQ(executed(still).published().size(), 1U);
    const cordic_machine::CordicProgram huge = compiled_thesis_program("G21 F60\nG1 X600\nM2\n", narrow);
    ASSERT_EQ(huge.faults.size(), 1U);
    EXPECT_EQ(huge.faults[0].place.column, 4);
    const cordic_machine::CordicProgram far =
        compiled_thesis_program("G21 F60\nG1 X-500\nG1 X500\nM2\n", narrow);
    cordic::Processor processor({}, far.image);
    processor.run(10'000);
    EXPECT_EQ(processor.state().stop, cordic::Stop::overflow); // of the way, not of an end
    EXPECT_EQ(processor.published().size(), 1U);
}

} // namespace
} // namespace millwright::gcode
