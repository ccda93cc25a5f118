#include "bench/subject_command.h"

namespace isostar::bench {

CLI::App& addSubject(CLI::App& app, const std::string& name, const std::string& help,
                     SubjectRequest& request) {
  CLI::App& command = *app.add_subcommand(name, help);
  command
      .add_option("volume", request.path, "A volume, or synthetic:sphere, torus, gyroid or noise")
      ->required();
  command.add_option("--iso", request.isovalue, "The isovalue; default: Otsu's threshold");
  command.add_option("--effort", request.effort, "The effort of isostar's encoder")
      ->check(CLI::Range(1, EncodeOptions::kMostEffort));
  return command;
}

void addPoints(CLI::App& command, size_t& points) {
  command.add_option("--points", points, "Points of each distance measurement")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
}

void addPrefixes(CLI::App& command, int& prefixes) {
  command.add_option("--prefixes", prefixes, "Prefixes besides those that end with a layer")
      ->capture_default_str();
}

}  // namespace isostar::bench
