#include "onset/results/coloured_ply.hpp"

#include <algorithm>

#include "files/input_output.hpp"

namespace app {

Colour colour_of(double toi, double earliest) {
  if (toi < 0) return {200, 200, 200};
  const double t = earliest < 1 ? std::clamp((toi - earliest) / (1 - earliest), 0.0, 1.0) : 0;
  const auto byte = [](double x) { return std::uint8_t(255 * std::clamp(x, 0.0, 1.0)); };
  return {byte(2 - 2 * t), byte(t < 0.5 ? 2 * t : 2 - 2 * t), byte(2 * t - 1)};
}

void write_coloured_ply(const std::string& path, const Points& positions, const Faces& faces,
                        const std::vector<Colour>& colours) {
  Output file(path);
  file.write(format("ply\nformat ascii 1.0\nelement vertex %td\n", positions.rows()));
  file.write("property double x\nproperty double y\nproperty double z\n");
  file.write("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  file.write(format("element face %td\nproperty list uchar int vertex_indices\nend_header\n", faces.rows()));
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const auto& [red, green, blue] = colours[std::size_t(v)];
    file.write(format("%.17g %.17g %.17g %d %d %d\n", positions(v, 0), positions(v, 1), positions(v, 2), red,
                      green, blue));
  }
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    file.write(format("3 %lld %lld %lld\n", faces(f, 0), faces(f, 1), faces(f, 2)));
  file.close();
}

}  // namespace app
