#pragma once

#include <string>

#include "cli/options.h"
#include "cli/source_reader.h"

namespace isostar::native {

/// The command line of `encode`.
struct EncodeArguments {
  SourceRequest source;
  std::string output;
  EncodeOptions options;
  Units units = Units::Grid;
  bool json = false;
};

}  // namespace isostar::native
