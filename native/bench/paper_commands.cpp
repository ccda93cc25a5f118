#include "bench/paper_commands.h"

#include <iostream>
#include <memory>

#include "bench/adaptive_rate.h"
#include "bench/close_by.h"
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
  double maxError = 0, near = 0, isovalue = 0;
  std::string image;
};

void addSubjectCommands(CLI::App& app, const std::shared_ptr<Arguments>& arguments) {
  CLI::App& adaptive =
      addSubject(app, "adaptive", "An adaptive stream and what others cost", arguments->subject);
  addPoints(adaptive, arguments->options.points);
  addPrefixes(adaptive, arguments->options.prefixes);
  adaptive.add_option("--max-error", arguments->maxError, "The bound, in grid steps")->required();
  adaptive.callback([arguments] {
    std::cout << adaptiveRate(readSubject(arguments->subject), arguments->maxError,
                              arguments->options)
              << "\n";
  });

  CLI::App& topology = addSubject(
      app, "topology", "What each layer of a stream of one topology shows", arguments->subject);
  topology.callback(
      [arguments] { std::cout << layerTopology(readSubject(arguments->subject)) << "\n"; });

  CLI::App& near =
      addSubject(app, "near", "Two isosurfaces, alone and together", arguments->subject);
  near.add_option("--near", arguments->near, "The second isovalue")->required();
  near.callback([arguments] {
    std::cout << further(readSubject(arguments->subject), arguments->near) << "\n";
  });
}

void addTetrahedra(CLI::App& app, const std::shared_ptr<Arguments>& arguments) {
  CLI::App& command =
      *app.add_subcommand("tetrahedra", "A stream against the tetrahedra that it was made of");
  command.add_option("mesh", arguments->tetrahedra.path)->required();
  command.add_option("stream", arguments->tetrahedra.stream)->required();
  command.add_option("--iso", arguments->tetrahedra.isovalue, "The isovalue")->required();
  addPoints(command, arguments->options.points);
  command.callback([arguments] {
    std::cout << tetrahedraRate(arguments->tetrahedra, arguments->options) << "\n";
  });
}

void addImage(CLI::App& app, const std::shared_ptr<Arguments>& arguments) {
  CLI::App& command = *app.add_subcommand("image", "The layers of an image's contour without loss");
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
