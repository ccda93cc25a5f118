// What `npm run bench` measures natively; every subcommand prints one line of JSON.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>

#include "bench/figure6.h"
#include "bench/memory.h"
#include "bench/sizes.h"
#include "bench/times.h"

namespace {

using namespace isostar::bench;

CLI::App& addSubject(CLI::App& app, const std::string& name, const std::string& help, SubjectRequest& request) {
  CLI::App& command = *app.add_subcommand(name, help);
  command.add_option("volume", request.path, "A volume, or synthetic:sphere, torus, gyroid or noise")->required();
  command.add_option("--iso", request.isovalue, "The isovalue; without it Otsu's threshold");
  return command;
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("Compares isostar with Draco and others", "isostar_bench");
  app.require_subcommand(1);
  SubjectRequest request;

  SizeOptions sizeOptions;
  CLI::App& sizesCommand = addSubject(app, "sizes", "Bytes and distances", request);
  sizesCommand.add_option("--points", sizeOptions.points, "Points that tell a distance")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  sizesCommand.add_option("--prefixes", sizeOptions.prefixes, "Prefixes between the layers' ends")
      ->capture_default_str();
  sizesCommand.add_flag("--rate", sizeOptions.rate, "Also simplified meshes and other codecs");
  sizesCommand.callback([&] { std::cout << sizes(readSubject(request), sizeOptions) << "\n"; });

  Figure6Options figureOptions;
  CLI::App& figureCommand = addSubject(app, "figure6", "Rate and distortion as in the paper's figure 6", request);
  figureCommand.add_option("--points", figureOptions.points, "Points that tell a distance")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  figureCommand.add_option("--prefixes", figureOptions.prefixes, "Prefixes between the layers' ends")
      ->capture_default_str();
  figureCommand.callback([&] { std::cout << figure6(readSubject(request), figureOptions) << "\n"; });

  TimeOptions timeOptions;
  CLI::App& timesCommand = addSubject(app, "times", "Times of encoders and decoders", request);
  timesCommand.add_option("--milliseconds", timeOptions.milliseconds, "How long each race lasts")
      ->capture_default_str();
  timesCommand.add_option("--keep", timeOptions.keep, "Folder for surface.isostar and surface.drc");
  timesCommand.callback([&] { std::cout << times(readSubject(request), timeOptions) << "\n"; });

  std::string codec, path;
  CLI::App& memoryCommand = *app.add_subcommand("memory", "Peak memory of one decoder");
  memoryCommand.add_option("codec", codec)->required()->check(CLI::IsMember({"isostar", "draco"}));
  memoryCommand.add_option("file", path)->required();
  memoryCommand.callback([&] { std::cout << decoderMemory(codec, path) << "\n"; });

  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "isostar_bench: %s\n", error.what());
    return 1;
  }
}
