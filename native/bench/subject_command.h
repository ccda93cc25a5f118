#pragma once

#include <CLI/CLI.hpp>

#include "bench/sizes.h"

namespace isostar::bench {

/// A subcommand about one isosurface, into `request`, which must outlive the parsing.
CLI::App& addSubject(CLI::App&, const std::string& name, const std::string& help,
                     SubjectRequest& request);

/// --points: how exactly distances are measured.
void addPoints(CLI::App&, size_t& points);

/// --prefixes: how densely the curve of a stream is drawn.
void addPrefixes(CLI::App&, int& prefixes);

}  // namespace isostar::bench
