#pragma once

#include <string>

#include "cli/encode_arguments.h"
#include "cli/work_report.h"
#include "volume/loaded_volume.h"

namespace isostar::native {

/// "in.nrrd 14 MB -> out.isostar 120 kB, 40000 vertices, error at most 0.05 grid steps".
/// `sourceBytes`: the length of the input's files before they were read.
std::string encodedLine(const EncodeArguments&, const StreamInfo&, uint64_t sourceBytes);

/// Warns if the surface is empty, if the bound is finer than the samples' precision, if an option
/// had no effect, or if a decoder with default limits refuses the stream.
void warnOfResult(const EncodeArguments&, const LoadedVolume&, const StreamInfo&);

/// Prints `encode --json`. Polygonizes the source itself, after `report` has got times and sizes.
void printReport(const EncodeArguments&, const LoadedVolume&, const StreamInfo&, WorkReport report);

}  // namespace isostar::native
