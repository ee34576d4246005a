#include "core/exchange/internal/cad_contents.h"

#include "core/base/error.h"
#include "core/exchange/cad_file.h"

#include <IGESData_UndefinedEntity.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_Point.hxx>
#include <TopExp_Explorer.hxx>
#include <fmt/format.h>

#include <string>
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

} // namespace millwright::exchange
