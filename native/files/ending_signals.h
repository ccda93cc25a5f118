#pragma once

namespace isostar::native {

/// From now on SIGINT, SIGTERM and SIGHUP remove the files of removeOnSignal() before they end the
/// process. A signal that is ignored, as under nohup, stays ignored.
void handleEndingSignals();

/// Restores the default actions, for child processes.
void resetEndingSignals();

/// Names a file to be removed if a signal ends the process. The text must live until it is given to
/// keepOnSignal().
void removeOnSignal(const char* path);
void keepOnSignal(const char* path);

}  // namespace isostar::native
