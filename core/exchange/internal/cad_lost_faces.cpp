#include "core/exchange/internal/cad_lost_faces.h"

#include <IGESGeom_BoundedSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <IGESSolid_Face.hxx>
#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TCollection_HAsciiString.hxx>
#include <Transfer_Binder.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace millwright::exchange {

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
