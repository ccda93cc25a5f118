#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "isostar/isostar.h"
#include "volume/sample_buffer.h"

// Options whose values are not just a number or a word. Invalid values are rejected while the
// command line is parsed.
namespace isostar::native {

/// The unit of lengths. Grid: grid steps along the smallest spacing. World: the unit of the file.
enum class Units : uint8_t { Grid, World };

CLI::Option* addPolygonizer(CLI::App&, Polygonizer&, const std::string& help);
CLI::Option* addFrame(CLI::App&, Frame&, const std::string& help);
CLI::Option* addFurther(CLI::App&, std::vector<double>&, const std::string& help);
CLI::Option* addUnits(CLI::App&, Units&, const std::string& help);
CLI::Option* addUnits(CLI::App&, std::optional<Units>&, const std::string& help);  // no default
CLI::Option* addSampleType(CLI::App&, std::optional<SampleType>&, const std::string& help);
CLI::Option* addSize(CLI::App&, std::optional<ClaimedSize>&, const std::string& help);
CLI::Option* addSpacing(CLI::App&, std::optional<std::array<double, 3>>&, const std::string& help);

/// 64, 128 or none, which is 0.
CLI::Option* addChunk(CLI::App&, int& side, const std::string& help);
/// --region, in the frame World.
CLI::Option* addRegion(CLI::App&, std::optional<Region>& value, const std::string& help);
/// --threads; takes effect at once.
CLI::Option* addThreads(CLI::App&);

/// Rejects "nan" and "inf", which the parser accepts as numbers.
extern const CLI::Validator kFinite;
extern const CLI::Validator kPositive;
/// A whole number from 0 on.
extern const CLI::Validator kWhole;

}  // namespace isostar::native
