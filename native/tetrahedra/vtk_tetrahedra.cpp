// VTK's unstructured grids: .vtu and legacy .vtk.
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fstream>

#include "files/failure.h"
#include "files/text.h"
#include "tetrahedra/tetrahedra_reader.h"
#include "volume/vtk_errors.h"

namespace isostar::native {
namespace {

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// The names of the arrays with one value per point, or of those with several.
std::vector<std::string> namesOf(vtkPointData& points, bool scalars) {
  std::vector<std::string> names;
  for (int i = 0; i < points.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = points.GetArray(i);
    if (array && array->GetName() && (array->GetNumberOfComponents() == 1) == scalars)
      names.push_back(array->GetName());
  }
  return names;
}

vtkDataArray& named(vtkPointData& points, const std::string& name, const std::string& path) {
  const std::string scalars = listOf(namesOf(points, true));
  vtkDataArray* array = points.GetArray(name.c_str());
  if (!array)
    throw Failure(path, text("has no scalar %s at its points%s%s", name.c_str(),
                             scalars.empty() ? "" : ", but ", scalars.c_str()));
  if (array->GetNumberOfComponents() != 1)
    throw Failure(path, text("%s has %d values per point; one is needed%s%s", name.c_str(),
                             array->GetNumberOfComponents(), scalars.empty() ? "" : ", as in ",
                             scalars.c_str()));
  return *array;
}

vtkDataArray& scalarOf(vtkPointData& points, const std::optional<std::string>& name,
                       const std::string& path) {
  if (name) return named(points, *name, path);
  vtkDataArray* marked = points.GetScalars();
  if (marked && marked->GetNumberOfComponents() == 1) return *marked;
  const std::vector<std::string> scalars = namesOf(points, true), vectors = namesOf(points, false);
  if (!scalars.empty()) return *points.GetArray(scalars.front().c_str());
  throw Failure(path, vectors.empty()
                          ? "has no scalars at its points"
                          : "has no scalars at its points, only vectors: " + listOf(vectors));
}

/// The grid's tetrahedra; counts the cells of other types.
std::vector<Corners4> tetrahedraOf(vtkUnstructuredGrid& grid, const std::string& path,
                                   size_t& others) {
  std::vector<Corners4> tetrahedra;
  const vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    if (grid.GetCellType(cell) != VTK_TETRA) {
      ++others;
      continue;
    }
    grid.GetCellPoints(cell, ids);
    if (ids->GetNumberOfIds() != 4)
      throw Failure(path, text("cell %lld does not have four points", (long long)cell));
    Corners4 corners;
    for (int c = 0; c < 4; ++c) {
      const vtkIdType point = ids->GetId(c);
      if (point < 0 || point >= grid.GetNumberOfPoints())
        throw Failure(path, text("cell %lld uses point %lld of %lld", (long long)cell,
                                 (long long)point, (long long)grid.GetNumberOfPoints()));
      corners[static_cast<size_t>(c)] = static_cast<uint32_t>(point);
    }
    tetrahedra.push_back(corners);
  }
  return tetrahedra;
}

TetrahedralMesh load(vtkUnstructuredGrid* grid, const std::optional<std::string>& scalar,
                     const std::string& path) {
  if (!grid || grid->GetNumberOfPoints() == 0)
    throw Failure(path, "has no points, or it is damaged");
  if (grid->GetNumberOfPoints() > UINT32_MAX) throw Failure(path, "has more than 2^32 points");
  TetrahedralMesh mesh;
  size_t others = 0;
  mesh.tetrahedra = tetrahedraOf(*grid, path, others);
  if (mesh.tetrahedra.empty())
    throw Failure(path, text("has no tetrahedra (cells of other types: %zu)", others));
  if (others > 0)
    mesh.remarks.push_back(text("cells that are not tetrahedra, left out: %zu", others));
  vtkDataArray& values = scalarOf(*grid->GetPointData(), scalar, path);
  const vtkIdType points = grid->GetNumberOfPoints();
  if (values.GetNumberOfTuples() != points) throw Failure(path, "has fewer scalars than points");
  for (vtkIdType i = 0; i < points; ++i) {
    double p[3];
    grid->GetPoint(i, p);
    mesh.points.push_back({p[0], p[1], p[2]});
    mesh.values.push_back(static_cast<float>(values.GetComponent(i, 0)));
  }
  return mesh;
}

/// The first word that is not a finite number. VTK's legacy reader reports a "nan" in a text file
/// as damage.
std::string nonFiniteWord(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  for (std::string word; file >> word;) {
    for (const char* each : {"nan", "-nan", "inf", "-inf", "NaN", "NAN"})
      if (word == each) return word;
  }
  return {};
}

template <class Reader>
TetrahedralMesh readWith(Reader& reader, const std::string& path,
                         const std::optional<std::string>& scalar) {
  reader.SetFileName(path.c_str());
  if (!updateQuietly(reader)) {
    const std::string word = nonFiniteWord(path);
    throw Failure(path, word.empty() ? "is not a VTK mesh, or it is damaged"
                                     : "has a number that is not finite: " + word);
  }
  return load(reader.GetOutput(), scalar, path);
}

}  // namespace

TetrahedralMesh readVtkTetrahedra(const std::string& path,
                                  const std::optional<std::string>& scalar) {
  if (extensionOf(path) == ".vtk") {
    const vtkNew<vtkUnstructuredGridReader> reader;
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllFieldsOn();
    return readWith(*reader, path, scalar);
  }
  refuseEntities(path);
  return readWith(*vtkNew<vtkXMLUnstructuredGridReader>(), path, scalar);
}

}  // namespace isostar::native
