#include "report/text_file.h"

#include "io/atomic_file.h"
#include "io/checked_writer.h"

namespace rpf::report {

void write_text(const std::string& path, const std::string& text) {
  io::AtomicFile file(path);
  io::CheckedWriter writer(file.descriptor(), path);
  writer.write(text.data(), text.size());
  writer.finish();
  file.commit();
}

}  // namespace rpf::report
