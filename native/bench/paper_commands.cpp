#include "bench/paper_commands.h"

#include <iostream>
#include <memory>

#include "bench/adaptive_rate.h"
#include "bench/further_isovalue.h"
#include "bench/image_layers.h"
#include "bench/layer_topology.h"
#include "bench/subject_command.h"
#include "bench/tetrahedra_rate.h"

namespace isostar::bench {
namespace {

struct Arguments {
  SubjectRequest subject;
  SizeOptions options;
  TetrahedraRequest tetrahedra;
  double maxError = 0, further = 0, isovalue = 0;
  std::string image;
};

void addSubjectCommands(CLI::App& app, const std::shared_ptr<Arguments>& arguments) {
  CLI::App& adaptive =
      addSubject(app, "adaptive", "An adaptive stream and other codecs", arguments->subject);
  addPoints(adaptive, arguments->options.points);
  addPrefixes(adaptive, arguments->options.prefixes);
  adaptive.add_option("--max-error", arguments->maxError, "The bound, in grid steps")->required();
  adaptive.callback([arguments] {
    std::cout << adaptiveRate(readSubject(arguments->subject), arguments->maxError,
                              arguments->options)
              << "\n";
  });

  CLI::App& topology = addSubject(app, "topology", "The layers of a stream that preserves topology",
                                  arguments->subject);
  topology.callback(
      [arguments] { std::cout << layerTopology(readSubject(arguments->subject)) << "\n"; });

  CLI::App& further = addSubject(app, "near", "Two isosurfaces, in separate streams and in one",
                                 arguments->subject);
  further.add_option("--near", arguments->further, "The second isovalue")->required();
  further.callback([arguments] {
    std::cout << furtherIsovalue(readSubject(arguments->subject), arguments->further) << "\n";
  });
}

void addTetrahedra(CLI::App& app, const std::shared_ptr<Arguments>& arguments) {
  CLI::App& command =
      *app.add_subcommand("tetrahedra", "A stream and the tetrahedra that it encodes");
  command.add_option("mesh", arguments->tetrahedra.path)->required();
  command.add_option("stream", arguments->tetrahedra.stream)->required();
  command.add_option("--iso", arguments->tetrahedra.isovalue, "The isovalue")->required();
  addPoints(command, arguments->options.points);
  command.callback([arguments] {
    std::cout << tetrahedraRate(arguments->tetrahedra, arguments->options) << "\n";
  });
}

void addImage(CLI::App& app, const std::shared_ptr<Arguments>& arguments) {
  CLI::App& command =
      *app.add_subcommand("image", "The layers of an image's contour, encoded losslessly");
  command.add_option("image", arguments->image)->required();
  command.add_option("--iso", arguments->isovalue, "The isovalue")->required();
  command.callback(
      [arguments] { std::cout << imageLayers(arguments->image, arguments->isovalue) << "\n"; });
}

}  // namespace

void addPaperCommands(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  addSubjectCommands(app, arguments);
  addTetrahedra(app, arguments);
  addImage(app, arguments);
}

}  // namespace isostar::bench
