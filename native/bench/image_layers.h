#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace isostar::bench {

/// An image's contour without loss (§6): its layers, and whether the last one shows marching
/// squares' own points. Fails with one line where the file is no image.
nlohmann::ordered_json imageLayers(const std::string& path, double isovalue);

}  // namespace isostar::bench
