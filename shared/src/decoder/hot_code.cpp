// The code that hot_code.h names.
#define ISOSTAR_TEMPLATE template
#include "decoder/hot_code.h"
