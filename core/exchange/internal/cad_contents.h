// What a file holds beside faces, or too many of them, in words.
#pragma once

#include <Interface_InterfaceModel.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_Reader.hxx>

#include <filesystem>
#include <string>

namespace millwright::exchange {

/// Throws Error about `file` if there are more than can be read: before they are made, which takes its time.
void expect_not_too_many(int faces, const std::filesystem::path& file);

/// Throws Error about `file`: it has no face. `shape` may be null, where nothing of the model became one;
/// `lost` tells of faces that are in the file all the same (lost_faces).
[[noreturn]] void refuse_without_face(const TopoDS_Shape& shape,
                                      const Interface_InterfaceModel& model,
                                      const std::string& lost,
                                      const std::filesystem::path& file);

// What the library leaves out of a file without a word.

/// After the roots are transferred: which faces of the file became no shape, and the first fault that the
/// library found on the way, in a sentence; empty if all did.
[[nodiscard]] std::string lost_faces(const XSControl_Reader& reader);

} // namespace millwright::exchange
