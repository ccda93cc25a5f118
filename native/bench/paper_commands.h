#pragma once

#include <CLI/CLI.hpp>

namespace isostar::bench {

/// The measurements of `npm run bench -- --paper`: adaptive streams, preserved topology, further
/// isovalues, tetrahedra and images.
void addPaperCommands(CLI::App&);

}  // namespace isostar::bench
