// Reading and writing by Open CASCADE.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/exchange/internal/cad_contents.h"
#include "core/exchange/internal/cad_faces.h"
#include "core/exchange/internal/cad_reading.h"
#include "core/exchange/internal/cad_text.h"
#include "core/exchange/internal/file_kind.h"
#include "core/exchange/internal/occt.h"
#include "core/exchange/internal/step_units.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BezierSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Precision.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::exchange {

namespace {

enum class CadKind { step, iges };

bool is_step_name(const std::filesystem::path& file) {
    return kind_of(file) == "step" || kind_of(file) == "stp";
}

/// By its content: the library reads anything as far as it can, and says nothing.
CadKind checked_kind(const std::filesystem::path& file) {
    constexpr std::size_t section_column = 72;
    std::ifstream stream(file, std::ios::binary);
    std::string head(1024, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    if (!stream && !stream.eof()) {
        throw Error("the file cannot be read", file);
    }
    head.resize(static_cast<std::size_t>(stream.gcount()));
    refuse_wide_text(head, file);
    head.erase(0, head.size() - without_byte_order_mark(head).size());
    const std::size_t start = head.find_first_not_of(" \t\r\n");
    if (start == std::string::npos) {
        throw Error("the file is empty", file);
    }
    const bool step_name = is_step_name(file);
    if (head.compare(start, 12, "ISO-10303-21") == 0) {
        return CadKind::step;
    }
    if (!step_name && head.size() > section_column && head[section_column] == 'S') {
        return CadKind::iges;
    }
    throw Error(step_name ? "not a STEP file: it does not start with ISO-10303-21"
                          : "not an IGES file: column 73 of the first line is not S",
                file);
}

/// The two kinds of file name the same units differently.
std::string short_unit(std::string unit) {
    std::ranges::transform(unit, unit.begin(), [](unsigned char c) { return std::tolower(c); });
    return unit == "millimetre" ? "mm" : unit == "in" ? "inch" : unit;
}

std::string unit_of(STEPControl_Reader& reader) {
    TColStd_SequenceOfAsciiString lengths;
    TColStd_SequenceOfAsciiString angles;
    TColStd_SequenceOfAsciiString solid_angles;
    reader.FileUnits(lengths, angles, solid_angles);
    return short_unit(lengths.IsEmpty() ? "" : lengths.First().ToCString());
}

std::string unit_of(const IGESControl_Reader& reader) {
    const Handle(TCollection_HAsciiString) name = reader.IGESModel()->GlobalSection().UnitName();
    return short_unit(name.IsNull() ? "" : name->ToCString());
}

/// Why a file that begins as it should is none that can be read.
[[noreturn]] void refuse_damaged(const std::string& text, const std::filesystem::path& file) {
    constexpr std::string_view last = "END-ISO-10303-21";
    constexpr std::size_t enough = 4096;
    const bool ends = text.find(last, text.size() - std::min(text.size(), enough)) != std::string::npos;
    if (is_step_name(file) && !ends) {
        throw Error(fmt::format("the file is cut off: it does not end with {}", last),
                    file,
                    "export or copy it again");
    }
    throw Error("the file is damaged, and no model can be read from it", file);
}

// Shares of the time, measured on 18,000 faces in 38 MB.
constexpr double text_looked_through = 0.02;
constexpr double text_read = 0.15;
constexpr double model_read = 0.22;
constexpr double shapes_made = 0.65;

/// What there is to say of it.
std::vector<std::string>
load(STEPControl_Reader& reader, const std::filesystem::path& file, const Progress& progress) {
    std::string text = read_file(file);
    text.erase(0, text.size() - without_byte_order_mark(text).size());
    const int faces = checked_step_text(text, file, progress.part(0.0, text_looked_through));
    expect_not_too_many(faces, file);
    const std::string of = faces == 1 ? "1 face" : fmt::format("{} faces", faces);
    progress.report(text_looked_through, "reading the text of " + of);
    ProgressStream told(text, progress.part(text_looked_through, text_read), "reading the entities of " + of);
    std::istream stream(&told);
    if (reader.ReadStream(file.c_str(), stream) != IFSelect_RetDone) {
        refuse_damaged(text, file);
    }
    return settled_units(*reader.StepModel(), text, file);
}

/// A file of this process alone, with these bytes.
class MemoryFile {
public:
    MemoryFile(std::string_view bytes, const std::filesystem::path& about)
        : handle_(::memfd_create("millwright", MFD_CLOEXEC)) {
        while (handle_ >= 0 && !bytes.empty()) {
            const ssize_t count = ::write(handle_, bytes.data(), bytes.size());
            if (count <= 0) {
                break;
            }
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
        if (handle_ < 0 || !bytes.empty()) {
            throw Error("not enough memory for the file without its byte order mark", about);
        }
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(handle_); }

    [[nodiscard]] std::string name() const { return fmt::format("/proc/self/fd/{}", handle_); }

private:
    int handle_;
};

/// The library counts columns in its file, and a byte order mark would move those of the first line.
std::vector<std::string>
load(IGESControl_Reader& reader, const std::filesystem::path& file, const Progress& progress) {
    const std::string whole = read_file(file);
    const std::string_view text = without_byte_order_mark(whole);
    check_iges_text(text, file, progress.part(0.0, text_looked_through));
    progress.report(text_looked_through, "reading the file");
    std::optional<MemoryFile> plain;
    if (text.size() < whole.size()) {
        plain.emplace(text, file);
    }
    if (reader.ReadFile(plain ? plain->name().c_str() : file.c_str()) != IFSelect_RetDone) {
        refuse_damaged(whole, file);
    }
    return {};
}

template <typename Reader>
CadModel read_by(Reader reader, const std::filesystem::path& file, const Progress& progress) {
    progress.report(0.0, "reading the file");
    std::vector<std::string> notes = load(reader, file, progress);
    progress.check();
    progress.report(model_read, "creating shapes");
    const Handle(OcctProgress) indicator = new OcctProgress(progress.part(model_read, shapes_made));
    reader.TransferRoots(indicator->Start());
    progress.check();
    const TopoDS_Shape shape = reader.OneShape();
    const std::string lost = lost_faces(reader);
    if (shape.IsNull() || !TopExp_Explorer(shape, TopAbs_FACE).More()) {
        refuse_without_face(shape, *reader.Model(), lost, file);
    }
    CadModel model = faces_of(shape, file, progress.part(shapes_made, 1.0));
    if (!lost.empty()) {
        model.left_out.push_back(lost);
    }
    model.notes = std::move(notes);
    model.unit = unit_of(reader);
    return model;
}

Handle(Geom_BezierSurface) bezier_of(const geometry::BezierPatch& patch) {
    const geometry::ControlNet& net = patch.net();
    TColgp_Array2OfPnt points(1, net.rows, 1, net.columns);
    TColStd_Array2OfReal weights(1, net.rows, 1, net.columns);
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            const Vec3& point = net.point(i, j);
            points(i + 1, j + 1) = gp_Pnt(point.x(), point.y(), point.z());
            weights(i + 1, j + 1) = net.weight(i, j);
        }
    }
    return patch.rational() ? new Geom_BezierSurface(points, weights) : new Geom_BezierSurface(points);
}

TopoDS_Face occt_face(const geometry::BezierPatch& patch, const std::filesystem::path& file) {
    if (std::max(patch.degree_u(), patch.degree_v()) > Geom_BezierSurface::MaxDegree()) {
        throw Error(fmt::format("a patch of degree {} x {} cannot be written, the highest degree is {}",
                                patch.degree_u(),
                                patch.degree_v(),
                                Geom_BezierSurface::MaxDegree()),
                    file);
    }
    BRepBuilderAPI_MakeFace face(bezier_of(patch), Precision::Confusion());
    if (!face.IsDone()) {
        throw Error("a patch does not form a face: it has no area or touches itself", file);
    }
    return face.Face();
}

/// All of them together: the library's writer looks through its whole model for each shape it is given.
TopoDS_Compound shape_of_surface(const geometry::Surface& surface,
                                 const std::filesystem::path& file,
                                 const Progress& progress) {
    TopoDS_Compound all;
    const BRep_Builder builder;
    builder.MakeCompound(all);
    double done = 0.0;
    for (const geometry::BezierPatch& patch : surface.patches()) {
        progress.check();
        builder.Add(all, occt_face(patch, file));
        progress.report(++done / surface.patch_count());
    }
    return all;
}

/// The library's own name counts what one run of the program has written.
void name_product(const StepData_StepModel& model, const std::string& name) {
    for (int n = 1; n <= model.NbEntities(); ++n) {
        const Handle(StepBasic_Product) product = Handle(StepBasic_Product)::DownCast(model.Value(n));
        if (!product.IsNull()) {
            product->SetId(new TCollection_HAsciiString(name.c_str()));
            product->SetName(new TCollection_HAsciiString(name.c_str()));
        }
    }
}

} // namespace

CadModel read_cad_here(const std::filesystem::path& file, const Progress& progress) {
    const CadKind kind = checked_kind(file);
    return with_occt(file, [&] {
        return kind == CadKind::step ? read_by(STEPControl_Reader(), file, progress)
                                     : read_by(IGESControl_Reader(), file, progress);
    });
}

void write_step_here(const geometry::Surface& surface,
                     const std::string& name,
                     const std::filesystem::path& file,
                     const Progress& progress) {
    progress.report(0.0, "making the faces");
    with_occt(file, [&] {
        STEPControl_Writer writer;
        constexpr int one_part = 0; // else each face is a part of an assembly
        Interface_Static::SetIVal("write.step.assembly", one_part);
        const TopoDS_Compound faces = shape_of_surface(surface, file, progress.part(0.0, 0.1));
        const Handle(OcctProgress) indicator = new OcctProgress(progress.part(0.1, 0.6));
        const bool taken =
            writer.Transfer(faces, STEPControl_AsIs, Standard_True, indicator->Start()) == IFSelect_RetDone;
        progress.check();
        progress.report(0.6, "writing the file");
        if (!taken) {
            throw Error("the surface cannot be written as STEP", file);
        }
        name_product(*writer.Model(), name);
        // Without a time, so that the same surface is the same file.
        APIHeaderSection_MakeHeader header(writer.Model());
        header.SetTimeStamp(new TCollection_HAsciiString(""));
        header.SetName(new TCollection_HAsciiString(name.c_str()));
        header.SetOriginatingSystem(new TCollection_HAsciiString("Millwright"));
        if (writer.Write(file.c_str()) != IFSelect_RetDone) {
            throw Error("the surface cannot be written as STEP", file);
        }
    });
}

} // namespace millwright::exchange
