// Finds out before the work whether its result can be written.
#include "io/atomic_file.h"
#include "io/image_formats.h"
#include "rpf/io.h"

namespace rpf {

void check_target(const std::string& path) {
  const io::AtomicFile probe(path);  // made and removed: the surest answer to whether it can be
  io::format_of(path);
}

}  // namespace rpf
