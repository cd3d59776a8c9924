#include "cloth/output.hpp"

#include <unistd.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "files/output.hpp"

namespace cloth {

void write_frame(const std::string& path, const Vector& x, const std::vector<std::array<int, 3>>& faces) {
  app::Output file(path);
  file.write("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(x.size() / 3) +
             "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
             std::to_string(faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n");
  const auto bytes = [](const auto* data, std::size_t size) {
    return std::string_view(reinterpret_cast<const char*>(data), size);
  };
  file.write(bytes(x.data(), std::size_t(x.size()) * sizeof(double)));
  for (const auto& f : faces) {
    file.write("\3");
    file.write(bytes(f.data(), sizeof f));
  }
  file.publish();
}

std::string json_line(int step, const StepReport& r) {
  const nlohmann::ordered_json line = {{"step", step},
                                       {"toi", r.toi},
                                       {"smallest_step", r.smallest_step},
                                       {"contacts", r.contacts},
                                       {"closest", r.closest},
                                       {"iterations", r.iterations},
                                       {"converged", r.converged},
                                       {"behind", r.behind},
                                       {"seconds_collision", r.seconds_collision},
                                       {"seconds", r.seconds}};
  return line.dump();
}

Bar::Bar(int steps) : steps_(steps), shown_(isatty(STDERR_FILENO)) { show(0); }

Bar::~Bar() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Bar::show(int done) const {
  if (!shown_) return;
  const int width = 40, full = steps_ > 0 ? width * done / steps_ : width;
  std::fprintf(stderr, "\r[%s%s] %d of %d steps", std::string(std::size_t(full), '#').c_str(),
               std::string(std::size_t(width - full), '.').c_str(), done, steps_);
  std::fflush(stderr);
}

}  // namespace cloth
