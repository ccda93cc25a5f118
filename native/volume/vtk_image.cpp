// VTK images: .vti and legacy .vtk with structured points.
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkXMLImageDataReader.h>

#include <cstring>

#include "files/failure.h"
#include "files/input_file.h"
#include "files/text.h"
#include "volume/placement.h"
#include "volume/volume_formats.h"
#include "volume/vtk_errors.h"

namespace isostar::native {
namespace {

SampleType sampleType(const vtkDataArray& array, const std::string& path) {
  const int bytes = array.GetDataTypeSize();
  switch (array.GetDataType()) {
    case VTK_UNSIGNED_CHAR:
      return SampleType::U8;
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return SampleType::I8;
    case VTK_UNSIGNED_SHORT:
      return SampleType::U16;
    case VTK_SHORT:
      return SampleType::I16;
    case VTK_UNSIGNED_INT:
    case VTK_UNSIGNED_LONG:
    case VTK_UNSIGNED_LONG_LONG:
      return bytes == 4 ? SampleType::U32 : SampleType::U64;
    case VTK_INT:
    case VTK_LONG:
    case VTK_LONG_LONG:
    case VTK_ID_TYPE:
      return bytes == 4 ? SampleType::I32 : SampleType::I64;
    case VTK_FLOAT:
      return SampleType::F32;
    case VTK_DOUBLE:
      return SampleType::F64;
    default:
      throw Failure(path, "has samples of an unsupported type");
  }
}

/// The active scalars, or the only array.
vtkDataArray& samplesOf(vtkImageData& image, const std::string& path) {
  vtkPointData& points = *image.GetPointData();
  vtkDataArray* array = points.GetScalars();
  if (!array && points.GetNumberOfArrays() == 1) array = points.GetArray(0);
  if (!array) throw Failure(path, "has no scalars at its points");
  if (array->GetNumberOfComponents() != 1)
    throw Failure(path,
                  text("has %d values per sample; one is needed", array->GetNumberOfComponents()));
  return *array;
}

/// VTK's indices start at the extent's corner, which need not be zero.
Placement placementIn(vtkImageData& image, const std::string& path) {
  double corner[3];
  const int* extent = image.GetExtent();
  image.TransformIndexToPhysicalPoint(extent[0], extent[2], extent[4], corner);
  AxisSteps steps{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int row = 0; row < 3; ++row)
      steps[axis][row] =
          image.GetDirectionMatrix()->GetElement(row, axis) * image.GetSpacing()[axis];
  }
  return placementOf(path, {corner[0], corner[1], corner[2]}, steps);
}

LoadedVolume load(vtkImageData* image, const std::string& path) {
  if (!image || image->GetNumberOfPoints() == 0)
    throw Failure(path, "is not a VTK image, or it is damaged");
  vtkDataArray& array = samplesOf(*image, path);
  const int* size = image->GetDimensions();
  SampleBuffer buffer(path, {size[0], size[1], size[2]}, sampleType(array, path), 0);
  if (array.GetNumberOfTuples() != image->GetNumberOfPoints())
    throw Failure(path, "has fewer samples than points");
  std::memcpy(buffer.data(), array.GetVoidPointer(0), buffer.bytes());
  LoadedVolume volume;
  volume.size = buffer.size();
  volume.placement = placementIn(*image, path);
  volume.samples = buffer.take();
  return volume;
}

template <class Reader>
LoadedVolume readWith(const std::string& path) {
  const vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  if (!updateQuietly(*reader)) throw Failure(path, "is not a VTK image, or it is damaged");
  return load(reader->GetOutput(), path);
}

}  // namespace

LoadedVolume readVtkImage(const VolumeRequest& request) {
  const std::string& path = request.path;
  fileSize(path);
  if (extensionOf(path) == ".vtk") return readWith<vtkStructuredPointsReader>(path);
  refuseEntities(path);
  return readWith<vtkXMLImageDataReader>(path);
}

}  // namespace isostar::native
