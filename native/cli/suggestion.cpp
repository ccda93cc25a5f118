#include "cli/suggestion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <vector>

#include "files/text.h"

namespace isostar::native {
namespace {

/// The number of letters to insert, delete or replace (Levenshtein distance).
size_t distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row[b.size()];
}

std::vector<std::string> namesOf(const CLI::App& command, bool option) {
  std::vector<std::string> names;
  if (!option) {
    for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(sub->get_name());
    return names;
  }
  for (const CLI::Option* each : command.get_options()) {
    for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

std::string describeUnknown(const CLI::App& command, const std::string& argument) {
  const bool option = argument.size() > 1 && argument[0] == '-';
  const std::string word = argument.substr(0, argument.find('='));
  std::string nearest;
  size_t best = std::max<size_t>(2, word.size() / 3) + 1;
  for (const std::string& name : namesOf(command, option)) {
    if (const size_t letters = distance(word, name); letters < best) {
      best = letters;
      nearest = name;
    }
  }
  const char* kind = option                 ? "unknown option"
                     : command.get_parent() ? "one argument too many:"
                                            : "unknown command";
  return text("%s %s", kind, word.c_str()) +
         (nearest.empty() ? "" : ", did you mean " + nearest + "?");
}

}  // namespace isostar::native
