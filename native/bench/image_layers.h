#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace isostar::bench {

/// The layers of an image's contour encoded losslessly (§6), and whether the last one gives exactly
/// the points of marching squares. Throws a Failure if the file is not an image.
nlohmann::ordered_json imageLayers(const std::string& path, double isovalue);

}  // namespace isostar::bench
