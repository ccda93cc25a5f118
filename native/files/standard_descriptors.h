#pragma once

namespace isostar::native {

/// Opens /dev/null where standard input, output or error is closed, so that no file gets their
/// numbers. Reading such an input or writing such an output still fails.
void openStandardDescriptors();

}  // namespace isostar::native
