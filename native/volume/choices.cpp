#include "volume/choices.h"

#include <algorithm>

#include "files/failure.h"
#include "files/text.h"

namespace isostar::native {

void requireUnderstood(const std::string& path, const Choices& choices, const char* format,
                       unsigned options) {
  const auto refuse = [&](bool given, ChoiceOption option, const char* name) {
    if (given && !(options & option))
      throw UsageFault(text("%s is read as %s, which has no %s", path.c_str(), format, name));
  };
  refuse(choices.series.has_value(), kSeries, "--series");
  refuse(choices.scalar.has_value(), kScalar, "--scalar");
  refuse(choices.frame.has_value(), kFrame, "--frame");
  refuse(choices.channel.has_value(), kChannel, "--channel");
  refuse(choices.component.has_value(), kComponent, "--component");
  refuse(choices.layer.has_value(), kLayer, "--layer");
}

size_t indexOf(const std::string& path, const char* option, const std::optional<int64_t>& choice,
               size_t count) {
  const int64_t index = choice.value_or(0);
  if (index >= 0 && static_cast<uint64_t>(index) < count) return static_cast<size_t>(index);
  const char* name = option + 2;  // without the dashes
  throw Failure(path, count == 1
                          ? text("has one %s: %s may be 0 only", name, option)
                          : text("has %zu %ss: %s is 0 to %zu", count, name, option, count - 1));
}

size_t indexOf(const std::string& path, const char* option, const std::string& choice,
               const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), choice);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw Failure(path, text("has no %s for %s; it has %s", choice.c_str(), option,
                           list.empty() ? "none" : list.c_str()));
}

}  // namespace isostar::native
