// Preloaded into programs that must not use the network: a socket of the internet's ends the
// program. tests/node/no-network.test.mjs builds it.
#include <sys/socket.h>

#include <cstdlib>

extern "C" int socket(int domain, int, int) noexcept {
  if (domain != AF_UNIX) std::abort();
  return -1;  // what the local ones are for (name services) must not be needed either
}
