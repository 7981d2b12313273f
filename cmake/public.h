// Comes first in the files that define public functions (-include): what their headers declare is shown, all else
// hidden.
#pragma GCC visibility push(default)
#include "rpf/rpf.h"
#pragma GCC visibility pop
