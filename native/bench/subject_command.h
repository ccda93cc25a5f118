#pragma once

#include <CLI/CLI.hpp>

#include "bench/sizes.h"

namespace isostar::bench {

/// Adds a subcommand about one isosurface. Its options are stored in `request`, which must outlive
/// the parsing.
CLI::App& addSubject(CLI::App&, const std::string& name, const std::string& help,
                     SubjectRequest& request);

/// --points: the number of points of each distance measurement.
void addPoints(CLI::App&, size_t& points);

/// --prefixes: the number of points on the rate-distortion curve of a stream.
void addPrefixes(CLI::App&, int& prefixes);

}  // namespace isostar::bench
