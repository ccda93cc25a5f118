#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace isostar::native {

/// What to read of a file that holds several volumes: options of the command line. Numbers count
/// from 0, those of series from 1.
struct Choices {
  std::optional<std::string> series;  // its number in the list that is printed, or its UID
  std::optional<std::string> scalar;  // the name of an array
  std::optional<int64_t> frame, channel, component, layer;
};

/// The options that a format understands, combined by |.
enum ChoiceOption : unsigned {
  kSeries = 1,
  kScalar = 2,
  kFrame = 4,
  kChannel = 8,
  kComponent = 16,
  kLayer = 32
};

/// Throws a UsageFault if an option is given that the format does not understand.
void requireUnderstood(const std::string& path, const Choices&, const char* format,
                       unsigned options);

/// The choice, or 0 if there is none. Throws a Failure if it is not below `count`; the message says
/// which are right. `option` is "--channel" for example.
size_t indexOf(const std::string& path, const char* option, const std::optional<int64_t>& choice,
               size_t count);

/// The position of the chosen name. Throws a Failure that lists the names if it is not among them.
size_t indexOf(const std::string& path, const char* option, const std::string& choice,
               const std::vector<std::string>& names);

}  // namespace isostar::native
