#include "core/exchange/internal/cad_contents.h"

#include "core/base/error.h"
#include "core/exchange/cad_file.h"

#include <IGESData_UndefinedEntity.hxx>
#include <IGESGeom_BoundedSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESSolid_Face.hxx>
#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_Point.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::exchange {

namespace {

/// "1 wire", "3 wires"; nothing of none.
void add(std::vector<std::string>& parts, int count, const char* one, const char* several) {
    if (count > 0) {
        parts.push_back(fmt::format("{} {}", count, count == 1 ? one : several));
    }
}

std::string listed_parts(const std::vector<std::string>& parts) {
    std::string text;
    for (std::size_t n = 0; n < parts.size(); ++n) {
        text += n == 0 ? "" : n + 1 == parts.size() ? " and " : ", ";
        text += parts[n];
    }
    return text;
}

int count_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum not_in = TopAbs_SHAPE) {
    int count = 0;
    for (TopExp_Explorer at(shape, kind, not_in); at.More(); at.Next()) {
        ++count;
    }
    return count;
}

std::vector<std::string> parts_of(const TopoDS_Shape& shape) {
    std::vector<std::string> parts;
    add(parts, count_of(shape, TopAbs_WIRE), "wire", "wires");
    add(parts, count_of(shape, TopAbs_EDGE, TopAbs_WIRE), "edge", "edges");
    add(parts, count_of(shape, TopAbs_VERTEX, TopAbs_EDGE), "point", "points");
    return parts;
}

struct ModelCounts {
    int products = 0;
    int curves = 0;
    int points = 0;
    int unknown = 0;
};

ModelCounts counts_of(const Interface_InterfaceModel& model) {
    ModelCounts counts;
    for (int n = 1; n <= model.NbEntities(); ++n) {
        const Handle(Standard_Transient)& entity = model.Value(n);
        counts.products += entity->IsKind(STANDARD_TYPE(StepBasic_Product)) ? 1 : 0;
        counts.curves += entity->IsKind(STANDARD_TYPE(StepGeom_Curve)) ? 1 : 0;
        counts.points += entity->IsKind(STANDARD_TYPE(StepGeom_Point)) ? 1 : 0;
        counts.unknown += entity->IsKind(STANDARD_TYPE(StepData_UndefinedEntity)) ||
                                  entity->IsKind(STANDARD_TYPE(IGESData_UndefinedEntity))
                              ? 1
                              : 0;
    }
    return counts;
}

/// The points and curves of a product that is placed are of its axes.
bool is_empty_assembly(const ModelCounts& counts) {
    return counts.products > 0 && counts.curves == 0 && counts.unknown == 0;
}

std::vector<std::string> parts_of(const ModelCounts& counts) {
    std::vector<std::string> parts;
    add(parts, counts.products, "product without shape", "products without shape");
    if (!is_empty_assembly(counts)) {
        add(parts, counts.curves, "curve", "curves");
        add(parts, counts.points, "point", "points");
    }
    return parts;
}

std::string hint_for(const ModelCounts& counts, bool without_shape) {
    if (counts.unknown > 0) {
        return "export exact surfaces, as STEP AP203, AP214 or AP242: entities of unknown types cannot be "
               "read";
    }
    if (without_shape && is_empty_assembly(counts)) {
        return "import the files of the parts: an assembly may keep its parts in separate files";
    }
    return counts.curves + counts.points > 0 || !without_shape
               ? "export surfaces: curves and points alone cannot be machined"
               : "check that something was selected for export and that the file is complete";
}

} // namespace

void expect_not_too_many(int faces, const std::filesystem::path& file) {
    if (faces > most_cad_faces) {
        throw Error(fmt::format("the file has {} faces, but at most {} are supported", faces, most_cad_faces),
                    file,
                    "export the body or the faces to be machined to a separate file");
    }
}

void refuse_without_face(const TopoDS_Shape& shape,
                         const Interface_InterfaceModel& model,
                         const std::string& lost,
                         const std::filesystem::path& file) {
    if (!lost.empty()) {
        throw Error(lost, file, "export the file again: it is damaged there");
    }
    const ModelCounts counts = counts_of(model);
    std::vector<std::string> parts = shape.IsNull() ? std::vector<std::string>{} : parts_of(shape);
    const bool without_shape = parts.empty();
    if (without_shape) {
        parts = parts_of(counts);
    }
    const std::string hint = hint_for(counts, without_shape);
    add(parts, counts.unknown, "entity of unknown type", "entities of unknown type");
    if (parts.empty()) {
        add(parts, model.NbEntities(), "entity that is not a shape", "entities that are not shapes");
    }
    throw Error(parts.empty() ? "the file contains no entities"
                              : fmt::format("the file contains no face: {}", listed_parts(parts)),
                file,
                hint);
}

namespace {

bool is_step_face(const Standard_Transient& entity) {
    return entity.IsKind(STANDARD_TYPE(StepShape_FaceSurface));
}

bool is_iges_face(const Standard_Transient& entity) {
    return entity.IsKind(STANDARD_TYPE(IGESGeom_TrimmedSurface)) ||
           entity.IsKind(STANDARD_TYPE(IGESGeom_BoundedSurface)) ||
           entity.IsKind(STANDARD_TYPE(IGESSolid_Face));
}

/// Of an IGES file only what was tried: a surface may be there for another entity alone.
bool is_lost(const Standard_Transient& entity, const Handle(Transfer_Binder) & made) {
    if (!made.IsNull() && made->HasResult()) {
        return false;
    }
    return is_step_face(entity) || (is_iges_face(entity) && !made.IsNull());
}

/// The first of them.
std::string listed_labels(const std::vector<std::string>& labels) {
    constexpr std::size_t most = 8;
    std::string text;
    for (std::size_t n = 0; n < labels.size() && n < most; ++n) {
        text += (n == 0 ? "" : ", ") + labels[n];
    }
    return labels.size() <= most ? text : fmt::format("{} and {} more", text, labels.size() - most);
}

std::string fault_of(const Handle(Transfer_Binder) & made) {
    const Handle(Interface_Check) check = made.IsNull() ? nullptr : made->Check();
    if (check.IsNull() || check->NbFails() == 0) {
        return {};
    }
    const std::string_view fault = check->CFail(1);
    return std::string(fault.substr(std::min(fault.find_first_not_of(' '), fault.size())));
}

} // namespace

std::string lost_faces(const XSControl_Reader& reader) {
    const Handle(Interface_InterfaceModel) model = reader.Model();
    const Handle(Transfer_TransientProcess) made = reader.WS()->TransferReader()->TransientProcess();
    std::vector<std::string> lost;
    std::string first_fault;
    int faces = 0;
    for (int n = 1; n <= model->NbEntities(); ++n) {
        const Handle(Standard_Transient) entity = model->Value(n);
        const Handle(Transfer_Binder) found = made->Find(entity);
        const std::string label = model->StringLabel(entity)->ToCString();
        faces += is_step_face(*entity) || is_iges_face(*entity) ? 1 : 0;
        if (is_lost(*entity, found)) {
            lost.push_back(label);
        }
        if (const std::string fault = fault_of(found); first_fault.empty() && !fault.empty()) {
            first_fault = fmt::format("; the first error, {}: {}", label, fault);
        }
    }
    return lost.empty() ? std::string()
                        : fmt::format("Open CASCADE could not create {} of {} faces of the file ({}){}",
                                      lost.size(),
                                      faces,
                                      listed_labels(lost),
                                      first_fault);
}

} // namespace millwright::exchange
