#pragma once

#include <filesystem>

namespace isostar {

/// Writes small sound files of each format into a folder for each: nrrd, meta_image, nifti, tiff,
/// raw, named_files, ply, obj, stl, glb, dicom and vtk.
void writeReaderSeeds(const std::filesystem::path& folder);

}  // namespace isostar
