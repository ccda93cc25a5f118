#pragma once

namespace CLI {
class App;
}

// Each function adds a subcommand to the command line parser, which runs it if it is selected.
namespace isostar::native {

void addEncode(CLI::App&);
void addDecode(CLI::App&);
void addInfo(CLI::App&);
void addCompare(CLI::App&);

}  // namespace isostar::native
