#include "simulation/program/output.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string_view>

#include "files/output.hpp"

namespace simulation {

std::string frame_path(const std::string& folder, int step, const std::string& extension) {
  return (std::filesystem::path(folder) / app::format("frame_%04d.%s", step, extension.c_str())).string();
}

void write_ply_frame(const std::string& path, const Vector& x, const std::vector<std::array<int, 3>>& faces) {
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

Bar::Bar(int steps) : steps_(steps), shown_(isatty(STDERR_FILENO)) { show(0); }

Bar::~Bar() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Bar::show(int done) const {
  if (!shown_) return;
  const int width = 40, full = steps_ > 0 ? width * done / steps_ : width;
  std::string left;
  if (done > 0) {
    const long seconds = long(timer_.elapsed().wall * (steps_ - done) / done + 0.5);
    left = app::format(", %ld:%02ld left", seconds / 60, seconds % 60);
  }
  std::fprintf(stderr, "\r[%s%s] %d of %d steps%s\033[K", std::string(std::size_t(full), '#').c_str(),
               std::string(std::size_t(width - full), '.').c_str(), done, steps_, left.c_str());
  std::fflush(stderr);
}

}  // namespace simulation
