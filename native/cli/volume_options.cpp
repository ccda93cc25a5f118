#include "cli/volume_options.h"

#include "cli/options.h"

namespace isostar::native {
namespace {

void addName(CLI::App& app, const char* option, std::optional<std::string>& value,
             const char* placeholder, const char* help) {
  app.add_option(option, value, help)->option_text(placeholder);
}

void addIndex(CLI::App& app, const char* option, std::optional<int64_t>& value,
              const char* placeholder, const char* help) {
  app.add_option(option, value, help)->option_text(placeholder)->check(kWhole);
}

}  // namespace

void addVolume(CLI::App& app, VolumeRequest& volume) {
  addSize(app, volume.size, "Samples along each axis of a raw volume, x fastest");
  addSampleType(app, volume.type, "Sample type of a raw volume");
  addSpacing(app, volume.spacing, "Distance between samples, overrides the file's");
  Choices& choices = volume.choices;
  addName(
      app, "--series", choices.series, "N|UID",
      "DICOM: the series to read, by its number in the list or by its UID [default: the largest]");
  addName(app, "--scalar", choices.scalar, "NAME",
          "VTK and HDF5: the array to read [default: the active or only one]");
  addIndex(app, "--component", choices.component, "C",
           "VTK: the component of an array of vectors, from 0");
  addIndex(app, "--frame", choices.frame, "T",
           "The time step of a sequence, from 0 [default: all]");
  addIndex(app, "--channel", choices.channel, "C", "TIFF: the channel, from 0 [default: 0]");
  addIndex(app, "--layer", choices.layer, "L",
           "NRRD: the layer of a segmentation with overlapping segments, from 0");
}

}  // namespace isostar::native
