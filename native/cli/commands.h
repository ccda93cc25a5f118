#pragma once

namespace CLI {
class App;
}

// One subcommand each: declared to the command line parser here, run when the line asks for it.
namespace isostar::native {

void addEncode(CLI::App&);
void addDecode(CLI::App&);
void addInfo(CLI::App&);
void addCompare(CLI::App&);

}  // namespace isostar::native
