#pragma once

#include <CLI/CLI.hpp>

namespace isostar::bench {

/// What `npm run bench -- --paper` asks: adaptive streams, those of one topology, close-by
/// isosurfaces, tetrahedra, images.
void addPaperCommands(CLI::App&);

}  // namespace isostar::bench
