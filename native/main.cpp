#include <CLI/CLI.hpp>
#include <iostream>
#include <new>

#include "cli/commands.h"
#include "cli/messages.h"
#include "cli/suggestion.h"
#include "files/ending_signals.h"
#include "files/failure.h"
#include "files/standard_descriptors.h"
#include "files/text.h"
#include "isostar/isostar.h"

namespace isostar::native {
namespace {

/// The exit status.
enum Status { kDone = 0, kFileFault = 1, kUsageFault = 2 };

int report(Status status, const std::string& what) {
  printMessage(what);
  return status;
}

/// Prints the parser's error message, or the requested help.
int reportParsing(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error, std::cout, std::cerr);
  const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  const std::vector<std::string> unknown = app.remaining(true);
  const std::string what =
      unknown.empty() ? oneLine(error.what()) : describeUnknown(*command, unknown.front());
  return report(kUsageFault, text("%s; see isostar %s--help", what.c_str(),
                                  command == &app ? "" : (command->get_name() + " ").c_str()));
}

int run(int argc, char** argv) {
  CLI::App app("Isosurfaces of volume data, compressed and decoded progressively.", "isostar");
  app.set_version_flag("--version",
                       text("isostar %s (format %d)", ISOSTAR_VERSION, kFormatVersion));
  app.option_defaults()->always_capture_default();
  app.get_formatter()->label("TEXT", "FILE");
  app.get_formatter()->label("FLOAT", "NUMBER");
  app.get_formatter()->column_width(34);
  app.require_subcommand(1);
  addEncode(app);
  addDecode(app);
  addInfo(app);
  addCompare(app);
  try {
    app.parse(argc, argv);
    std::cout.flush();
    return std::cout ? kDone : report(kFileFault, "standard output cannot be written");
  } catch (const CLI::ParseError& error) {
    return reportParsing(app, error);
  } catch (const UsageFault& fault) {
    return report(kUsageFault, fault.what());
  } catch (const std::bad_alloc&) {
    return report(kFileFault, "out of memory");
  } catch (const Failure& fault) {
    return report(kFileFault, fault.what());
  } catch (const std::exception& fault) {
    return report(kFileFault, oneLine(fault.what()));
  }
}

}  // namespace
}  // namespace isostar::native

int main(int argc, char** argv) {
  isostar::native::openStandardDescriptors();
  isostar::native::handleEndingSignals();
  return isostar::native::run(argc, argv);
}
