// The native measurements of `npm run bench`. Every subcommand prints one line of JSON.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>

#include "bench/chunk_cost.h"
#include "bench/decoder_memory.h"
#include "bench/figure6.h"
#include "bench/paper_commands.h"
#include "bench/sizes.h"
#include "bench/subject_command.h"
#include "bench/times.h"

using namespace isostar::bench;

int main(int argc, char** argv) {
  CLI::App app("Compares isostar with Draco and others", "isostar_bench");
  app.require_subcommand(1);
  SubjectRequest request;

  SizeOptions sizeOptions;
  CLI::App& sizesCommand = addSubject(app, "sizes", "Bytes and distances", request);
  addPoints(sizesCommand, sizeOptions.points);
  addPrefixes(sizesCommand, sizeOptions.prefixes);
  sizesCommand.add_flag("--rate", sizeOptions.rate, "Also simplified meshes and other codecs");
  sizesCommand.callback([&] { std::cout << sizes(readSubject(request), sizeOptions) << "\n"; });

  Figure6Options figureOptions;
  CLI::App& figureCommand =
      addSubject(app, "figure6", "Rate and distortion as in the paper's figure 6", request);
  addPoints(figureCommand, figureOptions.points);
  addPrefixes(figureCommand, figureOptions.prefixes);
  figureCommand.callback(
      [&] { std::cout << figure6(readSubject(request), figureOptions) << "\n"; });

  TimeOptions timeOptions;
  CLI::App& timesCommand = addSubject(app, "times", "Times of encoders and decoders", request);
  timesCommand
      .add_option("--milliseconds", timeOptions.milliseconds, "Duration of each measurement")
      ->capture_default_str();
  timesCommand.add_option("--keep", timeOptions.keep, "Folder for surface.isostar and surface.drc");
  timesCommand.add_option("--threads", timeOptions.threads, "Threads of the columns with several")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  timesCommand.callback([&] { std::cout << times(readSubject(request), timeOptions) << "\n"; });

  CLI::App& chunksCommand = addSubject(app, "chunks", "The bytes of streams in chunks", request);
  chunksCommand.callback([&] { std::cout << chunkCost(readSubject(request)) << "\n"; });

  addPaperCommands(app);

  std::string codec, path;
  CLI::App& memoryCommand = *app.add_subcommand("memory", "Peak memory of one decoder");
  memoryCommand.add_option("codec", codec)->required()->check(CLI::IsMember({"isostar", "draco"}));
  memoryCommand.add_option("file", path)->required();
  memoryCommand.callback([&] { std::cout << decoderMemory(codec, path) << "\n"; });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "isostar_bench: %s\n", error.what());
    return 1;
  }
}
