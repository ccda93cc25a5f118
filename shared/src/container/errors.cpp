// The names and descriptions of errors.
#include "isostar/isostar.h"

namespace isostar {

const char* name(Error error) {
  switch (error) {
    case Error::None:
      return "None";
    case Error::BadArgument:
      return "BadArgument";
    case Error::NotIsostar:
      return "NotIsostar";
    case Error::UnsupportedVersion:
      return "UnsupportedVersion";
    case Error::Truncated:
      return "Truncated";
    case Error::Corrupt:
      return "Corrupt";
    case Error::OverLimit:
      return "OverLimit";
  }
  return "?";
}

const char* describe(Error error) {
  switch (error) {
    case Error::None:
      return "no error";
    case Error::BadArgument:
      return "the volume or the options make no sense";
    case Error::NotIsostar:
      return "not an isostar stream";
    case Error::UnsupportedVersion:
      return "written by a newer version of the format";
    case Error::Truncated:
      return "the stream ends too early";
    case Error::Corrupt:
      return "the stream is damaged";
    case Error::OverLimit:
      return "larger than the limits allow";
  }
  return "unknown error";
}

}  // namespace isostar
