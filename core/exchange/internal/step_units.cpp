#include "core/exchange/internal/step_units.h"

#include "core/base/error.h"

#include <Interface_Check.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <Standard_Version.hxx>
#include <StepBasic_ConversionBasedUnitAndLengthUnit.hxx>
#include <StepBasic_LengthMeasureWithUnit.hxx>
#include <StepBasic_MeasureValueMember.hxx>
#include <StepBasic_MeasureWithUnit.hxx>
#include <StepBasic_NamedUnit.hxx>
#include <StepBasic_SiUnitAndLengthUnit.hxx>
#include <StepBasic_Unit.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <TCollection_HAsciiString.hxx>
#include <fmt/format.h>

#if OCC_VERSION_HEX >= 0x070800
#include <StepData_Factors.hxx>
#endif

#include <algorithm>
#include <cmath>
#include <set>

namespace millwright::exchange {

namespace {

using LengthConversion = StepBasic_ConversionBasedUnitAndLengthUnit;
using ContextWithUnits = StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext;
using ContextWithUncertainty = StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx;

/// What the unit, or the set of units, comes to: a length in mm.
template <typename Units> STEPConstruct_UnitContext factors_of(const Handle(Units) & units) {
    STEPConstruct_UnitContext factors;
#if OCC_VERSION_HEX >= 0x070800
    (void)factors.ComputeFactors(units, StepData_Factors());
#else
    (void)factors.ComputeFactors(units);
#endif
    return factors;
}

class StepUnits {
public:
    StepUnits(const StepData_StepModel& model, const std::string& text, const std::filesystem::path& file)
        : model_(model), text_(text), file_(file) {}

    [[nodiscard]] std::vector<std::string> settled() {
        for (int n = 1; n <= model_.NbEntities(); ++n) {
            unfold(Handle(LengthConversion)::DownCast(model_.Value(n)));
        }
        for (int n = 1; n <= model_.NbEntities(); ++n) {
            look_at_context(model_.Value(n));
        }
        if (contexts_ == 0) {
            notes_.emplace_back("the file does not state a unit of length: mm is assumed");
        }
        if (told_.size() > notes_.size()) {
            notes_.push_back(fmt::format("and {} more of this kind", told_.size() - notes_.size()));
        }
        return std::move(notes_);
    }

private:
    [[nodiscard]] std::string label(const Handle(Standard_Transient) & entity) const {
        return model_.StringLabel(entity)->ToCString();
    }

    /// Where the entity begins; 0 if that is not found, as of one that is written otherwise (#0106).
    [[nodiscard]] int line_of(const std::string& entity) const {
        for (std::size_t at = text_.find(entity); at != std::string::npos; at = text_.find(entity, at + 1)) {
            const std::size_t next = text_.find_first_not_of(" \t\r\n", at + entity.size());
            if (next != std::string::npos && text_[next] == '=') {
                return 1 + static_cast<int>(std::count(
                               text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
            }
        }
        return 0;
    }

    /// "#106 in line 137"
    [[nodiscard]] std::string place(const Handle(Standard_Transient) & entity) const {
        const int line = line_of(label(entity));
        return line > 0 ? fmt::format("{} in line {}", label(entity), line) : label(entity);
    }

    /// Whether there is something to report of `entity` that was not: each is reported once, and only the
    /// first few.
    bool is_to_be_told(const Handle(Standard_Transient) & entity) {
        constexpr std::size_t few = 20;
        return told_.insert(model_.Number(entity)).second && told_.size() <= few;
    }

    /// Gives the unit the factor to what stands at the end of its conversions.
    void unfold(const Handle(LengthConversion) & unit) const {
        if (unit.IsNull() || unit->ConversionFactor().IsNull()) {
            return;
        }
        constexpr int most_steps = 16; // a file may go round in a circle
        double factor = 1.0;
        Handle(StepBasic_MeasureWithUnit) measure = unit->ConversionFactor();
        for (int step = 0; step < most_steps; ++step) {
            factor *= measure->ValueComponent();
            const auto next = Handle(LengthConversion)::DownCast(measure->UnitComponent().NamedUnit());
            if (next.IsNull() || next->ConversionFactor().IsNull()) {
                break;
            }
            measure = next->ConversionFactor();
        }
        if (measure != unit->ConversionFactor()) {
            const Handle(StepBasic_MeasureValueMember) value = new StepBasic_MeasureValueMember;
            value->SetName("LENGTH_MEASURE");
            value->SetReal(factor);
            const Handle(StepBasic_LengthMeasureWithUnit) whole = new StepBasic_LengthMeasureWithUnit;
            whole->Init(value, measure->UnitComponent());
            unit->SetConversionFactor(whole);
        }
    }

    void look_at_context(const Handle(Standard_Transient) & entity) {
        const auto with_units = Handle(ContextWithUnits)::DownCast(entity);
        const auto with_uncertainty = Handle(ContextWithUncertainty)::DownCast(entity);
        if (!with_units.IsNull()) {
            look_at_units(entity, with_units->GlobalUnitAssignedContext());
        } else if (!with_uncertainty.IsNull()) {
            look_at_units(entity, with_uncertainty->GlobalUnitAssignedContext());
        }
    }

    void look_at_units(const Handle(Standard_Transient) & context,
                       const Handle(StepRepr_GlobalUnitAssignedContext) & units) {
        ++contexts_;
        const STEPConstruct_UnitContext taken = factors_of(units);
        const int count = units.IsNull() || units->Units().IsNull() ? 0 : units->NbUnits();
        bool told = false;
        for (int n = 1; n <= count; ++n) {
            told = look_at_unit(units->UnitsValue(n)) || told;
        }
        if (!taken.LengthDone() && !told && is_to_be_told(context)) {
            notes_.push_back(
                fmt::format("{} has no unit of length that can be read: mm is assumed", place(context)));
        }
    }

    /// Whether something is said of it.
    bool look_at_unit(const Handle(StepBasic_NamedUnit) & unit) {
        if (unit.IsNull() || !(unit->IsKind(STANDARD_TYPE(LengthConversion)) ||
                               unit->IsKind(STANDARD_TYPE(StepBasic_SiUnitAndLengthUnit)))) {
            return false;
        }
        const STEPConstruct_UnitContext taken = factors_of(unit);
        const double mm = taken.LengthDone() ? taken.LengthFactor() : 1.0;
        if (!(std::isfinite(mm) && mm > 0.0)) {
            throw Error(Diagnostic{{file_, line_of(label(unit))},
                                   fmt::format("{}: {:g} mm is not a valid unit of length", label(unit), mm),
                                   "export the file again with the program that made it"});
        }
        const std::string fault = fault_of(unit);
        if (!fault.empty() && is_to_be_told(unit)) {
            notes_.push_back(fmt::format(
                "the unit of length {} cannot be read ({}): {:g} mm is assumed", place(unit), fault, mm));
        }
        return !fault.empty();
    }

    /// What the library found wrong as it read the unit or one that it is converted to.
    [[nodiscard]] std::string fault_of(const Handle(StepBasic_NamedUnit) & unit) const {
        if (const auto conversion = Handle(LengthConversion)::DownCast(unit); !conversion.IsNull()) {
            const Handle(StepBasic_MeasureWithUnit) measure = conversion->ConversionFactor();
            if (measure.IsNull()) {
                return "it has no factor";
            }
            const Handle(StepBasic_NamedUnit) base = measure->UnitComponent().NamedUnit();
            if (base.IsNull()) {
                return "its factor has no unit";
            }
            return base->IsKind(STANDARD_TYPE(LengthConversion)) ? "its conversions do not lead to a unit"
                                                                 : fault_of(base);
        }
        const auto si = Handle(StepBasic_SiUnit)::DownCast(unit);
        const int number = model_.Number(unit);
        if (number > 0 && model_.Check(number, Standard_True)->HasFailed()) {
            return model_.Check(number, Standard_True)->CFail(1);
        }
        return si.IsNull() || si->Name() != StepBasic_sunMetre ? "it is not a metre" : "";
    }

    const StepData_StepModel& model_;
    const std::string& text_;
    const std::filesystem::path& file_;
    int contexts_ = 0;
    std::set<int> told_; ///< entities that something was to be said of
    std::vector<std::string> notes_;
};

} // namespace

std::vector<std::string>
settled_units(const StepData_StepModel& model, const std::string& text, const std::filesystem::path& file) {
    return StepUnits(model, text, file).settled();
}

} // namespace millwright::exchange
